#include "modules/adaptive_layer/weights_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/text_file.h"

namespace forage::adaptive {
namespace {

using Eigen::Index;

constexpr std::string_view blanks = " \t\r\n\v\f";

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Reads `text` as a finite single-precision number; returns what is wrong with it.
std::string parse(std::string_view text, double& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return no_number(text);
    value = static_cast<double>(static_cast<float>(value));
    return std::isfinite(value)
               ? ""
               : fmt::format("'{}' is too large: weights are stored as float", escaped(text));
}

constexpr std::size_t most_errors = 100;

}  // namespace

Eigen::MatrixXd parse_weights(const std::string& text, const std::string& path, Index stimuli,
                              Index responses) {
    std::vector<Diagnostic> errors;
    int line = 1;
    std::size_t counted = 0, line_start = 0;  // lines are counted up to here
    const auto add_error = [&](std::size_t at, std::string message) {
        for (; counted < at; ++counted)
            if (text[counted] == '\n') ++line, line_start = counted + 1;
        errors.push_back(
            error_at(line, static_cast<int>(at - line_start) + 1, std::move(message),
                     fmt::format("weights are numbers with commas between them, {} x {} of them: a row of "
                                 "stimulus cells for each response cell",
                                 responses, stimuli)));
    };
    if (const auto wrong = not_lines(text, "these are no weights")) throw FileError(path, text, {*wrong});
    Eigen::MatrixXd weights(stimuli, responses);
    Index count = 0;
    for (std::size_t at = 0; at < text.size() && errors.size() < most_errors; ++at) {
        at = std::min(text.find_first_not_of(blanks, at), text.size());
        const auto comma = std::min(text.find(',', at), text.size());
        const auto token = trimmed(std::string_view(text).substr(at, comma - at));
        if (token.empty() && comma == text.size()) break;  // what follows the last comma
        double value = 0;
        if (const auto wrong = parse(token, value); !wrong.empty()) add_error(at, wrong);
        if (count < weights.size()) weights(count % stimuli, count / stimuli) = value;
        ++count;
        at = comma;
    }
    if (errors.empty() && count != weights.size())
        add_error(text.size(), fmt::format("{} weights, but {} stimulus cells and {} response cells need {}",
                                           count, stimuli, responses, weights.size()));
    if (!errors.empty()) throw FileError(path, text, std::move(errors));
    return weights;
}

Eigen::MatrixXd read_weights(const std::string& path, Index stimuli, Index responses) {
    return parse_weights(read_file(path), path, stimuli, responses);
}

void write_weights(const std::string& path, const Eigen::MatrixXd& weights) {
    std::string text;
    for (Index k = 0; k < weights.cols(); ++k) {
        for (Index i = 0; i < weights.rows(); ++i)
            fmt::format_to(std::back_inserter(text), "{:.6g}, ", weights(i, k));
        text += '\n';
    }
    const std::string part = path + ".part";
    std::ofstream out(part, std::ios::binary);
    out << text;
    out.close();
    std::error_code error;
    if (out) std::filesystem::rename(part, path, error);
    if (!out || error) {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        throw std::runtime_error(fmt::format("cannot write the weights '{}'", path));
    }
}

}  // namespace forage::adaptive
