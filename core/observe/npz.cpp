#include "core/observe/npz.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <zip.h>

namespace forage::observe {
namespace {

constexpr std::uint64_t max_ratio = 100;                          ///< of unpacked and packed bytes
constexpr std::uint64_t free_unpacked = std::uint64_t{64} << 20;  ///< bytes, whatever the ratio

}  // namespace

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

NpzArchive::NpzArchive(const std::string& path)
    : path_(path),
      archive_(zip_open(path.c_str(), ZIP_RDONLY, nullptr), [](zip* z) { return zip_discard(z), 0; }) {
    if (!archive_) throw std::runtime_error("it is no archive, or a damaged one");
    std::error_code none;
    std::uint64_t left = std::max(free_unpacked, max_ratio * std::filesystem::file_size(path, none));
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive_.get(), 0); ++i) {
        zip_stat_t entry;
        if (zip_stat_index(archive_.get(), static_cast<zip_uint64_t>(i), 0, &entry) != 0) continue;
        constexpr zip_uint64_t needed = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_INDEX;
        if ((entry.valid & needed) != needed || !std::string_view(entry.name).ends_with(".npy")) continue;
        if (entry.size > left)
            throw std::runtime_error(
                fmt::format("its arrays claim to be more than {} times as large when they are unpacked; "
                            "numpy.savez() stores large arrays as they are",
                            max_ratio));
        left -= entry.size;
        names_.emplace_back(entry.name, std::string_view(entry.name).size() - 4);
        entries_.emplace_back(entry.index, entry.size);
    }
}

void NpzArchive::extract(std::size_t array, const std::string& npy) const {
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(fmt::format("cannot take '{}' out of '{}': {}", names_[array], path_, what));
    };
    const auto& [index, bytes] = entries_[array];
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> in(zip_fopen_index(archive_.get(), index, 0),
                                                                zip_fclose);
    if (!in) fail(zip_strerror(archive_.get()));
    std::ofstream out(npy, std::ios::binary);
    std::array<char, 1 << 16> block;
    std::uint64_t all = 0;
    zip_int64_t n = 0;
    while (out && all <= bytes && (n = zip_fread(in.get(), block.data(), block.size())) > 0)
        out.write(block.data(), n), all += static_cast<std::uint64_t>(n);
    out.close();
    if (!out) fail(std::strerror(errno));
    if (n < 0 || all != bytes) fail("it is damaged");
}

void extract_npz(const std::string& path, const std::string& name, const std::string& npy) {
    const NpzArchive archive(path);
    const auto found = std::ranges::find(archive.names(), name);
    if (found == archive.names().end())
        throw std::runtime_error(fmt::format("'{}' has no array '{}'", path, name));
    archive.extract(static_cast<std::size_t>(found - archive.names().begin()), npy);
}

}  // namespace forage::observe
