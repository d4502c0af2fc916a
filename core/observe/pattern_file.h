// Lists of patterns for a group, as plain text.
#pragma once

#include <string>
#include <vector>

#include "core/base/column.h"
#include "core/base/diagnostic.h"

namespace forage::observe {

/// Reads patterns of a group of this shape: matrices of `height` rows with `width` numbers each, blanks or
/// commas between numbers and empty lines between patterns; of a sparse group one row with a number per cell.
/// Lines that begin with '#' are skipped. Reports mistakes with their places, and is empty then.
std::vector<std::vector<double>> read_patterns(const std::string& path, const GroupShape& shape,
                                               Diagnostics& diagnostics);
/// Reads patterns from a text. `path` is its name in messages.
std::vector<std::vector<double>> parse_patterns(const std::string& text, const std::string& path,
                                                const GroupShape& shape, Diagnostics& diagnostics);
/// The text of such a file. Every number is read back as the same one.
std::string patterns_text(const std::vector<std::vector<double>>& patterns, const GroupShape& shape);

}  // namespace forage::observe
