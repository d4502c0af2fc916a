// The texts of new items of a world.
#pragma once

#include <string>

#include "bug_interface/world/sdf_edit.h"

namespace forage::bug {

/// The element of a new item, which has a name. A floor in a world that `has_floor` gives only its bounds.
/// Throws std::invalid_argument for an unknown kind.
std::string new_item_text(const NewItem& item, bool has_floor, ModelTexts& models);

}  // namespace forage::bug
