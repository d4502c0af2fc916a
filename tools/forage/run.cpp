#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <thread>

#include "core/engine/simulation.h"
#include "core/observe/recorder.h"
#include "tools/forage/commands.h"
#include "tools/forage/files.h"
#include "tools/forage/paths.h"
#include "tools/forage/progress.h"
#include "tools/forage/results.h"
#include "tools/forage/stop.h"
#include "tools/plot/trajectory.h"

namespace forage::tool {
namespace {

constexpr double default_seconds = 60;

/// Overwrites activities with the rows of a table, each from its cycle on.
class Clamp {
  public:
    Clamp(const replay::DriveTable* table, const engine::Simulation& simulation, Diagnostics& diagnostics) {
        if (!table) return;
        for (const auto& row : table->rows()) {
            const auto column = observe::find_column(simulation, row.process + "/" + row.target, "--clamp", diagnostics);
            if (!column) return;
            const int cells = simulation.shape(column->group).cells;
            if (row.values.size() != static_cast<std::size_t>(cells)) {
                diagnostics.error({}, fmt::format("--clamp, line {}: {} values for '{}', which has {} cells", row.line, row.values.size(),
                                                  simulation.path(column->group), cells));
                return;
            }
            rows_.push_back({column->group, &row});
        }
    }
    void apply(engine::Simulation& simulation) {
        for (; next_ < rows_.size() && rows_[next_].second->cycle <= static_cast<std::int64_t>(simulation.cycle()); ++next_)
            held_[rows_[next_].first] = rows_[next_].second;
        for (const auto& [group, row] : held_)
            simulation.output(group) = ConstColumn(row->values.data(), static_cast<Index>(row->values.size()));
    }

  private:
    std::vector<std::pair<int, const replay::DriveTable::Row*>> rows_;
    std::size_t next_ = 0;
    std::map<int, const replay::DriveTable::Row*> held_;
};

/// When a run is over, and how far it is.
class Length {
  public:
    Length(const RunOptions& o, const bug::World* world, double seconds_per_cycle) : world_(world), trials_(o.trials) {
        if (o.cycles) cycles_ = *o.cycles;
        else if (!o.trials) cycles_ = static_cast<std::uint64_t>(std::ceil(o.seconds.value_or(default_seconds) / seconds_per_cycle - 1e-9));
        if (o.trials) longest_trial_ = static_cast<std::uint64_t>(std::ceil(o.longest_trial / seconds_per_cycle));
    }
    bool over(std::uint64_t cycle) const {
        if (trials_) return world_->trials(0).size() >= static_cast<std::size_t>(*trials_);
        return cycle >= cycles_;
    }
    /// Why a run has to end before its time; empty when it has not.
    std::string hopeless() const {
        if (!trials_ || world_->current_trial(0).cycles < longest_trial_) return {};
        return fmt::format("trial {} did not end within {:g} s (--longest-trial)", world_->trials(0).size() + 1,
                           static_cast<double>(longest_trial_) * world_->seconds_per_cycle());
    }
    double done(std::uint64_t cycle) const {
        if (trials_) return static_cast<double>(world_->trials(0).size()) / *trials_;
        return static_cast<double>(cycle) / static_cast<double>(cycles_);
    }
    std::string text() const {
        if (!world_ || world_->bugs() == 0) return {};
        std::size_t reached = 0;
        for (const auto& t : world_->trials(0)) reached += t.target();
        const std::string all = trials_ ? fmt::format("/{}", *trials_) : "";
        return fmt::format("{}{} trials, {} at the target", world_->trials(0).size(), all, reached);
    }

  private:
    const bug::World* world_;
    std::optional<int> trials_;
    std::uint64_t cycles_ = 0, longest_trial_ = 0;
};

void check_length(const RunOptions& o, const Loaded& loaded, Diagnostics& diagnostics) {
    if (!o.trials) return;
    if (!loaded.world)
        diagnostics.error({}, "--trials needs a world", "add --world FILE.world, or give the length with --cycles");
    else if (loaded.world->bugs() == 0)
        diagnostics.error({}, "--trials: there is no robot in the world");
    else if (!loaded.world->reset_plan())
        diagnostics.error({}, "--trials: this world never resets the robot, so it has no trials",
                          "give the length with --cycles or --seconds, or add models named Reset_0, Reset_1, ... to the world");
}

/// A column that is recorded, and the name that its file gets.
struct Recording {
    std::string file;
    observe::Recorder recorder;
};

std::vector<Recording> open_recordings(const RunOptions& o, const engine::Simulation& simulation, Diagnostics& diagnostics) {
    std::map<std::string, observe::ColumnRef> columns;  // by file name
    for (const auto& text : o.recordings) {
        auto column = observe::find_column(simulation, text, "--record", diagnostics);
        if (!column) continue;
        std::string file = file_name(column->name) + ".csv";
        if (const auto it = columns.find(file); it != columns.end() && it->second.name != column->name)
            file = file_name(column->name + "_" + simulation.id(column->group)) + ".csv";
        columns.emplace(std::move(file), std::move(*column));
    }
    if (!columns.empty() && o.directory.empty())
        diagnostics.error({}, "--record needs a directory to write to", "leave out -o '' or name one");
    std::vector<Recording> out;
    if (diagnostics.failed()) return out;
    try {
        for (auto& [file, column] : columns)
            out.push_back({file, {partial(o.directory + "/" + file), simulation, std::move(column), o.every}});
    } catch (...) {
        for (const auto& r : out) std::remove(r.recorder.path().c_str());
        throw;
    }
    return out;
}

/// Runs a system that has started. One pass of the loop is one cycle: the system, then its world.
class Run {
  public:
    Run(const RunOptions& options, Loaded& loaded, engine::Simulation& simulation, std::vector<Recording>& recordings, Clamp& clamp)
        : o_(options), loaded_(loaded), simulation_(simulation), recordings_(recordings), clamp_(clamp),
          seconds_per_cycle_(loaded.world ? loaded.world->seconds_per_cycle() : 1 / cycles_per_second(loaded.system)),
          length_(options, loaded.world.get(), seconds_per_cycle_), progress_(!options.quiet) {
        if (loaded.world)
            for (std::size_t i = 0; i < loaded.world->bugs(); ++i) paths.emplace_back(*loaded.world, i);
    }

    /// Runs to the end, and closes what was opened whatever happens.
    void go(Outcome& outcome) {
        try {
            loop(outcome);
        } catch (...) {
            finish(outcome);
            for (auto& r : recordings_) r.recorder.close();
            throw;
        }
        finish(outcome);
        for (auto& r : recordings_) r.recorder.close();
    }

    std::vector<PathLog> paths;  ///< one per robot

  private:
    void loop(Outcome& outcome) {
        while (!length_.over(simulation_.cycle())) {
            simulation_.update_groups();
            clamp_.apply(simulation_);
            simulation_.update_modules();
            simulation_.update_connections();
            if (loaded_.world) loaded_.world->step();
            for (auto& r : recordings_) r.recorder.record(simulation_);
            for (auto& p : paths) p.follow();
            if (o_.real_time) wait();
            if (progress_.due()) progress_.draw({length_.done(simulation_.cycle()), simulation_.cycle(), seconds(), length_.text()});
            outcome.stopped = length_.hopeless();
            if (const int signal = noted_signal()) outcome.stopped = fmt::format("by signal {}", signal);
            if (!outcome.stopped.empty()) break;
        }
    }
    void finish(Outcome& outcome) {
        outcome.cycles = simulation_.cycle();
        outcome.seconds = seconds();
        outcome.clock = std::max(progress_.elapsed(), 1e-9);
        progress_.clear();
    }
    double seconds() const { return static_cast<double>(simulation_.cycle()) * seconds_per_cycle_; }
    void wait() const {
        const double ahead = seconds() - progress_.elapsed();
        if (ahead > 0) std::this_thread::sleep_for(std::chrono::duration<double>(ahead));
    }

    const RunOptions& o_;
    Loaded& loaded_;
    engine::Simulation& simulation_;
    std::vector<Recording>& recordings_;
    Clamp& clamp_;
    double seconds_per_cycle_;
    Length length_;
    Progress progress_;
};

void write_results(const RunOptions& o, const Loaded& loaded, const std::vector<Recording>& recordings,
                   const std::vector<PathLog>& paths, Outcome& outcome) {
    const auto place = [&](const std::string& name) {
        outcome.files.push_back(name);
        return o.directory + "/" + name;
    };
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const std::string robot = paths.size() > 1 ? "_" + file_name(loaded.world->bug_names()[i]) : "";
        const std::string picture = place("trajectory" + robot + ".png");
        plot::draw_trajectory(*loaded.world, paths[i].paths(), loaded.system.name, partial(picture));
        finish(picture);
        write_file(place("trials" + robot + ".csv"), trials_csv(trials_of(*loaded.world, i)));
    }
    for (const auto& r : recordings) finish(place(r.file));
    write_file(place("run.json"), run_json(o, loaded, outcome));
}

}  // namespace

int run(const RunOptions& options) {
    Diagnostics diagnostics;
    auto loaded = load(options.input, diagnostics);
    if (loaded) check_length(options, *loaded, diagnostics);
    std::optional<engine::Simulation> simulation;
    if (loaded && !diagnostics.failed())
        simulation = engine::Simulation::build(loaded->system, loaded->registry, {options.input.seed}, diagnostics);
    std::optional<Clamp> clamp;
    std::vector<Recording> recordings;
    if (simulation) {
        clamp.emplace(loaded->clamp.get(), *simulation, diagnostics);
        try {
            simulation->start();
            if (!options.directory.empty() && !diagnostics.failed()) make_directory(options.directory);
            recordings = open_recordings(options, *simulation, diagnostics);
        } catch (const std::exception& e) {
            diagnostics.error({}, e.what());
        }
    }
    if (diagnostics.failed() || !options.quiet) fmt::print(stderr, "{}", format(diagnostics));
    if (diagnostics.failed()) return bad_input;

    note_signals();
    Run run(options, *loaded, *simulation, recordings, *clamp);
    Outcome outcome;
    std::string failure;
    try {
        run.go(outcome);
    } catch (const std::exception& e) {
        outcome.stopped = failure = e.what();
    }
    if (!options.directory.empty()) write_results(options, *loaded, recordings, run.paths, outcome);
    if (!failure.empty()) {
        fmt::print(stderr, "error: {}\n", failure);
        return run_failed;
    }
    if (!options.quiet) fmt::print("{}", summary(options, *loaded, outcome));
    return noted_signal() ? 128 + noted_signal() : fine;
}

}  // namespace forage::tool
