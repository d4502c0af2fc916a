#include "core/observe/hdf5_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <hdf5_hl.h>
#include <unistd.h>

#include "core/observe/disk_space.h"
#include "core/observe/hdf5_recording.h"
#include "core/observe/hdf5_set.h"

namespace forage::observe {
namespace {

constexpr std::size_t rows_block = 1 << 16;  ///< bytes of rows that are written together
constexpr std::uint64_t index_space =
    1 << 18;  ///< bytes that HDF5 writes at most in addition to the rows, until the file is closed

/// "Process/Group:state(1..3,2)" -> "/Process/Group/state(1..3,2)"
std::string place_of(const Recorded& what) {
    std::string out = what.name;
    if (what.one_number()) out = out.substr(out.find(':') + 1) + " " + std::string(what.reduction);
    out[out.rfind(':')] = '/';
    return "/" + out;
}

class Hdf5File final : public RowFile {
  public:
    Hdf5File(const std::string& path, const RowFileHeader& header) : path_(path) {
        file_ = create_hdf5(path);
        space_.emplace(path);
        try {
            reserve(0);
        } catch (const std::exception& e) {
            std::filesystem::remove(path);
            throw std::runtime_error(fmt::format("cannot write '{}': {}", path, e.what()));
        }
        for (const auto& [name, text] : header.attributes) add_attribute(file_, name, text);
        std::size_t row = 1;
        for (const auto& s : header.sources) row += s.size();
        chunk_ = std::max<std::size_t>(1, rows_block / (8 * row));
        cycle_.emplace(file_, "/cycle", H5T_STD_U64LE, H5T_NATIVE_UINT64, std::vector<hsize_t>{}, chunk_);
        H5DSset_scale(cycle_->id(), "cycle");
        add_attribute(cycle_->id(), "unit", "cycle");
        add_attribute(cycle_->id(), "every", static_cast<std::int64_t>(header.every));
        for (const auto& s : header.sources) add_source(s);
        check_hdf5(H5Fstart_swmr_write(file_), "write '" + path + "'");
    }

    void add(std::uint64_t cycle, std::span<const double> numbers) override {
        cycles_.push_back(cycle);
        for (auto& s : sets_) {
            s.rows.insert(s.rows.end(), numbers.begin(),
                          numbers.begin() + static_cast<std::ptrdiff_t>(s.size));
            numbers = numbers.subspan(s.size);
        }
        // Rows are flushed at the end of a chunk, so that the order of chunks in the file does not depend on
        // other flushes.
        if (++rows_ % chunk_ == 0) flush();
    }

    void flush() override {
        if (cycles_.empty() || file_ < 0) return;
        try {
            reserve(cycles_.size());
            for (auto& s : sets_) s.set.append(s.rows.data(), cycles_.size()), s.rows.clear();
            cycle_->append(cycles_.data(), cycles_.size());  // last, when the rows that it counts are written
            cycles_.clear();
        } catch (const std::exception& e) {
            end();
            throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, e.what()));
        }
    }

    RowFilePosition position() const override { return {rows_, 0}; }

    void close() override {
        flush();
        if (file_ >= 0 && !end()) throw std::runtime_error(fmt::format("cannot write '{}'", path_));
    }

  private:
    struct Set {
        GrowingSet set;
        std::size_t size;
        std::vector<double> rows;
    };

    void add_source(const Recorded& s) {
        std::vector<hsize_t> row;
        if (!s.one_number())
            row = {static_cast<hsize_t>(s.cells.height), static_cast<hsize_t>(s.cells.width)};
        sets_.push_back(
            {GrowingSet(file_, place_of(s), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, row, chunk_), s.size(), {}});
        const hid_t set = sets_.back().set.id();
        add_attribute(set, "name", s.name);
        add_attribute(set, "label", s.label);
        add_attribute(set, "group_id", s.group_id);
        add_attribute(set, "unit", "1");
        add_attribute(set, "first_column", s.cells.x);
        add_attribute(set, "first_row", s.cells.y);
        add_attribute(set, "numbered", s.numbered);
        H5DSattach_scale(set, cycle_->id(), 0);
        static constexpr std::array<const char*, 3> dimensions = {"cycle", "row", "column"};
        for (unsigned d = 0; d <= row.size(); ++d) H5DSset_label(set, d, dimensions[d]);
    }

    /// The space for the rows of a chunk, the data that HDF5 adds, and closing the file.
    void reserve(std::size_t rows) {
        std::uint64_t row = 1;
        for (const auto& s : sets_) row += s.size;
        space_->reserve(8 * row * (rows + 2 * chunk_) + index_space * (1 + sets_.size()));
    }

    bool end() {
        sets_.clear();
        cycle_.reset();
        const bool fine = file_.close();
        space_.reset();
        return fine;
    }

    std::string path_;
    std::optional<DiskSpace> space_;
    Hdf5Handle file_;
    std::optional<GrowingSet> cycle_;
    std::vector<Set> sets_;
    std::vector<std::uint64_t> cycles_;
    std::size_t chunk_ = 1;  ///< number of rows of a chunk, in all data sets
    std::uint64_t rows_ = 0;
};

/// Copies the first `count` rows of the file at `from`, which has the sources of `header`.
void copy_rows(const std::string& from, const RowFileHeader& header, std::uint64_t count, RowFile& to) {
    const auto recordings = open_hdf5_recording(from);
    std::vector<Recording*> sources;
    for (const auto& s : header.sources)
        for (const auto& r : recordings)
            if (r->what().name == s.name && r->what().reduction == s.reduction &&
                r->what().size() == s.size() && r->what().group_id == s.group_id)
                sources.push_back(r.get());
    if (sources.size() != header.sources.size())
        throw std::runtime_error(fmt::format("'{}' is not the recording of this run", from));
    std::vector<double> row, part;
    for (std::uint64_t i = 0; i < count; ++i) {
        std::uint64_t cycle = 0;
        row.clear();
        for (Recording* s : sources) {
            if (!s->next(cycle, part))
                throw ShortFile(fmt::format("'{}' has {} rows, and should have {} at least", from, i, count));
            row.insert(row.end(), part.begin(), part.end());
        }
        to.add(cycle, row);
    }
}

}  // namespace

bool has_hdf5() { return true; }

std::unique_ptr<RowFile> open_hdf5_file(const std::string& path, const RowFileHeader& header,
                                        const std::optional<RowFilePosition>& go_on) {
    if (!go_on) return std::make_unique<Hdf5File>(path, header);
    const std::string again = path + ".again";
    auto file = std::make_unique<Hdf5File>(again, header);
    copy_rows(path, header, go_on->rows, *file);
    file->flush();  // a checkpoint refers to these rows
    const int written = open(again.c_str(), O_RDONLY | O_CLOEXEC);
    if (written < 0 || fsync(written) != 0 || close(written) != 0)
        throw std::runtime_error(fmt::format("cannot write '{}': {}", again, std::strerror(errno)));
    std::filesystem::rename(again, path);
    return file;
}

}  // namespace forage::observe
