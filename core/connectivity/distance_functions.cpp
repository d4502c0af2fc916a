#include "core/connectivity/distance_functions.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/number.h"

namespace forage::connectivity {
namespace {

/// Calls take(i, value) with the function's value at each distance. With `whole`, the bounds are read as
/// whole numbers, as for delays.
template <class Take>
void evaluate(const model::DistanceFunction& function, std::span<const double> distances,
              const RandomStream& random, bool whole, Take take) {
    const auto bound = [whole](double v) { return whole ? std::trunc(six_digits(v)) : six_digits(v); };
    const std::size_t n = distances.size();
    if (const auto* uniform = std::get_if<model::UniformFunction>(&function.form)) {
        const double value = std::max(0.0, bound(uniform->value));
        for (std::size_t i = 0; i < n; ++i) take(i, value);
    } else if (const auto* linear = std::get_if<model::LinearFunction>(&function.form)) {
        const double min = bound(linear->min), max = bound(linear->max);
        const double farthest = distances.empty() ? 0 : *std::ranges::max_element(distances);
        const double slope = (max - min) / farthest;
        for (std::size_t i = 0; i < n; ++i) take(i, slope * distances[i] + min);
    } else if (const auto* gaussian = std::get_if<model::GaussianFunction>(&function.form)) {
        const double min = bound(gaussian->min), max = bound(gaussian->max);
        const double sigma = gaussian->sigma == 0 ? 0.0001 : six_digits(gaussian->sigma);
        for (std::size_t i = 0; i < n; ++i) {
            const double d = distances[i];
            take(i, std::max(0.0, max - std::exp(-(d * d) / (2 * sigma * sigma)) * (max - min) + min));
        }
    } else if (const auto* block = std::get_if<model::BlockFunction>(&function.form)) {
        const double min = bound(block->min), max = bound(block->max);
        for (std::size_t i = 0; i < n; ++i)
            take(i, distances[i] <= block->width / 2 ? min : max);  // integer division, as in the original
    } else {
        const double scale = std::trunc(bound(std::get<model::RandomFunction>(function.form).max) * 1e4);
        for (std::size_t i = 0; i < n; ++i)
            take(i, std::round(random.uniform(0, static_cast<std::uint32_t>(i)) * scale) / 1e4);
    }
}

}  // namespace

double six_digits(double value) {
    char buffer[32];
    const auto written = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6);
    return parse_number<double>({buffer, written.ptr}).value_or(value);
}

Attenuation attenuation(const model::DistanceFunction& function, std::span<const double> distances,
                        const RandomStream& random) {
    Attenuation out{std::vector<double>(distances.size()), 1};
    evaluate(function, distances, random, false, [&](std::size_t i, double v) { out.values[i] = v; });
    if (const auto* linear = std::get_if<model::LinearFunction>(&function.form)) {
        out.reference = std::max(six_digits(linear->min), six_digits(linear->max));
    } else if (const auto* block = std::get_if<model::BlockFunction>(&function.form)) {
        out.reference = std::max(six_digits(block->min), six_digits(block->max));
    } else if (std::holds_alternative<model::GaussianFunction>(function.form) && !out.values.empty()) {
        out.reference = *std::ranges::max_element(out.values);
    }
    return out;
}

std::vector<int> delays(const model::DistanceFunction& function, std::span<const double> distances,
                        const RandomStream& random) {
    const bool truncated = std::holds_alternative<model::UniformFunction>(function.form) ||
                           std::holds_alternative<model::BlockFunction>(function.form);
    std::vector<int> out(distances.size());
    evaluate(function, distances, random, true, [&](std::size_t i, double v) {
        const double whole = truncated ? std::trunc(v) : std::round(v);
        out[i] = whole > 0 ? static_cast<int>(std::min(whole, 1e9)) : 0;  // NaN gives 0
    });
    return out;
}

}  // namespace forage::connectivity
