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
#include "core/observe/hdf5_handle.h"
#include "core/observe/hdf5_recording.h"

namespace forage::observe {
namespace {

constexpr std::size_t rows_block = 1 << 16;  ///< bytes of rows that are written together
constexpr std::uint64_t index_space =
    1 << 18;  ///< bytes that HDF5 writes at most in addition to the rows, until the file is closed

void check(herr_t status, const std::string& what) {
    if (status < 0) throw std::runtime_error(fmt::format("HDF5: cannot {}", what));
}

void attribute(hid_t object, const std::string& name, const std::string& text) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a type");
    H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
    H5Tset_cset(type, H5T_CSET_UTF8);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "make a space");
    const Hdf5Handle a(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                       "add attribute " + name);
    check(H5Awrite(a, type, text.empty() ? "\0" : text.data()), "write attribute " + name);
}

void attribute(hid_t object, const std::string& name, std::int64_t value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "make a space");
    const Hdf5Handle a(H5Acreate2(object, name.c_str(), H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose, "add attribute " + name);
    check(H5Awrite(a, H5T_NATIVE_INT64, &value), "write attribute " + name);
}

/// "Process/Group:state(1..3,2)" -> "/Process/Group/state(1..3,2)"
std::string place_of(const Recorded& what) {
    std::string out = what.name;
    if (what.mean) out = out.substr(out.find(':') + 1) + " mean";
    out[out.rfind(':')] = '/';
    return "/" + out;
}

/// Creates the groups above `place`, without times, so that the same run gives the same bytes.
void add_groups(hid_t file, const std::string& place) {
    const Hdf5Handle options(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "make a list");
    H5Pset_obj_track_times(options, false);
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "make a list");
    H5Pset_char_encoding(links, H5T_CSET_UTF8);
    for (auto slash = place.find('/', 1); slash != std::string::npos; slash = place.find('/', slash + 1)) {
        const std::string group = place.substr(0, slash);
        if (H5Lexists(file, group.c_str(), H5P_DEFAULT) <= 0)
            Hdf5Handle(H5Gcreate2(file, group.c_str(), links, options, H5P_DEFAULT), H5Gclose,
                       "add " + group);
    }
}

/// A data set that grows along its first dimension.
class Growing {
  public:
    Growing(hid_t file, const std::string& place, hid_t disk_type, hid_t memory_type,
            std::vector<hsize_t> row, std::size_t rows_of_a_chunk)
        : memory_type_(memory_type), shape_{0} {
        shape_.insert(shape_.end(), row.begin(), row.end());
        std::vector<hsize_t> most = shape_, chunk = shape_;
        most[0] = H5S_UNLIMITED;
        chunk[0] = rows_of_a_chunk;
        const Hdf5Handle space(H5Screate_simple(rank(), shape_.data(), most.data()), H5Sclose,
                               "make a space");
        add_groups(file, place);
        const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "make a list");
        H5Pset_char_encoding(links, H5T_CSET_UTF8);
        const Hdf5Handle options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make a list");
        H5Pset_obj_track_times(options, false);
        H5Pset_chunk(options, rank(), chunk.data());
        set_ = {H5Dcreate2(file, place.c_str(), disk_type, space, links, options, H5P_DEFAULT), H5Dclose,
                "add " + place};
    }
    hid_t id() const { return set_; }

    void append(const void* rows, hsize_t count) {
        std::vector<hsize_t> start(shape_.size(), 0), extent = shape_;
        start[0] = shape_[0];
        extent[0] = count;
        shape_[0] += count;
        check(H5Dset_extent(set_, shape_.data()), "grow");
        const Hdf5Handle space(H5Dget_space(set_), H5Sclose, "grow");
        check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr),
              "grow");
        const Hdf5Handle memory(H5Screate_simple(rank(), extent.data(), nullptr), H5Sclose, "grow");
        check(H5Dwrite(set_, memory_type_, memory, space, H5P_DEFAULT, rows), "write");
        check(H5Dflush(set_), "write");
    }

  private:
    int rank() const { return static_cast<int>(shape_.size()); }
    Hdf5Handle set_;
    hid_t memory_type_;
    std::vector<hsize_t> shape_;
};

class Hdf5File final : public RowFile {
  public:
    Hdf5File(const std::string& path, const RowFileHeader& header) : path_(path) {
        quiet_hdf5();
        const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a list");
        H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
        const Hdf5Handle options(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make a list");
        H5Pset_obj_track_times(options, false);
        file_ = {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, options, access), H5Fclose, "write '" + path + "'"};
        space_.emplace(path);
        try {
            reserve(0);
        } catch (const std::exception& e) {
            std::filesystem::remove(path);
            throw std::runtime_error(fmt::format("cannot write '{}': {}", path, e.what()));
        }
        for (const auto& [name, text] : header.attributes) attribute(file_, name, text);
        std::size_t row = 1;
        for (const auto& s : header.sources) row += s.size();
        chunk_ = std::max<std::size_t>(1, rows_block / (8 * row));
        cycle_.emplace(file_, "/cycle", H5T_STD_U64LE, H5T_NATIVE_UINT64, std::vector<hsize_t>{}, chunk_);
        H5DSset_scale(cycle_->id(), "cycle");
        attribute(cycle_->id(), "unit", "cycle");
        attribute(cycle_->id(), "every", static_cast<std::int64_t>(header.every));
        for (const auto& s : header.sources) add_source(s);
        check(H5Fstart_swmr_write(file_), "write '" + path + "'");
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
        Growing set;
        std::size_t size;
        std::vector<double> rows;
    };

    void add_source(const Recorded& s) {
        std::vector<hsize_t> row;
        if (!s.mean) row = {static_cast<hsize_t>(s.cells.height), static_cast<hsize_t>(s.cells.width)};
        sets_.push_back(
            {Growing(file_, place_of(s), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, row, chunk_), s.size(), {}});
        const hid_t set = sets_.back().set.id();
        attribute(set, "name", s.name);
        attribute(set, "label", s.label);
        attribute(set, "group_id", s.group_id);
        attribute(set, "unit", "1");
        attribute(set, "first_column", s.cells.x);
        attribute(set, "first_row", s.cells.y);
        attribute(set, "numbered", s.numbered);
        H5DSattach_scale(set, cycle_->id(), 0);
        static constexpr std::array<const char*, 3> dimensions = {"cycle", "row", "column"};
        for (unsigned d = 0; d <= row.size(); ++d) H5DSset_label(set, d, dimensions[d]);
    }

    /// The space for the rows of a chunk, the data that HDF5 adds, and closing the file.
    void reserve(std::size_t rows) {
        std::uint64_t row = 1;
        for (const auto& s : sets_) row += s.size;
        space_->ahead(8 * row * (rows + 2 * chunk_) + index_space * (1 + sets_.size()));
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
    std::optional<Growing> cycle_;
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
            if (r->what().name == s.name && r->what().mean == s.mean && r->what().size() == s.size() &&
                r->what().group_id == s.group_id)
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
