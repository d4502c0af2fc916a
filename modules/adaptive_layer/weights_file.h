// Files of weights: text with one line per response cell, and "%.6g, " for each number.
#pragma once

#include <string>

#include <Eigen/Core>

namespace forage::adaptive {

/// Reads the weights W (N x K) from the file at `path`: N K numbers separated by commas, with the N weights
/// of response cell 0 first. A comma may follow the last number; white space is ignored. Throws FileError
/// with all errors when the file cannot be read, when something is not a finite number, and when the number
/// of weights is not N K.
Eigen::MatrixXd read_weights(const std::string& path, Eigen::Index stimuli, Eigen::Index responses);
/// Reads weights from a text. `path` is the name of the text in errors.
Eigen::MatrixXd parse_weights(const std::string& text, const std::string& path, Eigen::Index stimuli,
                              Eigen::Index responses);

/// Writes W (N x K) in the format of read_weights(), with six significant digits as in the original. The file
/// is either complete or not created. Throws std::runtime_error when it cannot be written.
void write_weights(const std::string& path, const Eigen::MatrixXd& weights);

}  // namespace forage::adaptive
