// Tries all expressions of command lines and experiments. The first byte chooses the kind, and the names are
// those of a small system.
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/engine/simulation.h"
#include "core/equations/compile.h"
#include "core/formula/formula.h"
#include "core/model/edit.h"
#include "core/model/world_change.h"
#include "core/observe/condition.h"
#include "core/observe/manipulation_spec.h"
#include "core/observe/schedule.h"
#include "core/observe/source.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/fuzz/holds.h"
#include "tools/plot/plot_spec.h"

namespace {

using namespace forage;

struct SmallSystem {
    model::System system;
    Registry registry;
    std::optional<engine::Simulation> simulation;

    SmallSystem() {
        Diagnostics diagnostics;
        system = *xml::read_system(FORAGE_SOURCE_DIR "/tests/diagnostics/sound/system.iqr", diagnostics);
        add_neurons(registry);
        add_synapses(registry);
        add_modules(registry);
        simulation =
            engine::Simulation::build(system, registry, engine::Demand::everything(), {1}, diagnostics);
        test::holds(simulation.has_value(), "the small system is sound");
        simulation->start();
    }
};

using Mode = model::ManipulationSpec::Mode;

void manipulate(const SmallSystem& small, Mode mode, const std::string& text, Diagnostics& diagnostics) {
    try {
        const auto spec = expression::parse_manipulation(mode, text);
        if (!spec.cells.empty())  // else it names a file
            observe::make_manipulations({spec}, small.simulation->layout(), true, diagnostics);
    } catch (const expression::Mistake& m) {
        diagnostics.error(Location{}, m.described(text));
    }
}

/// Compiles equations of neurons and of synapses, and runs those without mistakes.
void try_equations(const std::string& text) {
    for (const bool synapse : {false, true}) {
        bool sound = true;
        const auto compiled =
            equations::compile(text, {synapse, {"tau"}, {"x"}, {"gain"}}, [&](const FormulaError& e) {
                sound = false;
                test::holds(e.at <= text.size(), "a mistake has a place in the equations");
            });
        if (!sound) continue;
        constexpr Index cells = 3;
        const std::vector<double> scalars(2 + compiled.constants.size(), 0.5), column(cells, 0.25);
        const std::vector<const double*> read(compiled.reads.size(), column.data());
        std::vector<std::vector<double>> results(compiled.written.size(), std::vector<double>(cells));
        std::vector<double*> written;
        for (auto& r : results) written.push_back(r.data());
        compiled.program.run(scalars, read, written, cells);
        for (const auto& r : results)
            test::holds(std::memcmp(&r[0], &r[1], sizeof r[0]) == 0, "equal cells have equal results");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static SmallSystem small;
    if (size == 0) return 0;
    const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
    Diagnostics diagnostics;
    auto& simulation = *small.simulation;
    switch (data[0] % 10) {
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
            try {
                expression::parse_world_change(expression::parse_change(text).change.text);
                observe::make_schedule({expression::parse_change(text)}, small.system, small.registry,
                                       simulation.layout(), true, diagnostics)
                    ->check(simulation, diagnostics);
            } catch (const expression::Mistake& m) {
                diagnostics.error(Location{}, m.described(text));
            }
            break;
        case 4:
            if (auto source = observe::find_source(simulation.layout(), text, "--record", diagnostics)) {
                std::vector<double> row(source->what().size());
                source->read(simulation, row);
            }
            break;
        case 5:
            if (const auto plot = plot::parse_plot(text, "--plot", diagnostics))
                test::holds(!plot->file(plot::Format::png).empty(), "a picture has a name");
            break;
        case 6: {
            auto system = small.system;
            model::set(system, small.registry, text, diagnostics);
            break;
        }
        case 7:
            try {
                Formula(text).value(
                    [](const std::string& name, std::size_t) { return name.size() > 1 ? 0.5 : 3.0; });
            } catch (const FormulaError& e) {
                test::holds(e.at <= text.size(), "a mistake has a place in the text");
            }
            break;
        case 8:
            try_equations(text);
            break;
        default:
            manipulate(small, Mode::add, text, diagnostics);
    }
    test::sensible(diagnostics, text);
    return 0;
}
