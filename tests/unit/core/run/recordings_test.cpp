#include "core/run/recordings.h"

#include <filesystem>

#include "core/run/run.h"
#include "tests/support/paths.h"
#include "tests/unit/core/engine/simulations.h"

using namespace forage;

TEST_CASE("A recording that cannot be completed is not among the files of its run") {
    model::System system;
    const auto p = model::add_process(system, "P");
    model::add_group(system, p, "A", 1, 1, "counter");
    model::add_group(system, p, "B", 1, 1, "counter");
    Diagnostics diagnostics;
    Run run = *Run::make(system, test::registry(), nullptr, {}, diagnostics);
    const auto folder = test::temporary_path("forage_recordings_test");
    std::filesystem::create_directories(folder);
    const RecordOptions options;
    auto recorded = recorded_files({{.column = {"P/A=a.csv"}}, {.column = {"P/B=b.csv"}}}, options,
                                   run.layout(), diagnostics);
    REQUIRE(recorded.size() == 2);
    ResultFiles files(folder.string());
    run.add(std::make_unique<Recordings>(std::move(recorded), options, folder.string(),
                                         std::vector<std::pair<std::string, std::string>>{}))
        .begin_files(files);
    run.step();
    std::filesystem::create_directories(folder / "a.csv");
    run.finish(files);
    CHECK(files.problems().size() == 1);
    CHECK(files.names() == std::vector<std::string>{"b.csv"});
    REQUIRE(files.recordings().size() == 1);
    CHECK(files.recordings()[0].file == "b.csv");
    std::filesystem::remove_all(folder);
}
