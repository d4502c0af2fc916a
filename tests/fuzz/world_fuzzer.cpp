// From a text to the description of a world; models are those that ship.
#include <cstdlib>

#include "bug_interface/world/sdf_reader.h"
#include "tests/fuzz/holds.h"
#include "tests/fuzz/scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static forage::test::ScratchFile file(".world");
    static const std::vector<std::string> models = {FORAGE_SOURCE_DIR "/systems/worlds/models"};
    forage::Diagnostics diagnostics;
    const auto world = forage::bug::read_world(file.holding(data, size), diagnostics, models);
    forage::test::holds(world.has_value() != diagnostics.failed(), "a world, or an error");
    forage::test::sensible(diagnostics, std::string(1'000'000, '\n'));  // it may lie in a model's file
    return 0;
}
