// Several arrays in one file, for numpy.load().
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace forage::observe {

/// Copies .npy files into one .npz file. `arrays` are pairs of a name in the archive and a file. They are not
/// compressed, so that the numbers can be mapped. Throws std::runtime_error when a file cannot be read or the
/// archive cannot be written.
void join_npz(const std::string& path, const std::vector<std::pair<std::string, std::string>>& arrays);

/// Extracts the array `name` from an .npz file as a .npy file. Throws std::runtime_error.
void extract_npz(const std::string& path, const std::string& name, const std::string& npy);

}  // namespace forage::observe
