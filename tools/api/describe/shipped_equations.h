// The equations of the types that ship, in the language of types that a system declares.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace forage {

/// The equations of a neuron or synapse type that ships, a line each. Empty when equations of one cell cannot
/// say what it computes (neuronTDValue), and for other types.
std::vector<std::string> shipped_equations(std::string_view type);

}  // namespace forage
