// Equations: what they compute, and what is said about mistakes.
#include <algorithm>
#include <string>
#include <vector>

#include "core/equations/compile.h"
#include "tests/support/catch.h"

namespace forage::equations {
namespace {

struct Result {
    Compiled compiled;
    std::vector<std::string> mistakes;  ///< "place: message"
};

Result compiled(const std::string& text, const Vocabulary& names = {}) {
    Result out;
    out.compiled = compile(text, names, [&](const FormulaError& e) {
        out.mistakes.push_back(std::to_string(e.at) + ": " + e.what());
    });
    return out;
}

/// The states after a cycle of one cell in which all columns that are read hold `read`.
std::vector<double> states(const std::string& text, double read, const Vocabulary& names = {},
                           std::vector<double> scalars = {0.5, 0}) {
    const auto [c, mistakes] = compiled(text, names);
    REQUIRE(mistakes.empty());
    std::vector<double> out(c.states.size(), read);
    std::vector<const double*> columns(c.reads.size(), &read);
    std::vector<double*> written;
    for (const auto s : c.written) written.push_back(&out[s]);
    c.program.run(scalars, columns, written, 1);
    return out;
}

TEST_CASE("a state has its new value with a prime, and its old one without") {
    CHECK(states("x' = x + 1; y = x; z' = x' + y; output x", 2) == std::vector<double>{3, 5});
}

TEST_CASE("a derivative is a step of Euler") {
    CHECK(states("dx/dt = -x / 4; output x", 2) == std::vector<double>{2 + 0.5 * (-2.0 / 4)});
}

TEST_CASE("what happens on a condition sees what was computed above") {
    const std::string text = "v' = v + exc; when v' >= 3: v' = 0, n' = n + v'; output v";
    CHECK(states(text, 1) == std::vector<double>{2, 1});
    CHECK(states(text, 2) == std::vector<double>{0, 2});
}

TEST_CASE("the output is a state, a formula, or a value") {
    CHECK(compiled("x' = exc; output x").compiled.states == std::vector<std::string>{"x"});
    CHECK(states("x' = exc; output y = max(x', 3)", 2) == std::vector<double>{2, 3});
    CHECK(states("s = exc > 1; output s", 2) == std::vector<double>{1});
}

TEST_CASE("equations may have remarks and formulas of several lines") {
    CHECK(states("# a unit\noutput y = max(exc,  # half-wave\n  3)\n", 1) == std::vector<double>{3});
}

TEST_CASE("columns change places in one cycle") {
    const auto c = compiled("x' = y; y' = x; output x").compiled;
    double x = 1, y = 2;
    std::vector<const double*> read;
    for (const auto& r : c.reads) read.push_back(r.index == 0 ? &x : &y);
    std::vector<double*> written;
    for (const auto s : c.written) written.push_back(s == 0 ? &x : &y);
    c.program.run(std::vector<double>{1, 0}, read, written, 1);
    CHECK(x == 2);
    CHECK(y == 1);
}

TEST_CASE("a program computes what formulas are, in every cell") {
    for (const std::string text :
         {"x + 2 * x - x / 3", "x^2 + x^3 + x^1.5", "-x", "x < 1", "x >= 1 and x < 2 or x == 0.5",
          "not (x > 1)", "min(x, 1, 0.7) + max(x, 1)", "abs(-x) + exp(x) + log(x) + sqrt(x)",
          "sin(x) + cos(x) + tanh(x)", "clip(x, 0.8, 1.5)", "floor(x * 3) + round(x * 3)",
          "if(x > 1, x, 2 * x)"}) {
        CAPTURE(text);
        const auto c = compiled("output y = " + text, {false, {}, {"x"}, {}});
        REQUIRE(c.mistakes.empty());
        std::vector<double> in, out(1000);
        for (int i = 0; i < 1000; ++i) in.push_back(0.5 + i / 500.0);
        const double* read[] = {in.data()};
        double* written[] = {out.data()};
        c.compiled.program.run(std::vector<double>{1, 0}, read, written, 1000);
        const Formula formula(text);
        for (int i = 0; i < 1000; ++i)
            REQUIRE(out[i] == formula.value([&](const std::string&, std::size_t) { return in[i]; }));
    }
}

TEST_CASE("a rule of synapses sees the last cycle and this one at both ends") {
    const Vocabulary names{true, {}, {}, {}};
    const auto c = compiled("w' = w + pre * post' * post.theta; output psp = w' * pre'", names).compiled;
    CHECK(c.states == std::vector<std::string>{"w", "psp", "pre"});
    CHECK(c.output == 1);
    std::vector<Read::Kind> kinds;
    for (const auto& r : c.reads) kinds.push_back(r.kind);
    CHECK(std::ranges::count(kinds, Read::Kind::post) == 1);
    CHECK(std::ranges::count(kinds, Read::Kind::post_now) == 1);
}

using Mistakes = std::vector<std::string>;

TEST_CASE("mistakes are reported at their places, and nothing that follows from them") {
    const auto said = [](const std::string& text, const Vocabulary& names = {}) {
        return compiled(text, names).mistakes;
    };
    CHECK(said("x' = tua; y = x' + tua2; output x") ==
          Mistakes{"5: there is no 'tua' in these equations", "19: there is no 'tua2' in these equations"});
    CHECK(said("u = v'; v' = exc; output v") == Mistakes{"4: v' is not computed yet"});
    CHECK(said("u = exc; x' = u'; output x") == Mistakes{"14: 'u' is no state, so there is no u'"});
    CHECK(said("x' = 1; x' = 2; output x") == Mistakes{"8: x' is computed twice"});
    CHECK(said("x' = 1; x = 2; output x") == Mistakes{"8: 'x' is a state"});
    CHECK(said("dt = 1; output x = exc") == Mistakes{"0: 'dt' is a time and cannot be computed"});
    CHECK(said("tau = 1; output x = tau", {false, {"tau"}, {}, {}}) ==
          Mistakes{"0: 'tau' is a constant of the type and cannot be computed"});
    CHECK(said("y = u; u = exc; output x = y") == Mistakes{"4: 'u' is computed below"});
    CHECK(said("when exc > 1: x' = 1; n' = 2; output x") ==
          Mistakes{"22: after 'when', ',' divides the changes"});
    CHECK(said("x' = 1; when' = 2; output x").size() == 1);
    CHECK(said("dv/dt = exc : volt; output v").size() == 1);
    CHECK(said("v' = pre.v; output v", {true, {}, {}, {}}).size() == 1);
    CHECK(said("input push; input push; output x = push") ==
          Mistakes{"18: there is already an input 'push'"});
    CHECK(said("x' = exc") == Mistakes{"0: the equations name no output"});
    CHECK(said("output x = 1; output y = 2") == Mistakes{"21: 'x' is the output already"});
    CHECK(said("exc; output x = 1") == Mistakes{"0: this is no equation"});
    CHECK(said("x = exc +\n3 * inh\noutput x") == Mistakes{"9: something is missing at its end"});
    CHECK(said("v'' = exc; output x = 1").size() == 1);
    CHECK(said("when exc > 1 x' = 2; x' = 1; output x").size() == 1);
    CHECK(said("when exc > 1: dx/dt = 2; output x = 1").size() == 1);
    CHECK(said("output x = (1 + 2") == Mistakes{"11: this '(' is not closed"});
    CHECK(said("").size() == 1);
    CHECK(said("w' = normal(); output w", {true, {}, {}, {}}) ==
          Mistakes{"5: synapses draw no random numbers"});
}

TEST_CASE("equations that are probably not meant give warnings") {
    const auto warned = [](const std::string& text, bool synapse = false) {
        Mistakes out;
        const auto c = compiled(text, {synapse, {"tau"}, {}, {}});
        CHECK(c.mistakes.empty());
        for (const auto& w : c.compiled.warnings) out.push_back(std::to_string(w.at) + ": " + w.what());
        return out;
    };
    const Mistakes derivative{"0: x' is the value of x after this cycle, not its derivative"};
    CHECK(warned("x' = (exc - x) / tau; output x") == derivative);
    CHECK(warned("x' = -x / tau + exc; output x") == derivative);
    CHECK(warned("x' = x + dt * (exc - x) / tau; output x").empty());
    CHECK(warned("x' = x + (exc - x) / tau; output x").empty());
    CHECK(warned("x' = x * (1 - 1 / tau) + exc; output x").empty());
    CHECK(warned("u = exc; output x = tau") == Mistakes{"0: nothing uses 'u'"});
    CHECK(warned("w' = w + tau * pre; output psp = w' * pre", true) ==
          Mistakes{"38: this output arrives a cycle later than that of other types"});
    CHECK(warned("w' = w + tau * pre; output psp = w' * pre'", true).empty());
}

TEST_CASE("constants by which a derivative relaxes are time constants") {
    const Vocabulary names{false, {"tau", "C"}, {}, {}};
    CHECK(compiled("dx/dt = (exc - x) / tau; output x", names).compiled.time_constants ==
          std::vector<std::string>{"tau"});
    CHECK(compiled("dx/dt = exc - x / tau; output x", names).compiled.time_constants ==
          std::vector<std::string>{"tau"});
    CHECK(compiled("dx/dt = exc / C; output x", names).compiled.time_constants.empty());
}

}  // namespace
}  // namespace forage::equations
