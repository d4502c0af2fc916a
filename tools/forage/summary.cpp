#include "tools/forage/summary.h"

#include <fmt/format.h>

#include "core/base/cores.h"
#include "core/base/separated.h"
#include "tools/forage/trial_summary.h"

namespace forage::tool {
namespace {

std::string threads_line(int wanted, std::uint64_t shared, double cycles) {
    if (!engine::has_threads())
        return fmt::format("1 of {}: this build has no threads (FORAGE_THREADS=OFF)", wanted);
    if (cores() == 1) return fmt::format("1 of {}: there is one core", wanted);
    if (shared == 0)
        return fmt::format("1 of {}: the cycles are too short to share, or too few to measure", wanted);
    return fmt::format(
        "{}, which shared {:.1f} % of the cycles; in the others, one thread was as fast when measured",
        wanted > cores() ? fmt::format("{} of {}, one per core", cores(), wanted) : fmt::format("{}", wanted),
        100 * static_cast<double>(shared) / cycles);
}

std::string score_table(const Environment& environment) {
    std::string out = "  score          team   points   good   bad\n";
    for (const auto& s : environment.scores())
        out += fmt::format("  {:<14} {:<4} {:>8} {:>6} {:>5}\n", "", s.team, s.points, s.good, s.bad);
    if (const auto left = environment.game_time_left())
        out += *left == 0 ? "  time           over\n" : fmt::format("  time left      {:.0f} s\n", *left);
    return out;
}

}  // namespace

std::string summary(const PreparedRun& p, const RunOutcome& outcome, bool resumable) {
    const Run& run = p.run;
    const auto& simulation = run.simulation();
    const Environment* environment = run.environment();
    std::string out = run_title(p.spec.input) + "\n";
    const auto line = [&](std::string_view name, const std::string& text) {
        out += fmt::format("  {:<14} {}\n", name, text);
    };
    if (!outcome.stopped.empty()) line("stopped", outcome.stopped);
    line("cycles", fmt::format("{} ({:.1f} s {})", run.cycle(), run.seconds(),
                               environment ? "in the world" : "at the system's pace"));
    const auto done = static_cast<double>(run.cycle() - outcome.first_cycle);
    if (done > 0)
        line("speed",
             fmt::format("{:.0f} cycles/s, {:.0f} x real time ({:.2f} s)", done / outcome.clock_seconds,
                         run.seconds_per_cycle() * done / outcome.clock_seconds, outcome.clock_seconds));
    if (p.spec.threads > 1) line("threads", threads_line(p.spec.threads, simulation.shared_cycles(), done));
    for (const auto& e : p.schedule->entries())
        line(e.cycle ? "changed" : "not changed", e.cycle
                                                      ? fmt::format("in cycle {}, at {}", *e.cycle, e.text)
                                                      : fmt::format("at {}: it never was", e.text));
    if (const std::string& until = p.spec.length.until.text; !until.empty())
        line("until", p.stop.holds(run) ? fmt::format("{}: it held after cycle {}", until, run.cycle())
                                        : until + ": it never held");
    if (p.remote && !p.remote->executed().empty())
        line("commands", fmt::format("{}{}", p.remote->executed().size(),
                                     p.remote->quit()
                                         ? fmt::format("; cmd:quit ended the run after cycle {}", run.cycle())
                                         : ""));
    if (environment) {
        const auto names = environment->robot_names();
        for (std::size_t i = 0; i < names.size(); ++i)
            for (const auto& [what, text] :
                 trial_summary(*environment, run.trials(i), p.statistics != nullptr))
                line((names.size() > 1 ? names[i] + " " : "") + what, text);
        if (!environment->scores().empty()) out += score_table(*environment);
    }
    for (const auto& [name, text] : outcome.files.notes()) line(name, text);
    std::size_t pruned = 0;
    const std::size_t groups = run.layout().groups.size();
    for (std::size_t g = 0; g < groups; ++g) pruned += simulation.pruned(static_cast<int>(g));
    if (pruned)
        line("pruned",
             fmt::format("{} of {} groups, which nothing reads; --hash computes all", pruned, groups));
    if (p.spec.digest) line("computed", fmt::format("all {} groups, as --hash demands", groups));
    if (!run.divergence().empty()) line("diverged", run.divergence());
    if (!outcome.state.empty()) line("state", outcome.state);
    if (resumable) line("to continue", "forage resume " + p.spec.directory);
    if (!outcome.files.names().empty())
        line("written", fmt::format("{}: {}", p.spec.directory, separated(outcome.files.names(), ", ")));
    return out;
}

}  // namespace forage::tool
