// Recordings in HDF5.
#pragma once

#include "core/observe/row_file.h"

namespace forage::observe {

/// A data set of 64-bit floats per source, `/Process/Group/state` of the shape cycles x rows x columns
/// (cycles alone for a mean), with the attributes `name`, `label`, `group_id`, `unit`, `first_column` and
/// `first_row`; and `/cycle`, the cycle of each row, as dimension scale. The header's attributes are those of
/// the root. The file is written in HDF5's single-writer mode: what was flushed can be read after a kill,
/// with `h5py.File(name, swmr=True)`, or like any other after `h5clear -s name`. A disk that runs full may
/// leave a file that HDF5 does not open.
///
/// To go on, the rows up to `go_on` are copied into a file that is written as if from the start: then the
/// bytes are those of a file that was never left.
std::unique_ptr<RowFile> open_hdf5_file(const std::string& path, const RowFileHeader& header,
                                        const std::optional<RowFilePosition>& go_on);

}  // namespace forage::observe
