// Zip archives that are complete or absent.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct zip;

namespace forage::observe {

/// A file for an archive: its name there, and its content or the path of a file with it.
struct ZipEntry {
    std::string name;
    std::string path = {}, text = {};  ///< `text` counts when `path` is empty
};

/// Writes an archive without times, so that the same files give the same bytes. Throws std::runtime_error
/// when a file cannot be read or the archive cannot be written.
void write_zip(const std::string& path, const std::vector<ZipEntry>& entries, bool compressed);

/// An archive that is read.
class ZipFile {
  public:
    struct Entry {
        std::string name;
        std::uint64_t bytes = 0, index = 0;
        std::uint32_t crc = 0;
        bool operator==(const Entry&) const = default;
    };

    /// Throws std::runtime_error when it is no archive, and when its files claim more than 64 MiB and more
    /// than 100 times the size of the archive, which numbers of a run do not reach and a few bytes can claim.
    explicit ZipFile(std::string path);
    const std::vector<Entry>& entries() const { return entries_; }
    /// Writes the content of a file to `path`. Throws std::runtime_error, also for more bytes than the
    /// archive claims.
    void extract(const Entry& entry, const std::string& path) const;

  private:
    std::string path_;
    std::unique_ptr<zip, int (*)(zip*)> archive_;
    std::vector<Entry> entries_;
};

}  // namespace forage::observe
