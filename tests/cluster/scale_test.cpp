// The bookkeeping of a million runs: planned, executed in a thousand parts with runs that cost nothing,
// merged, written as tables, and drawn.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>
#include <sys/resource.h>

#include "core/base/output_files.h"
#include "core/run/experiment/parts.h"
#include "core/run/experiment/tables.h"
#include "tests/support/catch.h"
#include "tests/support/folder.h"
#include "tools/api/experiment/results.h"

using namespace forage;

namespace {

/// Two sweeps of 100 and 200 values, and 50 seeds.
model::Experiment million_runs() {
    model::Experiment e;
    e.systems = {{"a.iqr"}};
    e.cycles = 1;
    e.seeds.clear();
    for (std::uint64_t s = 1; s <= 50; ++s) e.seeds.push_back(s);
    for (const auto& [name, count] : {std::pair("P/A.eta", 100), {"P/B.gain", 200}}) {
        model::Sweep sweep{{name}, {}, {}, e.sweeps.size()};
        for (int i = 0; i < count; ++i) sweep.values.push_back({fmt::format("{}", i * 0.1)});
        e.sweeps.push_back(std::move(sweep));
    }
    e.measures.resize(2);
    e.measures[0].name = "success", e.measures[1].name = "length";
    return e;
}

/// The numbers of a run, as functions of its index.
RunResult stub(std::size_t run) {
    RunResult out;
    out.cycles = run, out.seconds = static_cast<double>(run) * 0.1;
    out.measures = {static_cast<double>(run % 7) / 7, {}};
    if (run % 3) out.measures[1] = static_cast<double>(run % 101) * 0.3;
    return out;
}

}  // namespace

TEST_CASE("a million runs are planned, executed in a thousand parts, merged and drawn in less than 1 GB") {
    const test::Folder folder;
    const std::string directory = folder.path;
    const auto e = million_runs();
    const RunPlan plan(e, directory);
    REQUIRE(plan.size() == 1'000'000);
    const auto begun = std::chrono::steady_clock::now();
    const auto took = [&](const char* what) {
        const std::chrono::duration<double> s = std::chrono::steady_clock::now() - begun;
        std::cout << fmt::format("{:5.1f} s: {}\n", s.count(), what);
    };

    const RunKeys keys(plan, e);
    for (std::size_t part = 1; part <= 1000; ++part) {
        PartFile file(directory, Shard{part, 1000}.name());
        for (std::size_t run = part - 1; run < plan.size(); run += 1000)
            file.add(plan.name(run), keys[run], stub(run));
    }
    took("executed in parts");
    std::vector<RunResult> merged;
    {
        auto found = read_parts(directory, plan, e);
        REQUIRE(found.files.size() == 1000);
        REQUIRE(found.damaged == 0);
        REQUIRE(found.finished() == plan.size());
        for (auto& r : found.results) merged.push_back(std::move(*r)), r.reset();
    }
    took("read");
    write_file(directory + "/results.csv", results_csv(e, plan, merged));
    took("results.csv");
    for (const auto& [format, name] :
         {std::pair(observe::TableFormat::npy, "/results.npy"), {observe::TableFormat::hdf5, "/results.h5"}})
        observe::write_table(format, directory + name, results_columns(e, plan, merged), merged.size());
    took("results.npy and results.h5");
    const std::string summary = summary_csv(e, plan, merged);
    CHECK(std::count(summary.begin(), summary.end(), '\n') == 20'001);
    bool equal = true;
    for (std::size_t run = 0; run < plan.size(); ++run) {
        const RunResult whole = stub(run);
        equal &= whole.cycles == merged[run].cycles && whole.seconds == merged[run].seconds &&
                 whole.measures == merged[run].measures;
    }
    CHECK(equal);
    merged = {};
    took("summary.csv");
    Diagnostics diagnostics;
    auto results = open_results(directory);
    REQUIRE(results.experiment->rows.size() == plan.size());
    CHECK(draw(results, {"heat:success"}, {}, plot::Format::png, diagnostics).size() == 1);
    INFO(format(diagnostics));
    CHECK(!diagnostics.failed());
    took("a picture of all");
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::cout << usage.ru_maxrss / 1024 << " MB\n";
    CHECK(usage.ru_maxrss < 1'000'000);  // kB
}

TEST_CASE("a plan gives repeated runs names of their own") {
    model::Experiment e;
    e.systems = {{"a.iqr"}};
    e.seeds = {1, 2, 1};
    e.sweeps = {{{"P/A.eta"}, {{"0.1"}, {"0.1"}}, {}, 0}};
    const RunPlan plan(e, "out");
    std::vector<std::string> names;
    for (std::size_t i = 0; i < plan.size(); ++i) names.push_back(plan[i].name);
    CHECK(names == std::vector<std::string>{"eta-0.1_seed-1", "eta-0.1_seed-2", "eta-0.1_seed-1_2",
                                            "eta-0.1_seed-1_3", "eta-0.1_seed-2_2", "eta-0.1_seed-1_4"});
    CHECK(plan[5].spec.directory == "out/runs/eta-0.1_seed-1_4");
    CHECK(plan[5].spec.input.settings.front().text == "P/A.eta=0.1");
}
