#include "core/observe/npz.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <zip.h>

namespace forage::observe {

void join_npz(const std::string& path, const std::vector<std::pair<std::string, std::string>>& arrays) {
    namespace fs = std::filesystem;
    // libzip writes a temporary file beside the archive until the archive is complete. A folder for both can
    // be removed as a whole when the program was killed.
    const std::string folder = path + ".part", growing = folder + "/archive.npz";
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    fs::create_directory(folder, ignored);
    int error = 0;
    zip_t* archive = zip_open(growing.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
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
    std::string reason;
    if (!fine || zip_close(archive) != 0) {
        reason = archive ? zip_strerror(archive) : "it cannot be opened";
        if (archive) zip_discard(archive);
    } else {
        std::error_code moved;
        fs::rename(growing, path, moved);
        if (moved) reason = moved.message();
    }
    fs::remove_all(folder, ignored);
    if (!reason.empty()) throw std::runtime_error(fmt::format("cannot write '{}': {}", path, reason));
}

std::vector<std::string> names_in_npz(const std::string& path) {
    int error = 0;
    const std::unique_ptr<zip_t, decltype(&zip_discard)> archive(zip_open(path.c_str(), ZIP_RDONLY, &error),
                                                                 zip_discard);
    if (!archive) throw std::runtime_error("it is no archive, or a damaged one");
    std::vector<std::string> out;
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i)
        if (const char* name = zip_get_name(archive.get(), static_cast<zip_uint64_t>(i), 0);
            name && std::string_view(name).ends_with(".npy"))
            out.emplace_back(name, std::string_view(name).size() - 4);
    return out;
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
