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

#include <fmt/format.h>

namespace forage::adaptive {
namespace {

using Eigen::Index;

constexpr std::string_view blanks = " \t\r\n\v\f";

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// `text` as a finite single-precision number.
bool parse(std::string_view text, double& value) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return false;
    value = static_cast<double>(static_cast<float>(value));
    return std::isfinite(value);
}

/// A piece of the file, shortened and harmless on a terminal.
std::string shown(std::string_view text) {
    std::string out(text.substr(0, 20));
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return out;
}

std::string read_text(const std::string& path) {
    std::error_code ignored;
    std::ifstream in(path, std::ios::binary);
    if (!in || std::filesystem::is_directory(path, ignored))
        throw std::runtime_error(fmt::format("cannot read the weights '{}'", path));
    return {std::istreambuf_iterator<char>(in), {}};
}

[[noreturn]] void wrong(const std::string& path, const std::string& text, std::size_t at,
                        const std::string& what) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw std::runtime_error(fmt::format("{}:{}: error: {}", path, line, what));
}

}  // namespace

Eigen::MatrixXd read_weights(const std::string& path, Index stimuli, Index responses) {
    const std::string text = read_text(path);
    Eigen::MatrixXd weights(stimuli, responses);
    Index count = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        at = std::min(text.find_first_not_of(blanks, at), text.size());
        const auto comma = std::min(text.find(',', at), text.size());
        const auto token = trimmed(std::string_view(text).substr(at, comma - at));
        if (token.empty() && comma == text.size()) break;  // what follows the last comma
        double value = 0;
        if (!parse(token, value))
            wrong(path, text, at,
                  fmt::format("'{}' is not a number; weights are numbers with commas between them",
                              shown(token)));
        if (count < weights.size()) weights(count % stimuli, count / stimuli) = value;
        ++count;
        at = comma;
    }
    if (count != weights.size())
        wrong(path, text, text.size(),
              fmt::format("{} weights, but {} stimulus cells and {} response cells need {}", count, stimuli,
                          responses, weights.size()));
    return weights;
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
