#include "tools/api/forage/forage.h"

#include "core/plugin/search.h"
#include "tools/api/sources.h"

namespace forage {
namespace {

void throw_errors(const Diagnostics& diagnostics) {
    if (diagnostics.failed()) throw InputError(format(diagnostics));
}

Run make_run(model::System system, Registry types, std::unique_ptr<Environment> environment,
             const OpenOptions& options, Diagnostics& diagnostics) {
    auto run = Run::make(std::move(system), std::move(types), std::move(environment),
                         {.seed = options.seed,
                          .threads = options.threads,
                          .compute_everything = options.compute_everything},
                         diagnostics);
    throw_errors(diagnostics);
    if (const Environment* world = run->environment())
        for (std::size_t i = 0; i < world->robot_names().size(); ++i)
            run->add(std::make_unique<TrialRecorder>(*world, i, run->layout(), "trials.csv"));
    return std::move(*run);
}

}  // namespace

Registry types(const std::vector<std::string>& plugins) {
    Diagnostics diagnostics;
    Registry out = shipped_types();
    plugin::add(plugin::load(plugin::find(plugins, {}, {}, diagnostics), out, diagnostics), out);
    throw_errors(diagnostics);
    return out;
}

Run open(const std::string& system, const OpenOptions& options) {
    RunInput input;
    input.system = system, input.world = options.world, input.seed = options.seed, input.plugins = options.plugins;
    input.lenient = options.lenient, input.noise = options.noise, input.real_time_factor = options.real_time_factor;
    for (const auto& setting : options.settings) input.settings.push_back({setting});
    Diagnostics diagnostics;
    auto loaded = load(input, diagnostics);
    throw_errors(diagnostics);
    return make_run(std::move(loaded->system), std::move(loaded->registry), std::move(loaded->world), options,
                    diagnostics);
}

Run open(model::System system, Registry types, std::unique_ptr<Environment> environment,
         const OpenOptions& options) {
    Diagnostics diagnostics;
    return make_run(std::move(system), std::move(types), std::move(environment), options, diagnostics);
}

}  // namespace forage
