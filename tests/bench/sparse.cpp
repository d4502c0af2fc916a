// Does a large list of synapses run at the speed of memory? And how much faster are connections that need no
// list?
//
//     bench_sparse
//
// A triad, a[i] = b[i] + s c[i], shows what one core moves (24 bytes per step, as STREAM counts). The list
// moves a weight (8 bytes) and the number of a source cell in its block (2) per synapse; the numbers of
// target cells, 2 bytes for several synapses, are not counted. Last result: docs/design/performance.md.
#include <vector>

#include <fmt/format.h>

#include "core/engine/simulation.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/bench/random_lists.h"
#include "tests/bench/report.h"
#include "tests/bench/two_threads.h"

using namespace forage;

namespace {

struct Triad {
    std::vector<double> a, b, c;
    explicit Triad(std::size_t n) : a(n), b(n, 1.0), c(n, 2.0) {}
    void operator()() {
        for (std::size_t i = 0; i < a.size(); ++i) a[i] = b[i] + 3 * c[i];
        asm volatile("" : : "g"(a.data()) : "memory");
    }
    double bytes() const { return 24.0 * static_cast<double>(a.size()); }
};

}  // namespace

int main() {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    Diagnostics diagnostics;
    Triad triad(8'000'000);
    for (const auto& [cells, each] : {std::pair{20'000, 1000}, std::pair{100'000, 200}}) {
        auto simulation = engine::Simulation::build(bench::random_lists(cells, each), registry,
                                                    engine::Demand::everything(), {}, diagnostics);
        if (!simulation) return fmt::print(stderr, "{}", format(diagnostics)), 1;
        simulation->start();
        simulation->step();
        const double synapses = static_cast<double>(simulation->synapses(0));
        const double bytes = synapses * (8 + 2);
        const auto [triads, lists] = bench::rates_in_turns(bench::thread_seconds, std::ref(triad), [&] {
            simulation->update_groups();
            simulation->update_connections();
        });
        const double speed = bytes * lists.best(), share = speed / (triad.bytes() * triads.best());
        const auto build_another = [&, cells = cells, each = each](int threads) {
            auto out =
                engine::Simulation::build(bench::random_lists(cells, each), registry,
                                          engine::Demand::everything(), {.threads = threads}, diagnostics);
            out->start();
            return out;
        };
        auto two = build_another(2), other = build_another(1);
        const auto gain = bench::gain_of_two_threads(*simulation, *other, *two);
        fmt::print(
            "{} x {} synapses ({}): {:.1f} GB/s, {:.0f} % of a triad's; {:.2f} times as fast with two "
            "threads, two separate runs gain {:.2f}\n",
            cells, each, simulation->connection_form(0), 1e-9 * speed, 100 * share, gain.shared, gain.apart);
        const std::string subject = fmt::format("sparse/{} cells x {} synapses", cells, each);
        bench::result(subject, "bandwidth", 1e-9 * speed, "GB/s");
        bench::result(subject, "bandwidth / triad's", share, "");
        bench::result(subject, "rate with two threads / with one", gain.shared, "");
        bench::result(subject, "rate of two side by side / of one", gain.apart, "");
    }
    return 0;
}
