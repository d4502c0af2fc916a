// Whether an SDF file holds what the format says.
#pragma once

#include "core/base/diagnostic.h"
#include "core/xml/element.h"

namespace forage::bug {

/// Says all that is wrong with the outermost element of an SDF file and with what stands in it: its version,
/// values of the wrong form, attributes and elements that are missing; elements that the format does not have
/// are warnings.
void check_sdf(const xml::Element& root, Diagnostics& diagnostics);

}  // namespace forage::bug
