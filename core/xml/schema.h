// The format as a schema, so that editors complete and check system files.
#pragma once

#include <string>

#include "core/types/registry.h"

namespace forage::xml {

/// A RELAX NG grammar of .iqr and .iqrProcess files, made from the format table and the types of `registry`:
/// elements, attributes and their ranges, and for each type its parameters and cross references, with their
/// documentation.
std::string relax_ng(const Registry& registry);

}  // namespace forage::xml
