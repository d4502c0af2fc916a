// How do time and memory grow with a system?
//
//     bench_scaling [MAX_SYNAPSES]
//
// Groups of linear threshold cells, 10^3 to 10^6, each fed by its own source of random spikes, and random
// lists of 10^3 to 10^8 synapses (or as many as the argument says). Each system runs in its own process. The
// exponent is that of the cost against the size, fitted over the sizes from 10^4 on. Then 1,000 groups of 10
// cells are compared with one group of 10,000, in turns. Last result: docs/design/performance.md.
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/engine/simulation.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/bench/random_lists.h"
#include "tests/bench/report.h"

using namespace forage;

namespace {

struct Cost {
    double seconds = 0;  ///< per cycle
    double bytes = 0;    ///< memory of the engine; 0 when the system could not be built
    double build = 0;    ///< s
};

/// The memory of this process, bytes.
double resident() {
    std::ifstream file("/proc/self/statm");
    double pages = 0;
    file >> pages >> pages;
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

Cost measure(const model::System& system) {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics diagnostics;
    const double before = resident(), begin = bench::wall_seconds();
    auto simulation =
        engine::Simulation::build(system, registry, engine::Demand::everything(), {}, diagnostics);
    if (!simulation) return fmt::print(stderr, "{}", format(diagnostics)), Cost{};
    Cost cost;
    cost.build = bench::wall_seconds() - begin;
    simulation->start();
    simulation->step();
    cost.bytes = resident() - before;
    cost.seconds = 1 / bench::rates(bench::thread_seconds, [&] { simulation->step(); }).best();
    return cost;
}

/// Calls measure() in its own process.
Cost measure_apart(const model::System& system) {
    Cost cost;
    int ends[2];
    if (pipe(ends) != 0) return cost;
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        cost = measure(system);
        _exit(write(ends[1], &cost, sizeof cost) == sizeof cost ? 0 : 1);
    }
    close(ends[1]);
    if (read(ends[0], &cost, sizeof cost) != sizeof cost) cost = {};
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return cost;
}

/// The exponent b of the best fit of cost = a size^b, by least squares of the logarithms.
double exponent(const std::vector<std::pair<double, double>>& points) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const auto& [size, cost] : points) {
        const double u = std::log(size), v = std::log(cost);
        n += 1, x += u, y += v, xx += u * u, xy += u * v;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

template <class Make>
bool scale(const char* what, const std::vector<std::pair<int, int>>& sizes, Make make) {
    std::vector<std::pair<double, double>> points;
    for (const auto& [cells, each] : sizes) {
        const double size = static_cast<double>(cells) * each;
        const Cost cost = measure_apart(make(cells, each));
        if (cost.bytes == 0) return false;
        fmt::print(
            "{:>12.0f} {:<9} {:12.2f} us per cycle {:10.3f} ns each {:8.1f} bytes each {:8.2f} s to build\n",
            size, what, 1e6 * cost.seconds, 1e9 * cost.seconds / size, cost.bytes / size, cost.build);
        const std::string subject = fmt::format("scaling/{:.0e} {}", size, what);
        bench::result(subject, "time", 1e9 * cost.seconds / size, "ns each");
        bench::result(subject, "memory", cost.bytes / size, "bytes each");
        bench::result(subject, "build", cost.build, "s");
        if (size >= 1e4) points.emplace_back(size, cost.seconds);
    }
    if (points.size() < 2) return true;
    fmt::print("{:>12} {:<9} cost grows as size^{:.3f}\n", "", what, exponent(points));
    bench::result(fmt::format("scaling/{}", what), "exponent", exponent(points), "");
    return true;
}

/// A ring of linear threshold groups with `cells` cells in all, which excite the next one. Ten cells that
/// spike at random excite the first ten, or each group has as many such cells as it has itself.
model::System ring(int groups, int cells, bool sources, int width) {
    model::System system;
    const auto process = model::add_process(system, "P");
    const int each = cells / groups;
    std::vector<std::string> members;
    const auto excite = [&](const std::string& to, int count) {
        const auto from = model::add_group(system, process, "S" + to, count, 1, "neuronRandomSpike");
        model::set_parameter(model::find_group(system, from)->neuron, "probability", "0.3");
        const auto id =
            model::add_connection(system, from, to, InputKind::excitatory, "synapseFixedWeight", "in-" + to);
        model::find_connection(system, id)->pattern =
            model::MappedPattern{{}, {}, model::Region{1, 1, count, 1, {}}};
    };
    for (int i = 0; i < groups; ++i) {
        members.push_back(
            model::add_group(system, process, fmt::format("G{:04}", i), each, 1, "neuronLinearThreshold"));
        if (sources || i == 0) excite(members.back(), sources ? each : 10);
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
        const auto id =
            model::add_connection(system, members[i], members[(i + 1) % members.size()],
                                  InputKind::excitatory, "synapseFixedWeight", fmt::format("ring-{:04}", i));
        auto& c = *model::find_connection(system, id);
        model::set_parameter(*c.synapse, "weight", "0.5");
        c.arborization.shape = model::RectArbor{width, 1};
    }
    return system;
}

/// Compares many groups with one of as many cells.
bool compare_groups(const char* what, bool sources, int width) {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics diagnostics;
    const auto built = [&](int groups) {
        engine::Demand demand;  // as in a run that records activities
        const auto system = ring(groups, 10'000, sources, width);
        auto layout = *engine::make_layout(system, registry, diagnostics);
        for (int g = 0; g < std::ssize(layout.groups); ++g) demand.read_group(g);
        auto simulation = *engine::Simulation::build(system, std::move(layout), demand, {}, diagnostics);
        simulation.start();
        return simulation;
    };
    auto many = built(1000), one = built(1);
    const auto rates = bench::rates_in_turns(
        bench::thread_seconds, [&] { many.step(); }, [&] { one.step(); });
    const double ratio = rates[1].best() / rates[0].best();
    fmt::print("1,000 groups of 10, {}: {:.2f} us per cycle, one group of 10,000: {:.2f}; ratio {:.2f}\n",
               what, 1e6 / rates[0].best(), 1e6 / rates[1].best(), ratio);
    const std::string subject = fmt::format("scaling/1,000 groups of 10, {}", what);
    bench::result(subject, "time", 1e6 / rates[0].best(), "us");
    bench::result(subject, "time / of one group", ratio, "");
    return diagnostics.errors() == 0;
}

}  // namespace

int main(int argc, char** argv) {
    const double most = argc > 1 ? std::atof(argv[1]) : 1e8;
    const auto neurons = [](int cells, int) {
        model::System system;
        const auto process = model::add_process(system, "P");
        const auto from = model::add_group(system, process, "From", cells, 1, "neuronRandomSpike");
        const auto to = model::add_group(system, process, "To", cells, 1, "neuronLinearThreshold");
        model::set_parameter(model::find_group(system, from)->neuron, "probability", "0.3");
        model::add_connection(system, from, to, InputKind::excitatory, "synapseFixedWeight");
        return system;
    };
    std::vector<std::pair<int, int>> lists;
    for (const auto& [cells, each] :
         {std::pair{100, 10}, std::pair{1000, 10}, std::pair{10'000, 10}, std::pair{10'000, 100},
          std::pair{20'000, 500}, std::pair{50'000, 2000}})
        if (static_cast<double>(cells) * each <= most) lists.emplace_back(cells, each);
    const bool good =
        scale("neurons", {{1000, 1}, {10'000, 1}, {100'000, 1}, {1'000'000, 1}}, neurons) &&
        scale("synapses", lists, [](int cells, int each) { return bench::random_lists(cells, each); }) &&
        compare_groups("ring, one to one", false, 1) &&
        compare_groups("ring, one to one, a random source each", true, 1) &&
        compare_groups("ring, three synapses per cell", false, 3);
    return good ? 0 : 1;
}
