// Checks a document's elements and attributes against the format table.
#pragma once

#include "core/xml/document.h"

namespace forage::xml {

/// Reports elements and attributes that the format does not have, that are missing, or whose values are none.
void check(const Document& document, Diagnostics& diagnostics);

}  // namespace forage::xml
