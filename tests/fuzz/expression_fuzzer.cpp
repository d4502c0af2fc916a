// Everything that is written in a language of its own on the command line and in experiments: the first byte
// chooses which. A small system knows the names.
#include <cstdint>

#include "core/engine/simulation.h"
#include "core/model/edit.h"
#include "core/observe/condition.h"
#include "core/observe/source.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/fuzz/holds.h"
#include "tools/forage/manipulations.h"
#include "tools/forage/plot_spec.h"
#include "tools/forage/schedule.h"

namespace {

using namespace forage;

struct Small {
    tool::Loaded loaded;
    std::optional<engine::Simulation> simulation;

    Small() {
        Diagnostics diagnostics;
        loaded.system =
            *xml::read_system(FORAGE_SOURCE_DIR "/tests/diagnostics/sound/system.iqr", diagnostics);
        add_neurons(loaded.registry);
        add_synapses(loaded.registry);
        add_modules(loaded.registry);
        simulation = engine::Simulation::build(loaded.system, loaded.registry, engine::Demand::everything(),
                                               {1}, diagnostics);
        test::holds(simulation.has_value(), "the small system is sound");
        simulation->start();
    }
};

using Mode = model::ManipulationSpec::Mode;

void manipulate(const Small& small, Mode mode, const std::string& text, Diagnostics& diagnostics) {
    try {
        const auto wish = tool::parse_manipulation(mode, text);
        if (wish.patterns.empty())  // else it names a file
            tool::manipulations({wish}, small.loaded, small.simulation->layout(), diagnostics);
    } catch (const std::invalid_argument& e) {
        diagnostics.error({}, e.what());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static Small small;
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    Diagnostics diagnostics;
    auto& simulation = *small.simulation;
    switch (data[0] % 8) {
        case 0:
        case 1:
            if (const auto c = observe::parse_condition(simulation.layout(), data[0] & 1, text, "--until",
                                                        diagnostics)) {
                c->sees_cells();
                c->holds(simulation, {3, 0.1, 1});
            }
            break;
        case 2:
            if (const auto q =
                    observe::parse_quantity(simulation.layout(), true, text, "measure", diagnostics))
                q->in(simulation, {3, 0.1, 1});
            break;
        case 3:
            if (const auto timed = tool::parse_timed(text))
                tool::schedule({*timed}, small.loaded, simulation.layout(), diagnostics)
                    .check(simulation, diagnostics);
            break;
        case 4:
            if (auto source = observe::find_source(simulation.layout(), text, "--record", diagnostics)) {
                std::vector<double> row(source->what().size());
                source->read(simulation, row);
            }
            break;
        case 5:
            if (const auto plot = tool::parse_plot(text, "--plot", diagnostics))
                test::holds(!plot->file(plot::Format::png).empty(), "a picture has a name");
            break;
        case 6: {
            auto system = small.loaded.system;
            model::set(system, small.loaded.registry, text, diagnostics);
            break;
        }
        default:
            manipulate(small, Mode::add, text, diagnostics);
    }
    test::sensible(diagnostics, text);
    return 0;
}
