// Weights as text: one line per response cell, "%.6g" and ", " after each number.
#pragma once

#include <string>

#include <Eigen/Core>

namespace forage::adaptive {

/// The weights W, N x K, in the file at `path`: N K numbers with commas between (and, as written, after)
/// them, K outer and N inner; blanks and line ends mean nothing. Throws FileError with all that is wrong: it
/// cannot be read, something is no finite number, or the numbers are not N K.
Eigen::MatrixXd read_weights(const std::string& path, Eigen::Index stimuli, Eigen::Index responses);
/// The same of a text that a person knows as `path`.
Eigen::MatrixXd parse_weights(const std::string& text, const std::string& path, Eigen::Index stimuli,
                              Eigen::Index responses);

/// Writes W, N x K, so that read_weights() reads it; six significant digits, as the original. The file
/// appears complete or not at all. Throws std::runtime_error when it cannot be written.
void write_weights(const std::string& path, const Eigen::MatrixXd& weights);

}  // namespace forage::adaptive
