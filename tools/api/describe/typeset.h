// Equations as mathematics, for LaTeX and for Markdown that shows it (MathJax).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace forage {

/// A name of the equations: "tau" is a Greek letter, "g_Na" has an index, "post.v" belongs to the target.
std::string typeset_name(std::string_view name);

/// The equations of a type in math mode, one string each; they use amsmath. Changes under the same `when` are
/// one of them. Throws FormulaError.
std::vector<std::string> typeset_equations(const std::vector<std::string>& lines);

}  // namespace forage
