// How fast is the engine alone, compared with the original's, and how much memory does it take?
//
//     bench_engine [CASE...]
//
// Runs the systems of $FORAGE_SHARED/perf (each in a process of its own, on one thread and, where it is worth
// sharing, on two) and prints cycles per second (the best of three runs of a second or two, which is what
// results.tsv has of the original, and their median), the ratio of the best to the original's, the time to
// load and build, and the peak of memory. The two systems of the tutorial get their recorded input again and
// again, so that their inputs never become constant. Two systems without a figure of the original's are
// compared with the same system whose synapses are a list. All groups are updated; their inputs are not kept
// between cycles, as in a run that does not record them. Last result: docs/design/performance.md.
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/engine/simulation.h"
#include "core/xml/reader.h"
#include "modules/modules.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/bench/report.h"
#include "tests/bench/two_threads.h"
#include "tests/support/golden.h"
#include "tests/support/paths.h"

namespace {

using namespace forage;
using Path = std::filesystem::path;

/// Plays a recording, again and again from its beginning.
struct Loop {
    std::shared_ptr<const DriveTable> table;
    std::vector<std::vector<std::pair<std::size_t, const DriveTable::Row*>>> by_cycle;

    static void describe(ModuleSpec<Loop>& s) { s.name("moduleGazeboBug", "Loop").any_ports(); }
    void start(const ModulePorts& ports) {
        by_cycle.resize(static_cast<std::size_t>(table->rows().back().cycle) + 1);
        for (const auto& row : table->rows())
            for (std::size_t port = 0; port < ports.outputs.size(); ++port)
                if (row.cycle >= 0 && replay::plays(row, ports.process, ports.outputs[port]))
                    by_cycle[static_cast<std::size_t>(row.cycle)].emplace_back(port, &row);
    }
    void update(ModuleFrame& frame) {
        for (const auto& [port, row] : by_cycle[frame.cycle() % by_cycle.size()])
            frame.output(port) = ConstColumn(row->values.data(), static_cast<Index>(row->values.size()));
    }
};

struct Original {
    std::string name;
    double cycles_per_second = 0, megabytes = 0;
};

std::vector<Original> originals() {
    std::vector<Original> out;
    test::Rows rows(test::shared_dir() / "perf" / "results.tsv", '\t');
    for (std::vector<std::string_view> f; rows.next(f);)
        if (f.size() >= 10) out.push_back({std::string(f[0]), test::number(f[7]), test::number(f[9])});
    return out;
}

int measure(const Original& original) {
    const Path shared = test::shared_dir();
    const bool tutorial = original.name.starts_with("DAC");
    const Path file = tutorial ? shared / "original" / "DAC_files" / (original.name + ".iqr")
                               : shared / "perf" / (original.name + ".iqr");
    const Path drive = shared / "golden" / "systems" / original.name / "drive.csv";
    if (!std::filesystem::exists(file) || (tutorial && !std::filesystem::exists(drive))) {
        fmt::print("{:<42} skipped: no {}\n", original.name,
                   std::filesystem::exists(file) ? "recording of its senses" : "file");
        return 0;
    }
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    add_modules(registry);
    int cycles = 1;  // of a run: the whole recording, as some of its cycles cost less than others
    if (tutorial) {
        const auto table = std::make_shared<DriveTable>(DriveTable::read(drive));
        cycles = static_cast<int>(table->rows().back().cycle) + 1;
        registry.add(module_type(Loop{table, {}}));
    }
    Diagnostics diagnostics;
    diagnostics.lenient = true;  // the player does not have the robot's parameters
    const double begin = bench::wall_seconds();
    const auto system = xml::read_system(file, diagnostics);
    const auto built = [&](int threads) -> std::optional<engine::Simulation> {
        auto layout = engine::make_layout(*system, registry, diagnostics);
        if (!layout) return std::nullopt;
        engine::Demand demand;  // for everything except inputs, as in a run that records all activities
        for (int g = 0; g < std::ssize(layout->groups); ++g) demand.read_group(g);
        return engine::Simulation::build(*system, std::move(*layout), demand, {.threads = threads},
                                         diagnostics);
    };
    auto simulation = system ? built(1) : std::nullopt;
    const double build = bench::wall_seconds() - begin;
    if (!simulation) {
        fmt::print(stderr, "{}", format(diagnostics));
        return 1;
    }
    simulation->start();
    const auto run = [cycles](engine::Simulation& s) {
        return [&s, cycles] {
            for (int i = 0; i < cycles; ++i) s.step();
        };
    };
    // There are three runs of a second, two now and one after the turns with threads, as the load of the
    // machine changes.
    bench::Rates one;
    const auto add_runs = [&](int count) {
        bench::add_rates(one, bench::thread_seconds, count, run(*simulation), 1.0);
    };
    add_runs(2);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double megabytes = static_cast<double>(usage.ru_maxrss) / 1024;

    const auto build_another = [&](int threads) {
        auto out = built(threads);
        out->start();
        return out;
    };
    auto two = build_another(2);
    const bool shared_work = two->threads() > 1;
    bench::Gain gain{.shared = 1, .usual = 1, .apart = 1};
    if (shared_work) {
        auto other = build_another(1);
        gain = bench::gain_of_two_threads(*simulation, *other, *two, cycles);
    }
    add_runs(1);
    const double rate = cycles * one.best(), median = cycles * one.median();
    const double ratio = rate / original.cycles_per_second, memory = megabytes / original.megabytes;
    fmt::print("{:<42} {:>10.0f} {:>10.0f} {:>8.1f} x {:>8.3f} {:>8.0f} {:>8.2f} {}\n", original.name, rate,
               median, ratio, build, megabytes, memory,
               shared_work ? fmt::format("{:>9.2f} ({:.2f})", gain.shared, gain.apart) : "not shared");
    const std::string subject = "engine/" + original.name;
    bench::result(subject, "rate", rate, "cycles/s");
    bench::result(subject, "rate, median of three runs", median, "cycles/s");
    bench::result(subject, "rate / original's", ratio, "");
    bench::result(subject, "load and build", build, "s");
    bench::result(subject, "memory", megabytes, "MB");
    bench::result(subject, "memory / original's", memory, "");
    bench::result(subject, "rate with two threads / with one", gain.shared, "");
    bench::result(subject, "rate with two threads / with one, medians", gain.usual, "");
    if (shared_work) bench::result(subject, "rate of two side by side / of one", gain.apart, "");
    return 0;
}

/// Systems whose weights all differ, beside the same with a list of synapses, in turns.
int compare_with_list(const std::string& name) {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics diagnostics;
    const auto system = xml::read_system(test::shared_dir() / "perf" / (name + ".iqr"), diagnostics);
    const auto built = [&](bool general_forms) {
        auto out = engine::Simulation::build(*system, registry, engine::Demand::everything(),
                                             {.general_forms = general_forms}, diagnostics);
        out->start();
        return out;
    };
    auto fast = built(false), plain = built(true);
    const auto [rates, of_list] = bench::rates_in_turns(
        bench::thread_seconds, [&] { fast->step(); }, [&] { plain->step(); });
    const double ratio = rates.best() / of_list.best();
    fmt::print("{:<42} {:>10.0f} {:>10.0f} {:>8.1f} x a list's ({})\n", name, rates.best(), rates.median(),
               ratio, fast->connection_form(0));
    bench::result("engine/" + name, "rate", rates.best(), "cycles/s");
    bench::result("engine/" + name, "rate / a list's", ratio, "");
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> wanted(argv + 1, argv + argc);
    if (!std::filesystem::exists(test::shared_dir() / "perf" / "results.tsv")) {
        fmt::print("SKIPPED: there is no {}\n", (test::shared_dir() / "perf" / "results.tsv").string());
        return 0;
    }
    fmt::print("{:<42} {:>10} {:>10} {:>10} {:>8} {:>8} {:>8} {}\n", "", "cycles/s", "median", "x original",
               "build s", "MB", "MB/orig.", "2 threads (of two separate runs)");
    int failed = 0;
    const auto run = [&](const std::string& name, auto measure) {
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) return;
        std::fflush(stdout);
        const pid_t child = fork();
        if (child == 0) {
            const int status = measure();
            std::fflush(stdout);
            _exit(status);
        }
        int status = 0;
        waitpid(child, &status, 0);
        failed |= status;
    };
    for (const auto& original : originals()) run(original.name, [&] { return measure(original); });
    for (const char* name : {"all_to_all_30x30_random", "rect11_gauss_50x50_random"})
        if (std::filesystem::exists(test::shared_dir() / "perf" / (std::string(name) + ".iqr")))
            run(name, [&] { return compare_with_list(name); });
    return failed != 0;
}
