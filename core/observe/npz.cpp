#include "core/observe/npz.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <zip.h>

namespace forage::observe {
namespace {

/// libzip writes beside the archive, with a dot and six letters more, until it is whole. Who was killed
/// meanwhile left that.
void remove_leftovers(const std::filesystem::path& archive) {
    const std::string start = archive.filename().string() + ".";
    const auto folder = archive.has_parent_path() ? archive.parent_path() : ".";
    std::error_code ignored;
    std::vector<std::filesystem::path> leftovers;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() == start.size() + 6 && name.starts_with(start)) leftovers.push_back(entry.path());
    }
    for (const auto& path : leftovers) std::filesystem::remove(path, ignored);
}

}  // namespace

void join_npz(const std::string& path, const std::vector<std::pair<std::string, std::string>>& arrays) {
    remove_leftovers(path);
    int error = 0;
    zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
    bool fine = archive != nullptr;
    for (std::size_t i = 0; fine && i < arrays.size(); ++i) {
        const auto& [name, file] = arrays[i];
        zip_source_t* source = zip_source_file(archive, file.c_str(), 0, -1);
        const zip_int64_t index = zip_file_add(archive, (name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
        if (index < 0) zip_source_free(source);
        // No compression, so that the numbers can be mapped; no time, so that the same run gives the same
        // bytes.
        fine = index >= 0 &&
               zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0) == 0 &&
               zip_file_set_dostime(archive, static_cast<zip_uint64_t>(index), 0, 0x21, 0) == 0;
    }
    if (fine && zip_close(archive) == 0) return;
    const std::string reason = archive ? zip_strerror(archive) : "it cannot be opened";
    if (archive) zip_discard(archive);
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
}

void extract_npz(const std::string& path, const std::string& name, const std::string& npy) {
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(fmt::format("cannot take '{}' out of '{}': {}", name, path, what));
    };
    int error = 0;
    const std::unique_ptr<zip_t, decltype(&zip_discard)> archive(zip_open(path.c_str(), ZIP_RDONLY, &error),
                                                                 zip_discard);
    if (!archive) fail("it cannot be opened");
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> in(
        zip_fopen(archive.get(), (name + ".npy").c_str(), 0), zip_fclose);
    if (!in) fail(zip_strerror(archive.get()));
    std::ofstream out(npy, std::ios::binary);
    std::array<char, 1 << 16> block;
    zip_int64_t n = 0;
    while (out && (n = zip_fread(in.get(), block.data(), block.size())) > 0) out.write(block.data(), n);
    out.close();
    if (n < 0 || !out) fail(n < 0 ? "it is damaged" : "the disk is full");
}

}  // namespace forage::observe
