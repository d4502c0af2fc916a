// The content of a file that Forage has written.
#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace forage {

/// All bytes of a file; none when it cannot be read.
inline std::string file_bytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace forage
