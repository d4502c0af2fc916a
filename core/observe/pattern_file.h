// Lists of patterns for a group, as plain text.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/base/column.h"

namespace forage::observe {

/// Reads patterns of a group of this shape: matrices of `height` rows with `width` numbers each, blanks or
/// commas between numbers and empty lines between patterns; of a sparse group one row with a number per cell.
/// Lines that begin with '#' are skipped. Reports what is wrong, with its place; empty then.
std::vector<std::vector<double>> read_patterns(const std::string& path, const GroupShape& shape,
                                               Diagnostics& diagnostics);
/// The same of a text that a person knows as `path`.
std::vector<std::vector<double>> parse_patterns(const std::string& text, const std::string& path,
                                                const GroupShape& shape, Diagnostics& diagnostics);

}  // namespace forage::observe
