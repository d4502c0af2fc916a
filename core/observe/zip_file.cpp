#include "core/observe/zip_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <zip.h>

namespace forage::observe {
namespace {

constexpr std::uint64_t max_ratio = 100;                          ///< of unpacked and packed bytes
constexpr std::uint64_t free_unpacked = std::uint64_t{64} << 20;  ///< bytes, whatever the ratio

bool add(zip_t* archive, const ZipEntry& entry, bool compressed) {
    zip_source_t* source = entry.path.empty()
                               ? zip_source_buffer(archive, entry.text.data(), entry.text.size(), 0)
                               : zip_source_file(archive, entry.path.c_str(), 0, -1);
    const zip_int64_t index = zip_file_add(archive, entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) return zip_source_free(source), false;
    const auto i = static_cast<zip_uint64_t>(index);
    return zip_set_file_compression(archive, i, compressed ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0) == 0 &&
           zip_file_set_dostime(archive, i, 0, 0x21, 0) == 0;
}

}  // namespace

void write_zip(const std::string& path, const std::vector<ZipEntry>& entries, bool compressed) {
    namespace fs = std::filesystem;
    // libzip writes a temporary file beside the archive until the archive is complete. A folder for both can
    // be removed as a whole when the program was killed.
    const std::string folder = path + ".part", growing = folder + "/archive.zip";
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    fs::create_directory(folder, ignored);
    int error = 0;
    zip_t* archive = zip_open(growing.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
    const bool fine = archive && std::ranges::all_of(entries, [&](const ZipEntry& entry) {
                          return add(archive, entry, compressed);
                      });
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

ZipFile::ZipFile(std::string path)
    : path_(std::move(path)),
      archive_(zip_open(path_.c_str(), ZIP_RDONLY, nullptr), [](zip* z) { return zip_discard(z), 0; }) {
    if (!archive_) throw std::runtime_error("it is no archive, or a damaged one");
    std::error_code none;
    std::uint64_t left = std::max(free_unpacked, max_ratio * std::filesystem::file_size(path_, none));
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive_.get(), 0); ++i) {
        zip_stat_t entry;
        if (zip_stat_index(archive_.get(), static_cast<zip_uint64_t>(i), 0, &entry) != 0) continue;
        constexpr zip_uint64_t needed = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_INDEX | ZIP_STAT_CRC;
        if ((entry.valid & needed) != needed) continue;
        if (entry.size > left)
            throw std::runtime_error(fmt::format(
                "its files claim to be more than {} times as large when they are unpacked", max_ratio));
        left -= entry.size;
        entries_.push_back({entry.name, entry.size, entry.index, entry.crc});
    }
}

void ZipFile::extract(const Entry& entry, const std::string& path) const {
    const auto fail = [&](const std::string& what) {
        throw std::runtime_error(fmt::format("cannot take '{}' out of '{}': {}", entry.name, path_, what));
    };
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> in(
        zip_fopen_index(archive_.get(), entry.index, 0), zip_fclose);
    if (!in) fail(zip_strerror(archive_.get()));
    std::ofstream out(path, std::ios::binary);
    std::array<char, 1 << 16> block;
    std::uint64_t all = 0;
    zip_int64_t n = 0;
    while (out && all <= entry.bytes && (n = zip_fread(in.get(), block.data(), block.size())) > 0)
        out.write(block.data(), n), all += static_cast<std::uint64_t>(n);
    out.close();
    if (!out) fail(std::strerror(errno));
    if (n < 0 || all != entry.bytes) fail("it is damaged");
}

}  // namespace forage::observe
