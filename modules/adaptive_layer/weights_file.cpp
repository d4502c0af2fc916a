#include "modules/adaptive_layer/weights_file.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/table.h"

namespace forage::adaptive {
namespace {

using Eigen::Index;

}  // namespace

Eigen::MatrixXd parse_weights(const std::string& text, const std::string& path, Index stimuli,
                              Index responses) {
    const std::string hint = fmt::format(
        "weights are numbers with commas between them, {} x {} of them: a row of stimulus cells for each "
        "response cell",
        responses, stimuli);
    TableReader in(text, path, TableReader::Layout::list, "these are not weights");
    in.next();
    Eigen::MatrixXd weights(stimuli, responses);
    Index count = 0;
    for (const auto field : in.fields()) {
        const auto value = static_cast<double>(static_cast<float>(in.number(field, hint)));
        if (!std::isfinite(value))
            in.fault(field, fmt::format("'{}' is too large: weights are stored as float", escaped(field)),
                     hint);
        if (count < weights.size()) weights(count % stimuli, count / stimuli) = value;
        ++count;
    }
    if (!in.failed() && count != weights.size())
        in.fault(std::string_view(text).substr(text.size()),
                 fmt::format("{} weights, but {} stimulus cells and {} response cells need {}", count,
                             stimuli, responses, weights.size()),
                 hint);
    in.require_sound();
    return weights;
}

Eigen::MatrixXd read_weights(const std::string& path, Index stimuli, Index responses) {
    return parse_weights(read_file(path), path, stimuli, responses);
}

void write_weights(const std::string& path, const Eigen::MatrixXd& weights) {
    std::string text;
    for (Index k = 0; k < weights.cols(); ++k) {
        for (Index i = 0; i < weights.rows(); ++i) text += fmt::format("{:.6g}, ", weights(i, k));
        text += '\n';
    }
    // A system may come from another person: it must not replace other files of the user.
    std::error_code none;
    if (std::filesystem::is_regular_file(path, none) &&
        read_file(path).find_first_not_of("0123456789+-.eEnaif, \t\r\n") != std::string::npos)
        throw std::runtime_error(
            fmt::format("cannot write the weights '{}': this file holds something else", path));
    try {
        write_file(path, text);
    } catch (const std::runtime_error&) {
        throw std::runtime_error(fmt::format("cannot write the weights '{}'", path));
    }
}

}  // namespace forage::adaptive
