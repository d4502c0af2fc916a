#include "core/observe/observer.h"

#include <filesystem>
#include <fstream>

#include "core/run/result_files.h"
#include "core/run/run.h"
#include "tests/support/paths.h"
#include "tests/unit/core/engine/simulations.h"

using namespace forage;

namespace {

/// Records the calls of its functions.
class Witness final : public Observer {
  public:
    explicit Witness(std::vector<std::string>& log) : log_(log) {}
    void declare(engine::Demand& demand) const override { demand.overwrite_group(0); }
    void before_cycle(RunView& run) override { note("before", run); }
    void after_groups(RunView& run) override {
        note("groups", run);
        run.simulation.output(0).setConstant(7);
    }
    void after_cycle(RunView& run) override { note("after", run); }
    void finish(RunView&, ResultFiles& files) override {
        files.write("witness.txt", [&] { return log_.back(); });
        files.write("broken.txt", []() -> std::string { throw std::runtime_error("cannot"); });
        files.write("second.txt", [] { return "fine"; });
    }

  private:
    void note(const std::string& what, const RunView& run) {
        log_.push_back(what + " " + std::to_string(run.time.cycle) + " " +
                       std::to_string(static_cast<int>(run.simulation.state(0, 0)[0])));
    }
    std::vector<std::string>& log_;
};

}  // namespace

TEST_CASE(
    "Observers are called at fixed points of a cycle, may overwrite activities, and write files at the end") {
    model::System system;
    model::add_group(system, model::add_process(system, "P"), "A", 1, 1, "counter");
    Diagnostics diagnostics;
    Run run = *Run::make(system, test::registry(), nullptr, {.compute_everything = false}, diagnostics);
    std::vector<std::string> log;
    run.add(std::make_unique<Witness>(log));
    run.step(), run.step();
    CHECK(log == std::vector<std::string>{"before 0 0", "groups 0 1", "after 1 7", "before 1 7", "groups 1 8",
                                          "after 2 7"});

    const auto folder = test::temporary_path("forage_observer_test");
    std::filesystem::create_directories(folder);
    ResultFiles files(folder.string());
    run.finish(files);
    CHECK(files.names() == std::vector<std::string>{"second.txt", "witness.txt"});
    CHECK(files.problems() == std::vector<std::string>{"cannot"});
    std::string line;
    std::getline(std::ifstream(folder / "witness.txt"), line);
    CHECK(line == "after 2 7");
    std::filesystem::remove_all(folder);
}

TEST_CASE("An observer that is removed is not called any more") {
    model::System system;
    model::add_group(system, model::add_process(system, "P"), "A", 1, 1, "counter");
    Diagnostics diagnostics;
    Run run = *Run::make(system, test::registry(), nullptr, {}, diagnostics);
    std::vector<std::string> log;
    const auto& witness = run.add(std::make_unique<Witness>(log));
    run.step();
    run.remove(witness);
    run.step();
    CHECK(log.size() == 3);
    CHECK(run.read("P/A") == std::vector<double>{8});
}
