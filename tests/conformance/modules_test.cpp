// Each module alone, driven by recorded input, gives the recorded output to the last bit.
#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <random>
#include <sstream>

#include "modules/adaptive_layer/module.h"
#include "modules/colour/module.h"
#include "modules/contextual_layer/module.h"
#include "tests/support/catch.h"
#include "tests/support/module_bench.h"
#include "tests/support/recorded_cases.h"

using namespace forage;
using namespace forage::test;

namespace {

using Path = std::filesystem::path;

/// The recorded cases of a module type, each name once.
std::vector<Path> cases_of(const std::string& type) {
    std::map<std::string, Path> out;
    for (const auto& folder : trace_folders("modules/" + type))
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            out.emplace(entry.path().filename().string(), entry.path());
    std::vector<Path> paths;
    for (const auto& [name, path] : out) paths.push_back(path);
    return paths;
}

/// Reads rows `step,v0,v1,...` into arrays that lie side by side.
class Table {
  public:
    explicit Table(const Path& path) : rows_(path) {}
    bool next(const std::vector<Eigen::ArrayXd*>& into) {
        if (!rows_.next(fields_)) return false;
        std::size_t column = 1;
        for (auto* values : into)
            for (auto& v : *values) v = number(fields_.at(column++));
        if (column != fields_.size()) throw std::runtime_error("a row of another length");
        return true;
    }

  private:
    Rows rows_;
    std::vector<std::string_view> fields_;
};

/// A recorded output group: dense, in a table that it may share, or by what changed (`step,index,value`).
class Recorded {
  public:
    Recorded(const Path& path, const ModulePorts& ports) : all_(path / "outputs.csv") {
        for (const auto& group : ports.outputs) {
            std::string name = group.port;
            std::replace(name.begin(), name.end(), ' ', '_');
            auto& values = values_.emplace_back(
                std::make_unique<Eigen::ArrayXd>(Eigen::ArrayXd::Zero(group.shape.cells)));
            if (const auto own = path / ("outputs_" + name + ".csv"); std::filesystem::exists(own))
                tables_.emplace_back(std::make_unique<Table>(own), values.get());
            else if (const auto delta = path / ("outputs_" + name + ".delta.csv");
                     std::filesystem::exists(delta))
                changes_.push_back({std::make_unique<Rows>(delta), values.get(), {}});
            else
                shared_.push_back(values.get());
        }
    }
    /// Goes to the next step.
    void next(int step) {
        if (!all_.next(shared_)) throw std::runtime_error("outputs.csv ends early");
        for (auto& [table, values] : tables_)
            if (!table->next({values})) throw std::runtime_error("a table ends early");
        for (auto& c : changes_)
            for (;;) {
                if (c.pending.empty() && !c.rows->next(c.pending)) break;
                if (number<int>(c.pending[0]) > step) break;
                (*c.values)[number<Index>(c.pending[1])] = number(c.pending[2]);
                c.pending.clear();
            }
    }
    const Eigen::ArrayXd& values(std::size_t output) const { return *values_[output]; }

  private:
    struct Changes {
        std::unique_ptr<Rows> rows;
        Eigen::ArrayXd* values;
        std::vector<std::string_view> pending;
    };
    /// outputs.csv is absent where every group has its own file.
    struct Optional {
        explicit Optional(const Path& path) {
            if (std::filesystem::exists(path)) table = std::make_unique<Table>(path);
        }
        bool next(const std::vector<Eigen::ArrayXd*>& into) { return !table || table->next(into); }
        std::unique_ptr<Table> table;
    };

    Optional all_;
    std::vector<std::unique_ptr<Eigen::ArrayXd>> values_;
    std::vector<Eigen::ArrayXd*> shared_;
    std::vector<std::pair<std::unique_ptr<Table>, Eigen::ArrayXd*>> tables_;
    std::vector<Changes> changes_;
};

Eigen::MatrixXd matrix(const Path& path) {
    std::vector<std::vector<double>> lines;
    Rows rows(path);
    for (std::vector<std::string_view> f; rows.next(f);) {
        lines.emplace_back();
        for (std::size_t i = 1; i < f.size(); ++i) lines.back().push_back(number(f[i]));
    }
    Eigen::MatrixXd out(static_cast<Index>(lines.size()), static_cast<Index>(lines.at(0).size()));
    for (std::size_t r = 0; r < lines.size(); ++r)
        for (std::size_t c = 0; c < lines[r].size(); ++c)
            out(static_cast<Index>(r), static_cast<Index>(c)) = lines[r][c];
    return out;
}

/// A folder that is removed at the end of the test.
struct Scratch {
    Path path =
        std::filesystem::temp_directory_path() / ("forage_modules_" + std::to_string(std::random_device{}()));
    Scratch() { std::filesystem::create_directories(path); }
    ~Scratch() { std::filesystem::remove_all(path); }
};

struct Run {
    std::string problem;  ///< the first number that differs, or nothing
    std::size_t compared = 0;
};

/// Plays a case into a module; `after_start` is called at the start and at each restart of the recording.
Run play(ModuleBench& bench, const Path& path, const Path& scratch,
         const std::function<void(bool restart)>& after_start, double tolerance = 0) {
    int steps = 0;
    std::vector<std::string_view> f;
    for (Rows rows(path / "params.csv"); rows.next(f);) {
        if (f[0] == "steps")
            steps = number<int>(f[1]);
        else if (f[0] == "File Name")
            bench.set("File Name", (scratch / "weights.txt").string());
        else if (f[0] != "note" && f[0] != "srand_seed")
            bench.set(std::string(f[0]), std::string(f[1]));
    }
    for (Rows rows(path / "groups.csv"); rows.next(f);)
        bench.bind(std::string(f[1]), f[0] == "out", number<int>(f[2]), number<int>(f[3]));
    struct Change {
        int step;
        std::string name, value;
    };
    std::vector<Change> changes;
    if (std::filesystem::exists(path / "param_changes.csv"))
        for (Rows rows(path / "param_changes.csv"); rows.next(f);)
            changes.push_back({number<int>(f[0]), std::string(f[1]), std::string(f[2])});
    for (const auto& problem : bench.problems()) return {problem.message};
    bench.start();
    after_start(false);

    Run run;
    Table drive(path / "inputs.csv");
    Recorded recorded(path, bench.ports());
    std::vector<Eigen::ArrayXd*> inputs;
    for (int step = 0; step < steps; ++step) {
        for (const auto& c : changes) {
            if (c.step != step) continue;
            if (c.name != "__restart__") {
                bench.set(c.name, c.value);
                continue;
            }
            bench.start();
            after_start(true);
        }
        inputs.clear();
        for (auto& values : bench.inputs) inputs.push_back(&values);
        if (!drive.next(inputs)) return {"inputs.csv ends early"};
        bench.update();
        recorded.next(step);
        for (std::size_t i = 0; i < bench.outputs.size(); ++i)
            for (Index cell = 0; cell < bench.outputs[i].size(); ++cell, ++run.compared)
                if (!same(bench.outputs[i][cell], recorded.values(i)[cell], tolerance)) {
                    std::ostringstream text;
                    text.precision(17);
                    text << "step " << step << ", " << bench.ports().outputs[i].port << '[' << cell
                         << "]: " << bench.outputs[i][cell] << ", recorded " << recorded.values(i)[cell];
                    run.problem = text.str();
                    return run;
                }
    }
    return run;
}

void report(const char* type, std::size_t cases, std::size_t numbers) {
    std::cout << type << ": " << cases << " cases, " << numbers << " numbers met\n";
}

}  // namespace

TEST_CASE("The adaptive layer gives the recorded numbers and ends with the recorded weights, bit by bit") {
    std::size_t numbers = 0;
    const auto cases = cases_of("moduleAL");
    REQUIRE(cases.size() >= 11);
    for (const auto& path : cases) {
        INFO(path.filename());
        Scratch scratch;
        ModuleBench bench(module_type<adaptive::AdaptiveLayerModule>());
        auto& module = bench.module<adaptive::AdaptiveLayerModule>();
        const auto run = play(bench, path, scratch.path, [&](bool restart) {
            module.layer().set_weights(
                matrix(path / (restart ? "restart_weights.csv" : "initial_weights.csv")));
        });
        CHECK(run.problem == "");
        CHECK(module.layer().weights() == matrix(path / "final_weights.csv"));
        if (std::filesystem::exists(path / "weights.txt"))
            CHECK(read_text(scratch.path / "weights.txt") == read_text(path / "weights.txt"));
        numbers += run.compared;
    }
    report("moduleAL", cases.size(), numbers);
}

TEST_CASE("The contextual layer gives the recorded numbers, bit by bit") {
    std::size_t numbers = 0;
    const auto cases = cases_of("moduleCL");
    REQUIRE(cases.size() >= 12);
    for (const auto& path : cases) {
        INFO(path.filename());
        ModuleBench bench(module_type<contextual::ContextualLayerModule>());
        const auto run = play(bench, path, {}, [](bool) {});
        CHECK(run.problem == "");
        numbers += run.compared;
    }
    report("moduleCL", cases.size(), numbers);
}

TEST_CASE("The colour module gives the recorded numbers, bit by bit") {
    std::size_t numbers = 0;
    const auto cases = cases_of("moduleColor");
    REQUIRE(cases.size() >= 6);
    for (const auto& path : cases) {
        INFO(path.filename());
        ModuleBench bench(module_type<colour::ColourModule>());
        const auto run = play(bench, path, {}, [](bool) {});
        CHECK(run.problem == "");
        numbers += run.compared;
    }
    report("moduleColor", cases.size(), numbers);
}
