#include "core/run/run.h"

#include <algorithm>
#include <memory>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "core/base/digest.h"
#include "core/base/output_files.h"
#include "core/engine/adopt.h"
#include "core/engine/plan/compile.h"
#include "core/model/constants.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "core/run/argument_checks.h"
#include "core/run/module_files.h"
#include "core/run/result_files.h"
#include "core/run/stop_condition.h"

namespace forage {
namespace {

std::string describe(const engine::NotFinite& what, const engine::Layout& layout) {
    const auto& group = layout.groups[static_cast<std::size_t>(what.group)];
    const auto cell =
        group.shape.cells == group.shape.width * group.shape.height
            ? fmt::format("({}, {})", what.cell % group.shape.width + 1, what.cell / group.shape.width + 1)
            : fmt::format("{}", what.cell + 1);
    return fmt::format("in cycle {} '{}' of '{}' becomes {} in cell {}", what.cycle,
                       group.type.states[static_cast<std::size_t>(what.state)].name, group.path, what.value,
                       cell);
}

/// What two systems have in common that keeps states.
engine::Unchanged unchanged(const model::System& before, const model::System& after) {
    engine::Unchanged out;
    const model::GroupIndex then(before);
    for (const auto& p : after.processes)
        for (const auto& g : p.groups)
            if (const auto* was = then.find(g.id).group;
                was && was->neuron.type == g.neuron.type && was->topology == g.topology)
                out.groups.insert(g.id);
    const auto kept = [&](const std::vector<model::CrossReference>& ports) {
        return std::ranges::all_of(
            ports, [&](const auto& r) { return r.target.empty() || out.groups.contains(r.target); });
    };
    for (const auto& p : after.processes) {
        const auto was = std::ranges::find(before.processes, p.id, &model::Process::id);
        if (was == before.processes.end() || !p.module || !was->module || !was->module_enabled) continue;
        const auto &now = *p.module, &old = *was->module;
        if (now.type == old.type && now.inputs == old.inputs && now.outputs == old.outputs &&
            kept(now.inputs) && kept(now.outputs))
            out.modules.insert(p.id);
    }
    std::unordered_map<std::string_view, const model::Connection*> connections;
    for (const auto& c : before.connections) connections[c.id] = &c;
    for (const auto& c : after.connections) {
        const auto it = connections.find(c.id);
        if (it == connections.end()) continue;
        const auto& was = *it->second;
        if (c.source == was.source && c.target == was.target && c.kind == was.kind &&
            c.pattern == was.pattern && c.arborization == was.arborization &&
            c.attenuation == was.attenuation && c.delay == was.delay && c.synapse && was.synapse &&
            c.synapse->type == was.synapse->type && out.groups.contains(c.source) &&
            out.groups.contains(c.target))
            out.connections.insert(c.id);
    }
    return out;
}

}  // namespace

std::optional<Run> Run::make(model::System system, Registry registry,
                             std::unique_ptr<Environment> environment, const Options& options,
                             Diagnostics& diagnostics) {
    if (!model::compute(system, diagnostics)) return std::nullopt;
    auto layout = engine::make_layout(system, registry, diagnostics, environment.get());
    if (!check_threads(options.threads, diagnostics) || !layout) return std::nullopt;
    return Run(std::make_shared<const model::System>(std::move(system)),
               std::make_shared<const Registry>(std::move(registry)), std::move(environment),
               std::make_shared<const engine::Layout>(std::move(*layout)), options);
}

Run::Run(std::shared_ptr<const model::System> system, std::shared_ptr<const Registry> registry,
         std::unique_ptr<Environment> environment, std::shared_ptr<const engine::Layout> layout,
         const Options& options)
    : system_(std::move(system)),
      registry_(std::move(registry)),
      layout_(std::move(layout)),
      environment_(std::move(environment)),
      options_(options),
      seconds_per_cycle_(environment_ ? environment_->seconds_per_cycle()
                                      : model::seconds_per_cycle(*system_)) {
    if (options.compute_everything) demand_ = engine::Demand::everything();
    module_files_ = &add(std::make_unique<ModuleFiles>(options.directory));
}
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&& other) noexcept {
    if (this == &other) return *this;
    std::destroy_at(this);  // its parts in the order in which they need each other
    return *std::construct_at(this, std::move(other));
}
Run::~Run() = default;

Run Run::restarted(std::uint64_t seed, const std::string& directory) const {
    auto environment = environment_ ? environment_->restarted(seed) : nullptr;
    if (environment_ && !environment)
        throw InputError("the environment of this run cannot be restarted", "open the run again");
    Options options = options_;
    options.seed = seed, options.directory = directory;
    Run out(system_, registry_, std::move(environment), layout_, options);
    out.demand_ = demand_;
    out.plan_ = simulation_ ? simulation_->plan() : plan_;
    return out;
}

void Run::add_observer(std::unique_ptr<Observer> observer) {
    engine::Demand wanted;
    observer->declare(wanted);
    require(wanted, "what the observer reads or overwrites");
    observers_.push_back(std::move(observer));
}

std::size_t Run::prunable_groups(std::span<const int> read) const {
    if (!demand_.reads_everything()) return 0;
    engine::Demand demand;
    for (const auto& o : observers_) o->declare(demand);
    for (const int group : read) demand.read_group(group);
    return static_cast<std::size_t>(std::ranges::count(engine::prune(*layout_, demand).groups, true));
}

void Run::require(const engine::Demand& wanted, std::string_view name) const {
    if (!simulation_ || demand_.covers(wanted)) return;
    throw InputError(fmt::format("{} is not computed in this run", name),
                     "demand it before the first cycle, as an observer or when the run is opened, or compute "
                     "everything");
}

void Run::remove(const Observer& observer) {
    std::erase_if(observers_, [&](const auto& o) { return o.get() == &observer; });
}

bool Run::start(Diagnostics& diagnostics) {
    if (simulation_) return true;
    for (const auto& o : observers_) o->declare(demand_);
    const auto open = [files = module_files_](const auto& process, const auto& name) -> std::ostream& {
        return files->open(process, name);
    };
    simulation_ = engine::Simulation::build(*system_, layout_, demand_,
                                            {.seed = options_.seed,
                                             .threads = options_.threads,
                                             .environment = environment_.get(),
                                             .directory = options_.directory,
                                             .open = open},
                                            diagnostics, std::move(plan_));
    if (!simulation_) return false;
    for (const auto& o : observers_) o->check(*simulation_, diagnostics);
    if (diagnostics.failed()) return simulation_.reset(), false;
    module_files_->begin(observers_);
    simulation_->start();
    simulation_->check_finite(options_.check_finite);
    return true;
}

void Run::start() {
    if (simulation_) return;
    Diagnostics diagnostics;
    start(diagnostics);
    throw_errors(diagnostics);
}

SimTime Run::time() const {
    const int trial = has_trials() ? static_cast<int>(environment_->trials(0).size()) + 1 : 0;
    return {cycle(), seconds(), trial};
}

RunView Run::view() { return {*simulation_, environment_.get(), time(), *this}; }

void Run::step() {
    if (!simulation_) start();
    if (failed_)
        throw engine::RunError(fmt::format("cycle {} of this run failed: it cannot continue", cycle()));
    auto& simulation = *simulation_;
    RunView before = view();
    for (const auto& o : observers_) o->before_cycle(before);
    failed_ = true;
    simulation.update_groups();
    if (simulation.not_finite() && divergence_.empty())
        divergence_ = describe(*simulation.not_finite(), simulation.layout());
    for (const auto& o : observers_) o->after_groups(before);
    simulation.update_modules();
    simulation.update_connections();
    if (environment_) environment_->step();
    failed_ = false;
    RunView after = view();
    for (const auto& o : observers_) o->after_cycle(after);
}

std::string Run::until(const RunLength& length) {
    const EarlyEnd end = advance(length);
    return end.held ? fmt::format("'{}' held", length.until.text) : end.timeout;
}

EarlyEnd Run::advance(const RunLength& wanted_length, const AfterCycle& after_cycle) {
    Diagnostics diagnostics;
    RunLength length = wanted_length;
    length.in_code = true;
    const StopCondition stop = checked(diagnostics, StopCondition::make(length, *this, diagnostics));
    engine::Demand wanted;
    stop.declare(wanted);
    require(wanted, fmt::format("what '{}' reads", length.until.text));
    if (!simulation_) stop.declare(demand_);
    start();
    const auto origin = stop.begin(*this);
    overrun_ = stop.overrun(), overrun_at_ = cycle() + stop.cycles().value_or(0);
    while (!stop.reached(*this, origin)) {
        step();
        if (after_cycle) after_cycle(stop, origin);
        if (auto why = stop.timeout_reason(*this); !why.empty()) return {false, std::move(why)};
    }
    return {stop.holds(*this), {}};
}

std::vector<double> Run::read(std::string_view text) {
    Diagnostics diagnostics;
    const auto source = checked(diagnostics, observe::find_source(layout(), text, "read", diagnostics));
    start();
    engine::Demand wanted;
    source->declare(wanted);
    require(wanted, fmt::format("'{}'", text));
    std::vector<double> out(source->what().size());
    source->read(*simulation_, out);
    return out;
}

void Run::write(std::string_view text, std::span<const double> values) {
    Diagnostics diagnostics;
    const auto column = checked(diagnostics, observe::find_column(layout(), text, "write", diagnostics));
    if (column->state < 0)
        throw InputError(fmt::format("'{}' is an input, which cannot be overwritten", text));
    start();
    engine::Demand wanted;
    wanted.overwrite_group(column->group);
    require(wanted, fmt::format("'{}', to be overwritten,", text));
    Column state = simulation_->writable_state(column->group, column->state);
    check_finite(values, std::string(text));
    if (values.size() != static_cast<std::size_t>(state.size()))
        throw InputError(fmt::format("'{}' has {} cells, not {}", text, state.size(), values.size()));
    std::copy(values.begin(), values.end(), state.data());
}

void Run::set(std::string_view assignment, Diagnostics* warnings) {
    const auto change = check(assignment, warnings);
    simulation_->set(change);
}

model::Assignment Run::check(std::string_view assignment, Diagnostics* warnings) {
    Diagnostics diagnostics;
    const auto change = model::parse_assignment(*system_, *registry_, assignment, "set", diagnostics);
    throw_errors(diagnostics);
    start();
    simulation_->check({&*change, 1}, diagnostics);
    throw_errors(diagnostics);
    append(warnings, diagnostics);
    return *change;
}

ParameterValue Run::parameter(std::string_view name) {
    Diagnostics diagnostics;
    const auto which = model::find_parameter(*system_, *registry_, name, "parameter", diagnostics);
    throw_errors(diagnostics);
    start();
    return simulation_->parameter(*which);
}

MemoryRecorder& Run::record(std::string_view text, std::uint64_t every) {
    Diagnostics diagnostics;
    auto source = checked(diagnostics, observe::find_source(layout(), text, "record", diagnostics));
    return add(std::make_unique<MemoryRecorder>(std::move(*source), every));
}

MeasuredTrials Run::trials(std::size_t robot) const {
    MeasuredTrials out;
    if (!environment_ || robot >= environment_->robot_names().size()) return out;
    for (const auto& o : observers_)
        if (const auto* recorder = dynamic_cast<const TrialRecorder*>(o.get());
            recorder && recorder->robot() == robot && simulation_)
            return recorder->trials(*environment_, *simulation_);
    for (const auto& t : environment_->trials(robot)) out.finished.push_back({t, {}, {}});
    return out;
}

std::vector<std::optional<double>> Run::measure(RunMeasures& measures) {
    start();
    RunView now = view();
    return measures.values(now);
}

void Run::finish(ResultFiles& files) {
    if (!simulation_) return;
    RunView now = view();
    for (const auto& o : observers_) o->finish(now, files);
}

void Run::checkpoint(Archive& archive) {
    archive(*simulation_);
    if (environment_) environment_->checkpoint(archive);
    archive(divergence_);
    if (!divergence_.empty()) simulation_->check_finite(false);
    for (const auto& o : observers_) o->checkpoint(archive);
}

void Run::adopt(Run& old) {
    start();
    simulation_->adopt(*old.simulation_, unchanged(*old.system_, *system_));
    if (environment_ && old.environment_) {
        Archive out;
        old.environment_->checkpoint(out);
        Archive in{std::string_view(out.bytes())};
        environment_->checkpoint(in);
    }
}

std::string Run::digest() {
    Archive archive(Archive::Nan::all_the_same);
    archive(*simulation_);
    if (environment_) environment_->checkpoint(archive);
    return forage::digest(archive.bytes());
}

}  // namespace forage
