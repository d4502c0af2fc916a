// From a text to an experiment.
#include <cstdint>

#include "core/xml/experiment.h"
#include "tests/fuzz/holds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    forage::Diagnostics diagnostics;
    const auto experiment = forage::xml::parse_experiment("input.xml", text, diagnostics);
    forage::test::holds(experiment.has_value() != diagnostics.failed(), "an experiment, or an error");
    forage::test::holds(!experiment || !experiment->seeds.empty(), "an experiment has a run");
    forage::test::sensible(diagnostics, text);
    return 0;
}
