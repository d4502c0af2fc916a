// Conversions of system and process files.
#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage {

/// The output of a conversion whose text is printed.
inline constexpr const char* standard_output = "-";

/// What becomes of a file.
struct Conversion {
    /// .iqr or .iqrProcess files. Relative paths in the output are unchanged when it is standard_output.
    std::string input, output;
    std::vector<std::string> imports;  ///< process files to add
    /// Name or id of the process to write as a file of its own; empty: the whole system.
    std::string extract;
    std::vector<std::string> plugins;
    bool terse = false;     ///< whether to write the short form of what has two
    bool full = false;      ///< whether to write the long form of what has two
    bool original = false;  ///< whether to write everything that the original requires
    bool embed = false;     ///< whether to write the content of linked processes instead of links
};

/// Returns the text of the file to write, and adds sentences for users to `notes`. Both have no meaning when
/// `diagnostics` got an error.
std::string converted(const Conversion& conversion, std::string& notes, Diagnostics& diagnostics);

}  // namespace forage
