// Columns: one number per cell of a group, in the order of cells (row by row).
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include <Eigen/Core>

namespace forage {

using Index = Eigen::Index;
using Column = Eigen::Map<Eigen::ArrayXd>;
using ConstColumn = Eigen::Map<const Eigen::ArrayXd>;

/// The three ways in which a connection acts on its target.
enum class InputKind { excitatory, inhibitory, modulatory };
inline constexpr int input_kinds = 3;
inline constexpr std::array<const char*, input_kinds> input_kind_names = {"excitatory", "inhibitory",
                                                                          "modulatory"};
inline std::string name_of(InputKind kind) { return input_kind_names[static_cast<std::size_t>(kind)]; }
/// How many inputs a type may have: these, and further ones that it declares (NeuronType::inputs).
inline constexpr int max_inputs = 8;

/// The size of a group: `width` cells to the right, `height` cells downwards; cell = row * width + column.
/// A sparse group has fewer `cells` than width * height.
struct GroupShape {
    int width = 0;
    int height = 0;
    int cells = 0;
    friend bool operator==(const GroupShape&, const GroupShape&) = default;
};

}  // namespace forage
