#include "tools/studio/server/course.h"

#include <string_view>
#include <utility>

#include "core/base/archive.h"
#include "core/run/prepared_run.h"
#include "tools/studio/server/commands/command.h"
#include "tools/studio/server/page_paths.h"

namespace forage::studio {

void Course::repeat_actions() {
    while (const auto* action = history.due(run->cycle()))
        find_command(action->command.at("command")).repeat(*this, action->command);
}

void Course::step() {
    repeat_actions();
    run->step();
    history.after_cycle(*run);
}

void Course::replay(std::uint64_t cycle) {
    history.restore(*run, cycle);
    while (run->cycle() < cycle) {
        repeat_actions();
        run->step();
    }
}

Course Course::past(std::uint64_t cycle) {
    Course out;
    out.changed = changed;
    Archive saved;
    history.save(saved, cycle);
    Archive in{std::string_view(saved.bytes())};
    out.history.load(in);
    return out;
}

void Course::take_run(Course&& built) { run = std::move(built.run), manipulations = built.manipulations; }

std::optional<Course> build_run(const Sources& sources, const RunInput& input, std::uint64_t seed,
                                Diagnostics& diagnostics) {
    // Nothing reads a file before all files are checked.
    if (sources.system && !check_system_files(*sources.system, known_types(sources.plugins), diagnostics))
        return std::nullopt;
    auto loaded = assemble(sources, input, diagnostics);
    if (!loaded) return std::nullopt;
    auto run = Run::make(std::move(loaded->system), std::move(loaded->registry), std::move(loaded->world),
                         {.seed = seed}, diagnostics);
    if (!run) return std::nullopt;
    Course out;
    out.manipulations = &run->add(std::make_unique<PageManipulations>());
    if (!run->start(diagnostics)) return std::nullopt;
    out.run = std::make_unique<Run>(std::move(*run));
    return out;
}

Course open_run(const RunInput& input, std::string* digest) {
    Diagnostics diagnostics;
    const Sources sources = read_sources(input, diagnostics);
    auto out = checked(diagnostics, build_run(sources, input, input.seed, diagnostics));
    out->run->title = run_title(input);
    if (digest) *digest = digest_of_files(input, sources);
    return std::move(*out);
}

}  // namespace forage::studio
