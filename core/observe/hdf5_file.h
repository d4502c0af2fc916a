// Recordings in HDF5.
#pragma once

#include "core/observe/row_file.h"

namespace forage::observe {

/// Whether this build of Forage reads and writes HDF5.
bool has_hdf5();

/// An HDF5 file with one data set of 64-bit floats per source, `/Process/Group/state` of the shape cycles x
/// rows x columns (cycles alone for a mean), with the attributes `name`, `label`, `group_id`, `unit`,
/// `first_column` and `first_row`; and `/cycle`, the cycle of each row, as a dimension scale. The root has
/// the header's attributes. The file is written in HDF5's single-writer mode: after a kill, flushed rows can
/// be read with `h5py.File(name, swmr=True)`, or as usual after `h5clear -s name`. When the disk ran full,
/// HDF5 may not be able to open the file.
///
/// To resume, the rows up to `go_on` are copied into a new file, so that its bytes are those of an
/// uninterrupted recording.
std::unique_ptr<RowFile> open_hdf5_file(const std::string& path, const RowFileHeader& header,
                                        const std::optional<RowFilePosition>& go_on);

}  // namespace forage::observe
