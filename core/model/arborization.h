// How a pair of cells spreads into synapses, and how attenuation and delay depend on the distance.
#pragma once

#include <variant>

#include "core/model/diagnostic.h"

namespace forage::model {

enum class Direction {
    receptive,   ///< RF: spreads around the source cell
    projective,  ///< PF: spreads around the target cell
};

struct RectArbor {
    int width = 1, height = 1;
};
struct EllipseArbor {
    int width = 1, height = 1;
};
/// Outer minus inner rectangle.
struct RectWindowArbor {
    int inner_width = 0, inner_height = 0, outer_width = 1, outer_height = 1;
};
/// Outer minus inner ellipse.
struct EllipseWindowArbor {
    int inner_width = 0, inner_height = 0, outer_width = 1, outer_height = 1;
};
/// Every cell of the group.
struct AllArbor {};
/// `count` distinct cells.
struct RandomArbor {
    int count = 1;
};

struct Arborization {
    std::variant<RectArbor, EllipseArbor, RectWindowArbor, EllipseWindowArbor, AllArbor, RandomArbor> shape;
    Direction direction = Direction::receptive;
    double probability = 1;  ///< each point is kept with this probability
    Location at;
};

/// Functions of the distance in cells, used for attenuation (0: none) and for delay (in cycles).
struct UniformFunction {
    double value = 0;
};
struct LinearFunction {
    double min = 0, max = 1;
};
struct GaussianFunction {
    double min = 0, max = 1, sigma = 1;
};
struct BlockFunction {
    double min = 0, max = 1;
    int width = 0;
    int height = 0;  ///< read and written, without effect
};
struct RandomFunction {
    double max = 1;
};

/// Longest delay in cycles; a longer one is more likely a mistake, and costs memory for every cell and cycle.
inline constexpr int most_delay = 100'000;

struct DistanceFunction {
    std::variant<UniformFunction, LinearFunction, GaussianFunction, BlockFunction, RandomFunction> form;
    Location at;
};

}  // namespace forage::model
