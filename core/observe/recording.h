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
    /// Its name is the file's when the file does not say it.
    const Recorded& what() const { return what_; }
    virtual void rewind() = 0;  ///< to the first row
    /// The next row; false after the last one. Throws FileError for a row that cannot be read.
    virtual bool next(std::uint64_t& cycle, std::vector<double>& numbers) = 0;

  protected:
    Recorded what_;
};

/// The sources of a .csv, .npy or .h5 file, also of one that grows or was left behind, with ".part" at its
/// end. Throws FileError when it is none.
std::vector<std::unique_ptr<Recording>> open_recording(const std::string& path);

/// Whether a name looks like that of a recording.
bool is_recording(const std::string& path);

}  // namespace forage::observe
