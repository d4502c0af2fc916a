#include "core/run/run.h"

#include <cmath>

#include "core/run/environment.h"
#include "core/run/result_files.h"
#include "tests/unit/core/engine/simulations.h"
#include "tools/api/forage/forage.h"

using namespace forage;

namespace {

/// A world without robots: a number that grows by one in each cycle, which the module "senses" reads.
class Tide final : public Environment {
  public:
    double level = 0;
    double seconds_per_cycle() const override { return 0.5; }
    void step() override { ++level; }
    void checkpoint(Archive& archive) override { archive(level); }
};

/// Writes the level of a Tide into its group.
struct Senses {
    static void describe(ModuleSpec<Senses>& s) { s.name("senses", "Senses").output("level", "Level"); }
    void start(const ModulePorts& ports, ModuleFrame&) { tide_ = dynamic_cast<Tide*>(ports.environment); }
    void update(ModuleFrame& frame) { frame.output(0).setConstant(tide_ ? tide_->level : -1); }
    void checkpoint(Archive&) {}

  private:
    Tide* tide_ = nullptr;
};

model::System system_with_senses() {
    model::System system;
    const auto p = model::add_process(system, "P");
    const auto a = model::add_group(system, p, "A", 2, 1, "neuronLinearThreshold");
    model::add_group(system, p, "Alone", 1, 1, "counter");
    auto& module = system.processes.front().module.emplace();
    module.type = "senses";
    module.outputs.push_back({"level", a, {}});
    return system;
}

Registry types_with_senses() {
    Registry types = test::registry();
    types.add(module_type<Senses>());
    return types;
}

Run tidal(OpenOptions options = {}) {
    return forage::open(system_with_senses(), types_with_senses(), std::make_unique<Tide>(), options);
}

}  // namespace

TEST_CASE("A run steps its environment, and modules read it") {
    Run run = tidal();
    const auto& a = run.record("P/A");
    const auto& mean = run.record("mean:P/A", 2);
    CHECK(run.until({.cycles = 4}).empty());
    CHECK(run.cycle() == 4);
    CHECK(run.seconds() == 2);
    // Read in cycle t, received in t + 1; the level is t in cycle t.
    CHECK(a.cycles() == std::vector<std::uint64_t>{0, 1, 2, 3});
    for (int t = 0; t < 4; ++t) CHECK(a.rows()(t, 1) == std::max(0, t - 1));
    CHECK(mean.rows().rows() == 2);
    CHECK(mean.rows()(1, 0) == 1);
    CHECK(run.trials().finished.empty());
}

TEST_CASE("A run ends when a condition holds") {
    Run run = tidal();
    CHECK(run.until({.cycles = 100, .until = {"P/A(1,1) >= 3"}}) == "'P/A(1,1) >= 3' held");
    CHECK(run.cycle() == 5);
    CHECK(run.until({.cycles = 2}).empty());  // counted from now on
    CHECK(run.cycle() == 7);
    CHECK_THROWS_AS(run.until({.trials = 1}), InputError);
}

TEST_CASE("Lengths in seconds add up, also where they are no whole number of cycles") {
    const auto ended = [](Run& run, double seconds) { return run.until({.seconds = seconds}), run.cycle(); };
    Run run = tidal();  // cycles of 0.5 s
    CHECK(ended(run, 0.75) == 2);
    CHECK(ended(run, 0.75) == 3);
    for (int i = 0; i < 1000; ++i) run.until({.seconds = 0.1});
    CHECK(run.cycle() == 203);
    CHECK(ended(run, 0.1) == 204);
    run.step();  // from here on, as the run was moved on otherwise
    CHECK(ended(run, 0.1) == 206);
    CHECK(ended(run, 0.4) == 206);
    CHECK(ended(run, 0.1) == 207);
    CHECK_THROWS_AS(ended(run, -1), InputError);
    CHECK(ended(run, 0.4) == 207);
}

TEST_CASE("A run refuses numbers that are not finite, and impossible numbers of threads") {
    Run run = tidal();
    run.step();
    CHECK_THROWS_AS(run.write("P/A", std::vector<double>{1, std::nan("")}), InputError);
    CHECK_THROWS_AS(tidal({.threads = 0}), InputError);
    CHECK_THROWS_AS(tidal({.threads = -1}), InputError);
}

TEST_CASE("States can be read and written, and parameters can be changed") {
    Run run = tidal();
    run.step(), run.step(), run.step();
    CHECK(run.read("P/A") == std::vector<double>{1, 1});
    CHECK(run.read("P/A:vm(2,1)") == std::vector<double>{1});
    run.set("P/A.vmPrs=1");
    run.write("P/A:vm", std::vector<double>{10, 20});
    run.step();
    CHECK(run.read("P/A") == std::vector<double>{12, 22});
    CHECK_THROWS_AS(run.read("P/B"), InputError);
    CHECK_THROWS_AS(run.write("P/A:vm", std::vector<double>{1}), InputError);
    CHECK_THROWS_AS(run.set("P/A.vmPrs=x"), InputError);
}

TEST_CASE("A run that computes only what is read reports when something else is requested") {
    Run run = tidal({.compute_everything = false});
    run.record("P/A");
    run.step();
    CHECK_THROWS_AS(run.record("P/Alone"), InputError);
    CHECK_THROWS_AS(run.read("P/Alone"), InputError);
    Run all = tidal();
    all.step();
    all.record("P/Alone");
    all.step();
    CHECK(all.read("P/Alone") == std::vector<double>{2});
}

TEST_CASE("A checkpoint contains everything that changes in a run") {
    const auto numbers = [](Run& run) { return run.read("P/A"); };
    Run first = tidal();
    const auto& recorded = first.record("P/A");
    first.until({.cycles = 5});
    Archive kept;
    first.checkpoint(kept);
    const std::string digest = first.digest();
    first.until({.cycles = 5});

    Run second = tidal();
    const auto& again = second.record("P/A");
    second.start();
    Archive archive{std::string_view(kept.bytes())};
    second.checkpoint(archive);
    CHECK(second.digest() == digest);
    second.until({.cycles = 5});
    CHECK(numbers(first) == numbers(second));
    CHECK(first.digest() == second.digest());
    CHECK((recorded.rows() == again.rows()).all());
}
