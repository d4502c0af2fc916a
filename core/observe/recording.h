// Reads recordings back.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/observe/source.h"

namespace forage::observe {

/// One source of a recording, row by row.
class Recording {
  public:
    virtual ~Recording() = default;
    /// The source. Its name is that of the file when the file does not contain one.
    const Recorded& what() const { return what_; }
    virtual void rewind() = 0;  ///< returns to the first row
    /// Reads the next row. Returns false after the last one. Throws FileError for a row that cannot be read.
    virtual bool next(std::uint64_t& cycle, std::vector<double>& numbers) = 0;

  protected:
    Recorded what_;
};

/// Opens the sources of a .csv, .npy, .npz or .h5 file, also of an unfinished one whose name ends with
/// ".part". Throws FileError when the file is not a recording.
std::vector<std::unique_ptr<Recording>> open_recording(const std::string& path);

/// Whether the ending of a name is that of a recording.
bool is_recording(const std::string& path);

}  // namespace forage::observe
