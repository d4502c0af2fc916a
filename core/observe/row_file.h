// Files that grow row by row while a system runs.
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/observe/source.h"

namespace forage::observe {

enum class RecordingFormat {
    csv,      ///< a table with a header; one source
    npy,      ///< NumPy: a structured array with the fields `cycle` and the state's name; one source
    hdf5,     ///< a data set per source, with names, labels and the cycle axis
    sampler,  ///< the original's data sampler
};

/// A file that should be continued is missing or has too few rows.
class ShortFile : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The position at the end of a file of rows, when all of them are on disk.
struct RowFilePosition {
    std::uint64_t rows = 0, bytes = 0;  ///< bytes: 0 for formats that do not use it
    void checkpoint(Archive& archive) { archive(rows, bytes); }
};

/// A file of rows, one per sampled cycle. It contains complete rows only, however the run ends. Flushed rows
/// are kept even when the program is killed.
class RowFile {
  public:
    virtual ~RowFile() = default;
    /// Adds a row: the numbers of all sources, in order. Throws std::runtime_error when it cannot be written;
    /// earlier rows stay.
    virtual void add(std::uint64_t cycle, std::span<const double> numbers) = 0;
    /// Writes all rows to the disk. Throws std::runtime_error.
    virtual void flush() = 0;
    /// The position from which the file can be continued. Call it after flush().
    virtual RowFilePosition position() const = 0;
    /// Completes the file. Does nothing when it failed before. Throws std::runtime_error.
    virtual void close() = 0;
};

/// The content of a file apart from its rows.
struct RowFileHeader {
    std::vector<Recorded> sources;
    std::uint64_t every = 1;
    /// Names and texts about the run. HDF5 files store them as attributes; other formats ignore them.
    std::vector<std::pair<std::string, std::string>> attributes;
};

/// Opens a new file at `path`, or continues an existing one at the position `go_on` and removes what follows.
/// Throws std::runtime_error when it cannot be opened, and ShortFile when it is shorter than `go_on`.
std::unique_ptr<RowFile> open_row_file(RecordingFormat format, const std::string& path,
                                       const RowFileHeader& header,
                                       const std::optional<RowFilePosition>& go_on = std::nullopt);

/// Whether a file of this format can contain several sources.
constexpr bool holds_several(RecordingFormat format) {
    return format == RecordingFormat::hdf5 || format == RecordingFormat::sampler;
}

/// A file to which whole rows are appended in blocks.
class BlockFile {
  public:
    /// Creates an empty file, or keeps the first `go_on` bytes of an existing one.
    BlockFile(std::string path, std::optional<std::uint64_t> go_on);
    std::uint64_t written() const { return written_; }  ///< bytes of complete rows on disk
    bool open() const { return out_.is_open(); }
    std::string& buffer() { return buffer_; }  ///< complete rows only
    bool full() const { return buffer_.size() >= block; }
    /// Appends the buffer, then overwrites the beginning of the file with `head`, if it is not empty. When
    /// this fails, the file is cut after the last complete row.
    void flush(std::string_view head = {});
    void close();

  private:
    static constexpr std::size_t block = 1 << 16;
    [[noreturn]] void fail();
    std::string path_, buffer_;
    std::uint64_t written_ = 0;
    std::fstream out_;
};

}  // namespace forage::observe
