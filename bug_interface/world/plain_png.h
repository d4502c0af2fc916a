// The usual kinds of PNG files, read without a detour.
#pragma once

#include <string>

#include "bug_interface/world/png.h"

namespace forage::bug {

/// Reads a file whose pixels stand in plain rows: opaque, not interlaced, at most 8 bits per channel, colours
/// as they are to be seen (no gamma or profile of its own). False when it is of another kind, or when there
/// is anything wrong with it: then read_png() reads it with libpng's general reader, or tells what is wrong.
/// The border of `image` is set, its pixels are not.
bool read_plain_png(const std::string& path, Image& image);

}  // namespace forage::bug
