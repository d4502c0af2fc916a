// The elements and attributes of experiment files, and the members of the model that hold their values. The
// check, the schema and the reader use this table.
#pragma once

#include "core/xml/attributes.h"

namespace forage::xml {

const std::vector<ElementRow>& experiment_elements();

}  // namespace forage::xml
