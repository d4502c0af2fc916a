// Files that grow by rows while a system runs.
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

/// A file that should be gone on with lacks rows, or is not there.
class ShortFile : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Where a file of rows is when all of them are on disk.
struct RowFilePosition {
    std::uint64_t rows = 0, bytes = 0;  ///< bytes: 0 where they do not tell
    void checkpoint(Archive& archive) { archive(rows, bytes); }
};

/// A file of rows, one per sampled cycle. Whatever ends the run, it holds complete rows only; what was
/// flushed is there even when the program is killed.
class RowFile {
  public:
    virtual ~RowFile() = default;
    /// Adds a row: the numbers of all sources, in order. Throws std::runtime_error when it cannot be written;
    /// what was written before stays.
    virtual void add(std::uint64_t cycle, std::span<const double> numbers) = 0;
    /// Puts all rows on disk. Throws std::runtime_error.
    virtual void flush() = 0;
    /// After flush(): where to go on from.
    virtual RowFilePosition position() const = 0;
    /// Ends the file; nothing happens when it had failed before. Throws std::runtime_error.
    virtual void close() = 0;
};

/// What a file says of itself beside its rows.
struct RowFileHeader {
    std::vector<Recorded> sources;
    std::uint64_t every = 1;
    /// Names and texts about the whole run; HDF5 keeps them as attributes, the other formats have no place.
    std::vector<std::pair<std::string, std::string>> attributes;
};

/// Opens `path` to be written, anew or, after what it holds up to a position, to go on: the rest is cut off.
/// Throws std::runtime_error when it cannot be opened, ShortFile when it holds less.
std::unique_ptr<RowFile> open_row_file(RecordingFormat format, const std::string& path,
                                       const RowFileHeader& header,
                                       const std::optional<RowFilePosition>& go_on = std::nullopt);

/// Whether a file of this format holds several sources.
constexpr bool holds_several(RecordingFormat format) {
    return format == RecordingFormat::hdf5 || format == RecordingFormat::sampler;
}

/// A file to which whole rows are appended in blocks.
class BlockFile {
  public:
    /// Empty, or what it holds up to `go_on` bytes.
    BlockFile(std::string path, std::optional<std::uint64_t> go_on);
    std::uint64_t written() const { return written_; }  ///< bytes of complete rows on disk
    bool open() const { return out_.is_open(); }
    std::string& buffer() { return buffer_; }  ///< complete rows only
    bool full() const { return buffer_.size() >= block; }
    /// Writes the buffer, then `head`, if any, over the beginning of the file. When that fails, the file is
    /// cut after the last complete row.
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
