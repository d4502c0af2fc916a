#include "core/observe/hdf5_set.h"

#include <algorithm>

namespace forage::observe {
namespace {

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

void add_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "make a space");
    const Hdf5Handle a(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                       "add attribute " + name);
    check_hdf5(H5Awrite(a, type, value), "write attribute " + name);
}

}  // namespace

void check_hdf5(herr_t status, const std::string& what) {
    if (status < 0) throw std::runtime_error(fmt::format("HDF5: cannot {}", what));
}

Hdf5Handle hdf5_text(std::size_t bytes) {
    Hdf5Handle out(H5Tcopy(H5T_C_S1), H5Tclose, "make a type");
    H5Tset_size(out, std::max<std::size_t>(bytes, 1));
    H5Tset_cset(out, H5T_CSET_UTF8);
    H5Tset_strpad(out, H5T_STR_NULLPAD);
    return out;
}

void add_attribute(hid_t object, const std::string& name, const std::string& text) {
    add_attribute(object, name, hdf5_text(text.size()), text.empty() ? "\0" : text.data());
}

void add_attribute(hid_t object, const std::string& name, std::int64_t value) {
    add_attribute(object, name, H5T_STD_I64LE, &value);  // as it lies in memory
}

Hdf5Handle create_hdf5(const std::string& path) {
    quiet_hdf5();
    const Hdf5Handle access = hdf5_access();
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
    const Hdf5Handle options(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make a list");
    H5Pset_obj_track_times(options, false);
    return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, options, access), H5Fclose,
            "write '" + path + "'" + hdf5_lock_hint()};
}

GrowingSet::GrowingSet(hid_t file, const std::string& place, hid_t disk_type, hid_t memory_type,
                       std::vector<hsize_t> row, std::size_t rows_of_a_chunk)
    : memory_type_(memory_type), shape_{0} {
    shape_.insert(shape_.end(), row.begin(), row.end());
    std::vector<hsize_t> most = shape_, chunk = shape_;
    most[0] = H5S_UNLIMITED;
    chunk[0] = rows_of_a_chunk;
    const Hdf5Handle space(H5Screate_simple(rank(), shape_.data(), most.data()), H5Sclose, "make a space");
    add_groups(file, place);
    const Hdf5Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "make a list");
    H5Pset_char_encoding(links, H5T_CSET_UTF8);
    const Hdf5Handle options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make a list");
    H5Pset_obj_track_times(options, false);
    H5Pset_chunk(options, rank(), chunk.data());
    set_ = {H5Dcreate2(file, place.c_str(), disk_type, space, links, options, H5P_DEFAULT), H5Dclose,
            "add " + place};
}

void GrowingSet::append(const void* rows, hsize_t count) {
    std::vector<hsize_t> start(shape_.size(), 0), extent = shape_;
    start[0] = shape_[0];
    extent[0] = count;
    shape_[0] += count;
    check_hdf5(H5Dset_extent(set_, shape_.data()), "grow");
    const Hdf5Handle space(H5Dget_space(set_), H5Sclose, "grow");
    check_hdf5(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr),
               "grow");
    const Hdf5Handle memory(H5Screate_simple(rank(), extent.data(), nullptr), H5Sclose, "grow");
    check_hdf5(H5Dwrite(set_, memory_type_, memory, space, H5P_DEFAULT, rows), "write");
    check_hdf5(H5Dflush(set_), "write");
}

}  // namespace forage::observe
