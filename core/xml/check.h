// Checks a document's elements and attributes against the format table.
#pragma once

#include "core/xml/document.h"

namespace forage::xml {

/// Checks a document that is to begin with the element `root`: System, iqrEntity or experiment. Reports
/// elements and attributes that the format does not have, that are missing, or whose values are none. Returns
/// whether a model can be made of the document that is wrong only where that was reported, so that it is
/// worth checking further.
bool check(const Document& document, std::string_view root, Diagnostics& diagnostics);

}  // namespace forage::xml
