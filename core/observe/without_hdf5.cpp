// Takes the place of the other files of HDF5 in a build without it.
#include <stdexcept>

#include "core/base/text_file.h"
#include "core/observe/hdf5_file.h"
#include "core/observe/hdf5_recording.h"
#include "core/observe/table_records.h"

namespace forage::observe {
namespace {

constexpr const char* refusal = "this build of Forage has no HDF5";

}  // namespace

bool has_hdf5() { return false; }

std::unique_ptr<RowFile> open_hdf5_file(const std::string&, const RowFileHeader&,
                                        const std::optional<RowFilePosition>&) {
    throw std::runtime_error(refusal);
}

std::vector<std::unique_ptr<Recording>> open_hdf5_recording(const std::string& path) {
    throw FileError(path, {}, {error_at(0, 0, refusal)});
}

void write_hdf5_table(const std::string&, std::span<const TableColumn>, std::size_t) {
    throw std::runtime_error(refusal);
}

}  // namespace forage::observe
