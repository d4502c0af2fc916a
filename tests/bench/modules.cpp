// How many microseconds does an update of the adaptive and of the contextual layer take, at the tutorial's
// sizes?
#include <fmt/format.h>

#include "modules/adaptive_layer/module.h"
#include "modules/colour/module.h"
#include "modules/contextual_layer/module.h"
#include "tests/bench/report.h"
#include "tests/support/module_bench.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Prints and reports the microseconds per call.
template <class F>
void time_of(const std::string& what, int calls, F&& call) {
    const double begin = bench::thread_seconds();
    for (int i = 0; i < calls; ++i) call(i);
    const double each = 1e6 * (bench::thread_seconds() - begin) / calls;
    fmt::print("{:<30} {:8.2f} us\n", what, each);
    bench::result(fmt::format("module/{}", what), "update", each, "us");
}

void measure_adaptive_layer() {
    ModuleBench bench(module_type<adaptive::AdaptiveLayerModule>());
    bench.in("input", 2, 24).in("condition", 9, 1).out("prototype", 2, 24).out("output", 9, 1);
    bench.out("descripancy", 1, 1).out("weight display", 18, 24).seed(1);
    bench.set("eta", "0.005")
        .set("zeta", "0.97")
        .set("rho", "6")
        .set("init", "0.01")
        .set("discTime", "0.01")
        .start();
    time_of("moduleAL, no stimulus", 100000, [&](int) { bench.update(); });
    bench.inputs[0].segment(8, 4).setConstant(0.8);
    bench.inputs[1][2] = 0.5;
    time_of("moduleAL, learning", 100000, [&](int) { bench.update(); });
}

void measure_contextual_layer() {
    ModuleBench bench(module_type<contextual::ContextualLayerModule>());
    bench.in("action", 9, 1)
        .in("prototype", 2, 24)
        .in("stats", 2, 1)
        .in("discrepancy", 1, 1)
        .out("action", 9, 1);
    for (const char* display : {"empty", "collector", "distance", "selected", "trigger"})
        bench.out(display, 100, 50);
    bench.set("Memory Height", "50")
        .set("Memory Width", "100")
        .set("Memory Threshold", "0.9")
        .set("%-WTA", "0.95");
    bench.set("Trigger Reset", "1.1")
        .set("Trigger Decay", "0.005")
        .set("Discrepancy Threshold", "0.1")
        .start();
    time_of("moduleCL, closed", 10000, [&](int) { bench.update(); });
    bench.inputs[3][0] = 0.05;
    time_of("moduleCL, open, nothing stored", 10000, [&](int) { bench.update(); });
    const auto step = [&](int i) {
        bench.inputs[1] = (Eigen::ArrayXd::LinSpaced(48, 0, 47) * 0.7 + i * 0.05).sin().max(0);
        bench.inputs[0][i % 9] = 0.5;
        bench.update();
        bench.inputs[0].setZero();
    };
    for (const int length : {1, 10, 50}) {
        for (int i = 0; i < 50 * length; ++i) {
            bench.inputs[2][0] = i % length == length - 1;
            step(i);
        }
        bench.inputs[2][0] = 0;
        time_of(fmt::format("moduleCL, 50 sequences of {}", length), 2000, step);
    }
    bench.inputs[1].setZero();
    time_of("moduleCL, full, no prototype", 2000, [&](int) { bench.update(); });
}

void measure_colour() {
    ModuleBench bench(module_type<colour::ColourModule>());
    bench.in("_hue", 28, 28).in("_value", 28, 28).out("_color", 28, 336).start();
    bench.inputs[1].setConstant(0.5);
    time_of("moduleColor, same picture", 10000, [&](int) { bench.update(); });
    time_of("moduleColor, new picture", 10000, [&](int i) {
        bench.inputs[0] = Eigen::ArrayXd::LinSpaced(784, 0.001 * (i % 100), 0.9);
        bench.update();
    });
}

}  // namespace

int main() {
    measure_adaptive_layer();
    measure_contextual_layer();
    measure_colour();
}
