// Weights of the adaptive layer.
#include <cstdint>

#include "core/base/named_file.h"
#include "modules/adaptive_layer/weights_file.h"
#include "tests/fuzz/holds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    forage::Diagnostics diagnostics;
    try {
        const auto weights = forage::adaptive::parse_weights(text, "input.weights", 2, 2);
        forage::test::holds(weights.allFinite(), "weights are finite");
    } catch (const forage::FileError& e) {
        report(e, diagnostics);
    }
    forage::test::sensible(diagnostics, text);
    return 0;
}
