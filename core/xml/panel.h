// Files of the original about chosen parameters: which ones a panel shows (.hconf), and sets of values
// (.pconf).
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::xml {

/// A parameter of an item, by the id of the group, process or connection.
struct PanelRow {
    std::string type;  ///< GROUP, PROCESS or CONNECTION; not needed, as ids are unique
    std::string id, parameter, label;
    std::string value;  ///< of a .pconf only
    Location at;
};

/// Reads <HarborConfig> of <ParamTrade>, or <ParamSet> of <Parameter>, from a text with the name `path`.
/// Reports mistakes with their places.
std::vector<PanelRow> parse_panel(const std::string& path, const std::string& text, Diagnostics& diagnostics);
/// The text of such a file: with values a .pconf, otherwise a .hconf.
std::string panel_text(const std::vector<PanelRow>& rows, bool values);

}  // namespace forage::xml
