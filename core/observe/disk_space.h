// Disk space that is reserved before a library writes.
#pragma once

#include <cstdint>
#include <string>

namespace forage::observe {

/// Reserves space after the end of a file, whose size and content do not change. Formats such as HDF5 change
/// a file in several places. A disk that ran full between two such changes would damage the file, so space is
/// reserved before. On file systems that cannot reserve space this class has no effect.
class DiskSpace {
  public:
    explicit DiskSpace(const std::string& path);
    DiskSpace(const DiskSpace&) = delete;
    DiskSpace& operator=(const DiskSpace&) = delete;
    ~DiskSpace();  ///< releases the unused space

    /// Reserves `bytes` after the current end of the file. Throws std::runtime_error with the reason when
    /// there is not enough space.
    void reserve(std::uint64_t bytes);

  private:
    int file_;
};

}  // namespace forage::observe
