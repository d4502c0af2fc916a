// The properties of what is in a world: how they are read, and how they are written into the text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bug_interface/world/sdf_edit.h"
#include "bug_interface/world/sdf_entries.h"

namespace forage::bug {

std::vector<ItemProperty> properties_of(std::string_view text, const Entry& entry, const ModelTexts& models);

/// Whether a property is written into the element of the world's file; otherwise it belongs to the shape of a
/// model, which may be another file's.
bool is_own(const Entry& entry, std::string_view property);

/// Writes where an entry of the world stands.
void write_pose(SdfEdit& to, const Entry& entry, const PoseText& pose);
/// Writes a property of an entry whose element stands in the world's text. The value fits the property.
void write_property(SdfEdit& to, const Entry& entry, const ItemProperty& property, const std::string& value);

/// "#ff8000" as red, green, blue and opacity of a file. Throws std::invalid_argument for other texts.
std::string colour_text(const std::string& hex);

}  // namespace forage::bug
