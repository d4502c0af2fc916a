// Reads the files that hdf5_file.h writes.
#pragma once

#include "core/observe/recording.h"

namespace forage::observe {

std::vector<std::unique_ptr<Recording>> open_hdf5_recording(const std::string& path);

}  // namespace forage::observe
