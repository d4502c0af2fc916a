#include "core/connectivity/distance_functions.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace forage::connectivity {
namespace {

/// The function's values at the distances; `whole` reads the bounds as whole numbers, as delays do.
std::vector<double> evaluate(const model::DistanceFunction& function, std::span<const double> distances,
                             const RandomStream& random, bool whole) {
    const auto bound = [whole](double v) { return whole ? std::trunc(six_digits(v)) : six_digits(v); };
    std::vector<double> out(distances.size());
    if (const auto* uniform = std::get_if<model::UniformFunction>(&function.form)) {
        std::fill(out.begin(), out.end(), std::max(0.0, bound(uniform->value)));
    } else if (const auto* linear = std::get_if<model::LinearFunction>(&function.form)) {
        const double min = bound(linear->min), max = bound(linear->max);
        const double farthest = distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
        const double slope = (max - min) / farthest;
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = slope * distances[i] + min;
    } else if (const auto* gaussian = std::get_if<model::GaussianFunction>(&function.form)) {
        const double min = bound(gaussian->min), max = bound(gaussian->max);
        const double sigma = gaussian->sigma == 0 ? 0.0001 : six_digits(gaussian->sigma);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double d = distances[i];
            out[i] = std::max(0.0, max - std::exp(-(d * d) / (2 * sigma * sigma)) * (max - min) + min);
        }
    } else if (const auto* block = std::get_if<model::BlockFunction>(&function.form)) {
        const double min = bound(block->min), max = bound(block->max);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = distances[i] <= block->width / 2 ? min : max;  // whole half
    } else {
        const double max = bound(std::get<model::RandomFunction>(function.form).max);
        random.uniform(0, out);
        for (double& v : out) v = std::round(v * std::trunc(max * 1e4)) / 1e4;
    }
    return out;
}

}  // namespace

double six_digits(double value) {
    char buffer[32];
    const auto written = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6);
    double out = value;
    std::from_chars(buffer, written.ptr, out);
    return out;
}

Attenuation attenuation(const model::DistanceFunction& function, std::span<const double> distances,
                        const RandomStream& random) {
    Attenuation out{evaluate(function, distances, random, false), 1};
    if (const auto* linear = std::get_if<model::LinearFunction>(&function.form)) {
        out.reference = std::max(six_digits(linear->min), six_digits(linear->max));
    } else if (const auto* block = std::get_if<model::BlockFunction>(&function.form)) {
        out.reference = std::max(six_digits(block->min), six_digits(block->max));
    } else if (std::holds_alternative<model::GaussianFunction>(function.form) && !out.values.empty()) {
        out.reference = *std::max_element(out.values.begin(), out.values.end());
    }
    return out;
}

std::vector<int> delays(const model::DistanceFunction& function, std::span<const double> distances,
                        const RandomStream& random) {
    const bool truncated = std::holds_alternative<model::UniformFunction>(function.form) ||
                           std::holds_alternative<model::BlockFunction>(function.form);
    std::vector<int> out;
    out.reserve(distances.size());
    for (const double v : evaluate(function, distances, random, true)) {
        const double whole = truncated ? std::trunc(v) : std::round(v);         // a half: away from 0
        out.push_back(whole > 0 ? static_cast<int>(std::min(whole, 1e9)) : 0);  // NaN gives 0
    }
    return out;
}

}  // namespace forage::connectivity
