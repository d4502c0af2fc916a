// Included models as models of the world's own text, and models of several links as models of one.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "bug_interface/world/sdf_entries.h"

namespace forage::bug {

/// Whether an entry is an included model that is found, or a model that split_model() divides.
bool may_unpack(std::string_view text, const Entry& entry);

/// The text in which the element of an included model stands instead of the <include>, with its name and
/// pose.
std::string with_own_model(const std::string& text, const WorldTree& tree, const Entry& entry);

/// The text with a model per link instead of a fixed model of links only. Others are unchanged. `taken`
/// holds the names in the world, and `count` becomes the number of models.
std::string split_model(const std::string& text, const WorldTree& tree, const Entry& entry,
                        std::set<std::string> taken, std::size_t& count);

}  // namespace forage::bug
