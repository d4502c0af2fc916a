// Tries a text both as a table that drives or clamps groups and as a list of patterns.
#include <cstdint>

#include "core/base/drive_table.h"
#include "core/base/named_file.h"
#include "core/observe/pattern_file.h"
#include "tests/fuzz/holds.h"

using forage::test::holds;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    forage::Diagnostics diagnostics;
    try {
        const auto table = forage::DriveTable::parse(text, "input.csv");
        holds(!table.rows().empty(), "a table has rows");
    } catch (const forage::FileError& e) {
        holds(!e.errors().empty(), "an error says what is wrong");
        report(e, diagnostics);
    }
    const forage::GroupShape shape{3, 2, 6};
    const auto patterns = forage::observe::parse_patterns(text, "input.txt", shape, diagnostics);
    for (const auto& p : patterns) holds(p.size() == 6, "a pattern has a number per cell");
    forage::test::sensible(diagnostics, text);
    return 0;
}
