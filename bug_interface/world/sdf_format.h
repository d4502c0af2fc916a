// The formats of a world's files, as tables for the check. They cover the versions of SDF from 1.2 to 1.12.
#pragma once

#include "core/xml/rules.h"

namespace forage::bug {

/// The format of SDF files, which hold worlds and models.
const xml::Format& sdf_format();
/// The format of the file model.config. Its table is empty, as only one of its elements is read.
const xml::Format& model_config_format();

}  // namespace forage::bug
