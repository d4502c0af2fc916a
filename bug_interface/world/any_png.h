// PNG files of any kind, read by libpng's general reader.
#pragma once

#include <string>

#include "bug_interface/world/png.h"

namespace forage::bug {

/// Reads the pixels of any picture; transparent ones stand before black. The border of `image` is set, its
/// pixels are not. Throws std::runtime_error with the reason when the file cannot be read.
void read_any_png(const std::string& path, Image& image);

/// What keeps a file from being given to read_any_png(), as far as its beginning tells; empty when nothing
/// does.
std::string any_png_problem(const std::string& path);

}  // namespace forage::bug
