// Several arrays in one file, for numpy.load().
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace forage::observe {

/// Puts .npy files, each with the name it gets, into one .npz file, as they are. Throws std::runtime_error
/// when one cannot be read or the archive cannot be written.
void join_npz(const std::string& path, const std::vector<std::pair<std::string, std::string>>& arrays);

/// Takes the array `name` out of such a file again, as a .npy file. Throws std::runtime_error.
void extract_npz(const std::string& path, const std::string& name, const std::string& npy);

}  // namespace forage::observe
