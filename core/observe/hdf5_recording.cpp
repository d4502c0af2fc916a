#include "core/observe/hdf5_recording.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "core/base/text_file.h"
#include "core/observe/hdf5_handle.h"

namespace forage::observe {
namespace {

constexpr int max_depth = 32;                  ///< of groups in groups; recordings need three
constexpr std::size_t max_text = 1 << 16;      ///< bytes of an attribute
constexpr std::uint64_t bytes_of_a_link = 16;  ///< in a file, at least

/// An attribute that is a single text or number; empty when there is none.
std::optional<Hdf5Handle> single_attribute(hid_t set, const char* name) {
    if (H5Aexists(set, name) <= 0) return {};
    Hdf5Handle a(H5Aopen(set, name, H5P_DEFAULT), H5Aclose, "read an attribute");
    const Hdf5Handle space(H5Aget_space(a), H5Sclose, "read an attribute");
    if (H5Sget_simple_extent_npoints(space) != 1) return {};
    return a;
}

std::string text_attribute(hid_t set, const char* name) {
    const auto a = single_attribute(set, name);
    if (!a) return {};
    const Hdf5Handle type(H5Aget_type(*a), H5Tclose, "read an attribute");
    const std::size_t size = H5Tget_size(type);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || size > max_text) return {};
    std::string out(size, '\0');
    if (H5Aread(*a, type, out.data()) < 0) return {};
    out.resize(std::min(out.find('\0'), out.size()));
    return out;
}

int number_attribute(hid_t set, const char* name) {
    int out = 0;
    if (const auto a = single_attribute(set, name)) H5Aread(*a, H5T_NATIVE_INT, &out);
    return out;
}

/// Opens a data set of numbers that the file itself holds, unfiltered: HDF5 reads no other file, and
/// unpacks nothing.
Hdf5Handle open_set(hid_t file, const std::string& place) {
    Hdf5Handle out(H5Dopen2(file, place.c_str(), H5P_DEFAULT), H5Dclose, "find '" + place + "'");
    const Hdf5Handle made(H5Dget_create_plist(out), H5Pclose, "read how '" + place + "' is stored");
    if (H5Pget_external_count(made) != 0 || H5Pget_layout(made) == H5D_VIRTUAL)
        throw std::runtime_error("the numbers of '" + place + "' are in other files");
    if (H5Pget_nfilters(made) != 0)
        throw std::runtime_error("'" + place + "' is compressed; 'h5repack -f NONE' unpacks a file");
    const Hdf5Handle type(H5Dget_type(out), H5Tclose, "read a type");
    if (const auto kind = H5Tget_class(type); kind != H5T_INTEGER && kind != H5T_FLOAT)
        throw std::runtime_error("'" + place + "' does not hold numbers");
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
          cycle_(open_set(*file_, "/cycle")),
          set_(open_set(*file_, place)),
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
        if (shape_.size() == 1) what_.reduction = what_.name.starts_with("max:") ? "max" : "mean";
        what_.numbered = number_attribute(set_, "numbered") != 0;
        what_.cells = {number_attribute(set_, "first_column"),
                       number_attribute(set_, "first_row"),
                       what_.one_number() ? 1 : static_cast<int>(shape_.at(2)),
                       what_.one_number() ? 1 : static_cast<int>(shape_.at(1)),
                       {}};
        for (const int first : {what_.cells.x, what_.cells.y})
            if (first < 0 || static_cast<hsize_t>(first) > max_cells)
                throw std::runtime_error("'" + place + "' has impossible cells");
        rows_ = std::min(shape_.at(0), cycles_.at(0));
        const Hdf5Handle type(H5Dget_type(set_), H5Tclose, "read a type");
        claimed_ = static_cast<double>(rows_) * static_cast<double>(what_.size() * H5Tget_size(type));
        if (claimed_ > static_cast<double>(H5Dget_storage_size(set_)))
            throw std::runtime_error(
                fmt::format("'{}' claims {} rows, and not all of them are there", place, rows_));
    }
    double claimed() const { return claimed_; }  ///< bytes of all rows in the file, if they are there

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
    double claimed_ = 0;
    hsize_t rows_ = 0, row_ = 0, held_from_ = 0;
    std::vector<std::uint64_t> held_;
    std::vector<double> numbers_;
};

/// Finds the data sets of a file. Links to other places and to other files are not followed.
class SetFinder {
  public:
    explicit SetFinder(std::uint64_t file_size) : links_left_(file_size / bytes_of_a_link) {}

    void visit(hid_t group, const std::string& path, int depth) {
        if (depth > max_depth)
            throw std::runtime_error(fmt::format("its groups are nested more than {} deep", max_depth));
        Links links;
        // Links are visited instead of objects because this function has the same form in HDF5 1.10 and in
        // later versions.
        H5Literate(group, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, note_link, &links);
        const auto& names = links.names;
        if (other_link_.empty() && !links.other.empty())
            other_link_ = fmt::format("'{}' is a link to another {}", path + links.other, links.place);
        if (names.size() > links_left_) throw std::runtime_error("it claims more groups than it can hold");
        links_left_ -= names.size();
        for (const auto& name : names) {
            const hid_t id = H5Oopen(group, name.c_str(), H5P_DEFAULT);
            if (id < 0) continue;
            const Hdf5Handle object(id, H5Oclose, "read it");
            if (H5Iget_type(object) == H5I_GROUP) {
                visit(object, path + name + "/", depth + 1);
            } else if (H5Iget_type(object) == H5I_DATASET) {
                if (path == "/" && name == "cycle")
                    has_cycles_ = true;
                else
                    places_.push_back(path + name);
            }
        }
    }
    const std::vector<std::string>& places() const { return places_; }
    bool has_cycles() const { return has_cycles_; }
    /// The first link that was not followed, in words; empty when there is none.
    const std::string& other_link() const { return other_link_; }

  private:
    /// The links in a group.
    struct Links {
        std::vector<std::string> names;  ///< those of its own objects
        std::string other;               ///< the first other one
        const char* place = nullptr;     ///< where that leads
    };
    static herr_t note_link(hid_t, const char* name, const H5L_info_t* link, void* found) {
        auto& links = *static_cast<Links*>(found);
        if (link->type == H5L_TYPE_HARD)
            links.names.emplace_back(name);
        else if (links.other.empty())
            links.other = name, links.place = link->type == H5L_TYPE_SOFT ? "place" : "file";
        return 0;
    }

    std::uint64_t links_left_;
    std::vector<std::string> places_;
    bool has_cycles_ = false;
    std::string other_link_;
};

}  // namespace

std::vector<std::unique_ptr<Recording>> open_hdf5_recording(const std::string& path) try {
    quiet_hdf5();
    const Hdf5Handle access = hdf5_access();
    hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
    if (id < 0) id = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access);  // of a killed run
    const auto file = std::make_shared<Hdf5Handle>(id, H5Fclose, "read it as HDF5" + hdf5_lock_hint());
    SetFinder sets(std::filesystem::file_size(path));
    sets.visit(*file, "/", 0);
    if ((!sets.has_cycles() || sets.places().empty()) && !sets.other_link().empty())
        throw std::runtime_error(sets.other_link() + "; Forage does not follow it");
    if (!sets.has_cycles() && !sets.places().empty()) throw std::runtime_error("it has no data set 'cycle'");
    std::vector<std::unique_ptr<Recording>> out;
    double claimed = 0;
    for (const auto& p : sets.places()) {
        auto recording = std::make_unique<Hdf5Recording>(file, p);
        claimed += recording->claimed();
        out.push_back(std::move(recording));
    }
    if (const auto size = std::filesystem::file_size(path); claimed > static_cast<double>(size))
        throw std::runtime_error(
            fmt::format("it claims to hold {:.0f} bytes of numbers, and has {} bytes", claimed, size));
    return out;
} catch (const std::exception& e) {
    throw FileError(path, {}, {error_at(0, 0, fmt::format("this is not a recording: {}", e.what()))});
}

}  // namespace forage::observe
