// Space on the disk for what a library is about to write, which cannot be stopped in the middle.
#pragma once

#include <cstdint>
#include <string>

namespace forage::observe {

/// Space that is set aside behind the end of a file: its size and content stay as they are. A format that
/// changes a file in several places, such as HDF5, is damaged when the disk runs full between two of them; so
/// space is asked for before. File systems that set nothing aside are trusted.
class DiskSpace {
  public:
    explicit DiskSpace(const std::string& path);
    DiskSpace(const DiskSpace&) = delete;
    DiskSpace& operator=(const DiskSpace&) = delete;
    ~DiskSpace();  ///< gives back what was not used

    /// Sets aside `bytes` behind the end of the file, as it is now. Throws std::runtime_error with the reason
    /// when there is no space for them.
    void ahead(std::uint64_t bytes);

  private:
    int file_;
};

}  // namespace forage::observe
