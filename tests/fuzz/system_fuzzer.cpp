// Tries all steps from a text to synapses.
#include <cstdint>

#include "tests/fuzz/pipeline.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const forage::Registry registry = forage::test::shipped_types();
    const std::string text(reinterpret_cast<const char*>(data), size);
    forage::test::run_pipeline(text, registry, size % 2 == 1);
    return 0;
}
