// How a pair of cells spreads into synapses, and how attenuation and delay depend on the distance.
#pragma once

#include <variant>

#include "core/base/diagnostic.h"
#include "core/model/number_formula.h"

namespace forage::model {

enum class Direction {
    receptive,   ///< RF: spreads around the source cell
    projective,  ///< PF: spreads around the target cell
};

struct RectArbor {
    int width = 1, height = 1;
    Formulas<RectArbor> formulas = {};
    friend bool operator==(const RectArbor&, const RectArbor&) = default;
};
struct EllipseArbor {
    int width = 1, height = 1;
    Formulas<EllipseArbor> formulas = {};
    friend bool operator==(const EllipseArbor&, const EllipseArbor&) = default;
};
/// The cells of the outer rectangle that are not in the inner one.
struct RectWindowArbor {
    int inner_width = 0, inner_height = 0, outer_width = 1, outer_height = 1;
    Formulas<RectWindowArbor> formulas = {};
    friend bool operator==(const RectWindowArbor&, const RectWindowArbor&) = default;
};
/// The cells of the outer ellipse that are not in the inner one.
struct EllipseWindowArbor {
    int inner_width = 0, inner_height = 0, outer_width = 1, outer_height = 1;
    Formulas<EllipseWindowArbor> formulas = {};
    friend bool operator==(const EllipseWindowArbor&, const EllipseWindowArbor&) = default;
};
/// Every cell of the group.
struct AllArbor {
    friend bool operator==(const AllArbor&, const AllArbor&) = default;
};
/// `count` distinct cells of the group, drawn at random for each pair.
struct RandomArbor {
    int count = 1;
    Formulas<RandomArbor> formulas = {};
    friend bool operator==(const RandomArbor&, const RandomArbor&) = default;
};

struct Arborization {
    std::variant<RectArbor, EllipseArbor, RectWindowArbor, EllipseWindowArbor, AllArbor, RandomArbor> shape;
    Direction direction = Direction::receptive;
    double probability = 1;  ///< probability with which each synapse is kept, 0..1
    Location at;
    Formulas<Arborization> formulas = {};
    friend bool operator==(const Arborization&, const Arborization&) = default;
};

/// Functions of the distance in cells, used for attenuation (0: none) and for delay (in cycles).
struct UniformFunction {
    double value = 0;
    Formulas<UniformFunction> formulas = {};
    friend bool operator==(const UniformFunction&, const UniformFunction&) = default;
};
struct LinearFunction {
    double min = 0, max = 1;
    Formulas<LinearFunction> formulas = {};
    friend bool operator==(const LinearFunction&, const LinearFunction&) = default;
};
struct GaussianFunction {
    double min = 0, max = 1, sigma = 1;
    Formulas<GaussianFunction> formulas = {};
    friend bool operator==(const GaussianFunction&, const GaussianFunction&) = default;
};
struct BlockFunction {
    double min = 0, max = 1;
    int width = 0;
    int height = 0;  ///< is read and written, but has no effect
    Formulas<BlockFunction> formulas = {};
    friend bool operator==(const BlockFunction&, const BlockFunction&) = default;
};
struct RandomFunction {
    double max = 1;
    Formulas<RandomFunction> formulas = {};
    friend bool operator==(const RandomFunction&, const RandomFunction&) = default;
};

/// The longest delay that is accepted, in cycles. A longer one is more likely a mistake, and costs memory for
/// every cell and cycle.
inline constexpr int max_delay = 100'000;

struct DistanceFunction {
    std::variant<UniformFunction, LinearFunction, GaussianFunction, BlockFunction, RandomFunction> form;
    Location at;
    friend bool operator==(const DistanceFunction&, const DistanceFunction&) = default;
};

}  // namespace forage::model
