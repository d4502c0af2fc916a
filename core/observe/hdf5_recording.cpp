#include "core/observe/hdf5_recording.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/text_file.h"
#include "core/observe/hdf5_handle.h"

namespace forage::observe {
namespace {

std::string text_attribute(hid_t set, const char* name) {
    if (H5Aexists(set, name) <= 0) return {};
    const Hdf5Handle a(H5Aopen(set, name, H5P_DEFAULT), H5Aclose, "read an attribute");
    const Hdf5Handle type(H5Aget_type(a), H5Tclose, "read an attribute");
    std::string out(H5Tget_size(type), '\0');
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || H5Aread(a, type, out.data()) < 0)
        return {};
    out.resize(std::min(out.find('\0'), out.size()));
    return out;
}

int number_attribute(hid_t set, const char* name) {
    int out = 0;
    if (H5Aexists(set, name) <= 0) return out;
    const Hdf5Handle a(H5Aopen(set, name, H5P_DEFAULT), H5Aclose, "read an attribute");
    H5Aread(a, H5T_NATIVE_INT, &out);
    return out;
}

std::vector<hsize_t> shape_of(hid_t set) {
    const Hdf5Handle space(H5Dget_space(set), H5Sclose, "read a shape");
    std::vector<hsize_t> out(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
    H5Sget_simple_extent_dims(space, out.data(), nullptr);
    return out;
}

/// Reads the rows [first, first + count) of a data set.
void read_rows(hid_t set, hid_t type, const std::vector<hsize_t>& shape, hsize_t first, hsize_t count,
               void* out) {
    std::vector<hsize_t> start(shape.size(), 0), extent = shape;
    start[0] = first;
    extent[0] = count;
    const Hdf5Handle space(H5Dget_space(set), H5Sclose, "read");
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
    const Hdf5Handle memory(H5Screate_simple(static_cast<int>(shape.size()), extent.data(), nullptr),
                            H5Sclose, "read");
    if (H5Dread(set, type, memory, space, H5P_DEFAULT, out) < 0)
        throw std::runtime_error("HDF5: cannot read");
}

class Hdf5Recording final : public Recording {
  public:
    Hdf5Recording(std::shared_ptr<Hdf5Handle> file, const std::string& place)
        : file_(std::move(file)),
          cycle_(H5Dopen2(*file_, "/cycle", H5P_DEFAULT), H5Dclose, "find the cycles"),
          set_(H5Dopen2(*file_, place.c_str(), H5P_DEFAULT), H5Dclose, "find " + place),
          shape_(shape_of(set_)),
          cycles_(shape_of(cycle_)) {
        if (cycles_.size() != 1 || (shape_.size() != 1 && shape_.size() != 3) ||
            (shape_.size() == 3 && (shape_[1] < 1 || shape_[2] < 1 || shape_[1] > max_cells ||
                                    shape_[2] > max_cells || shape_[1] * shape_[2] > max_cells)))
            throw std::runtime_error("'" + place + "' is not cells over cycles");
        what_.name = text_attribute(set_, "name");
        what_.label = text_attribute(set_, "label");
        what_.group_id = text_attribute(set_, "group_id");
        what_.state = what_.name.substr(what_.name.rfind(':') + 1);
        what_.mean = shape_.size() == 1;
        what_.numbered = number_attribute(set_, "numbered") != 0;
        what_.cells = {number_attribute(set_, "first_column"),
                       number_attribute(set_, "first_row"),
                       what_.mean ? 1 : static_cast<int>(shape_.at(2)),
                       what_.mean ? 1 : static_cast<int>(shape_.at(1)),
                       {}};
        rows_ = std::min(shape_.at(0), cycles_.at(0));
    }

    void rewind() override { row_ = held_from_ = 0, held_.clear(); }

    bool next(std::uint64_t& cycle, std::vector<double>& numbers) override {
        if (row_ == rows_) return false;
        if (row_ == held_from_ + held_.size()) {
            held_from_ = row_;
            const hsize_t count = std::min<hsize_t>(rows_ - row_, std::max<hsize_t>(1, 65536 / what_.size()));
            held_.resize(count);
            numbers_.resize(count * what_.size());
            read_rows(cycle_, H5T_NATIVE_UINT64, cycles_, row_, count, held_.data());
            read_rows(set_, H5T_NATIVE_DOUBLE, shape_, row_, count, numbers_.data());
        }
        const std::size_t at = row_++ - held_from_;
        cycle = held_[at];
        const auto first = numbers_.begin() + static_cast<std::ptrdiff_t>(at * what_.size());
        numbers.assign(first, first + static_cast<std::ptrdiff_t>(what_.size()));
        return true;
    }

  private:
    static constexpr hsize_t max_cells = 1 << 24;

    std::shared_ptr<Hdf5Handle> file_;
    Hdf5Handle cycle_, set_;
    std::vector<hsize_t> shape_, cycles_;
    hsize_t rows_ = 0, row_ = 0, held_from_ = 0;
    std::vector<std::uint64_t> held_;
    std::vector<double> numbers_;
};

/// Collects the data sets of a file, except those of cycles. The links of a file are visited instead of its
/// objects because this function has the same form in HDF5 1.10 and in later versions.
herr_t note_set(hid_t file, const char* name, const H5L_info_t* link, void* out) {
    if (link->type != H5L_TYPE_HARD || std::string_view(name) == "cycle") return 0;
    const hid_t object = H5Oopen(file, name, H5P_DEFAULT);
    if (object < 0) return 0;
    if (H5Iget_type(object) == H5I_DATASET) static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    H5Oclose(object);
    return 0;
}

}  // namespace

std::vector<std::unique_ptr<Recording>> open_hdf5_recording(const std::string& path) try {
    quiet_hdf5();
    const Hdf5Handle access = hdf5_access();
    hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
    if (id < 0) id = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access);  // of a killed run
    const auto file = std::make_shared<Hdf5Handle>(id, H5Fclose, "read it as HDF5" + hdf5_lock_hint());
    std::vector<std::string> places;
    H5Lvisit(*file, H5_INDEX_NAME, H5_ITER_NATIVE, note_set, &places);
    std::vector<std::unique_ptr<Recording>> out;
    for (const auto& p : places) out.push_back(std::make_unique<Hdf5Recording>(file, p));
    return out;
} catch (const std::exception& e) {
    throw FileError(path, {}, {error_at(0, 0, fmt::format("this is not a recording: {}", e.what()))});
}

}  // namespace forage::observe
