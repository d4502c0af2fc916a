// Several arrays in one file, for numpy.load().
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct zip;

namespace forage::observe {

/// Copies .npy files into one .npz file. `arrays` are pairs of a name in the archive and a file. Throws
/// std::runtime_error when a file cannot be read or the archive cannot be written.
void join_npz(const std::string& path, const std::vector<std::pair<std::string, std::string>>& arrays);

/// An .npz file that is read.
class NpzArchive {
  public:
    /// Throws std::runtime_error when it is no archive, and when its arrays claim more than 64 MiB and more
    /// than 100 times the size of the file, which numbers of a run do not reach and a few bytes can claim.
    explicit NpzArchive(const std::string& path);
    const std::vector<std::string>& names() const { return names_; }
    /// Extracts an array as a .npy file. Throws std::runtime_error, also for more bytes than the archive
    /// claims.
    void extract(std::size_t array, const std::string& npy) const;

  private:
    std::string path_;
    std::unique_ptr<zip, int (*)(zip*)> archive_;
    std::vector<std::string> names_;
    std::vector<std::pair<std::uint64_t, std::uint64_t>>
        entries_;  ///< of each array: its index and its bytes
};

/// Extracts the array `name` from an .npz file as a .npy file. Throws std::runtime_error.
void extract_npz(const std::string& path, const std::string& name, const std::string& npy);

}  // namespace forage::observe
