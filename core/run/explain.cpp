#include "core/run/explain.h"

#include <algorithm>
#include <map>
#include <optional>
#include <queue>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "core/observe/manipulation.h"

namespace forage {
namespace {

using engine::Layout;
using observe::Spread;

constexpr std::array<const char*, input_kinds> kind_names = {"excitation", "inhibition", "modulation"};

/// A measured number, rounded as in the summaries of experiments.
std::string readable(double value) { return plain_number(value + 0.0, 4); }  // + 0.0 turns -0 into 0

std::size_t number_of(InputKind kind) { return static_cast<std::size_t>(kind); }

/// What ends at each group, and what begins there.
struct Wiring {
    struct Group {
        std::vector<int> incoming, ignored;  ///< connections; ignored: of a kind that the type does not read
        std::vector<int> writers, readers;   ///< enabled modules
        std::string disabled;                ///< a process whose disabled module would write to the group
        bool has_targets = false;
        bool driven() const { return !incoming.empty() || !writers.empty(); }
    };
    std::vector<Group> groups;

    Wiring(const model::System& system, const Layout& layout) : groups(layout.groups.size()) {
        for (int c = 0; c < std::ssize(layout.connections); ++c) {
            const auto& connection = layout.connections[at(c)];
            auto& target = groups[at(connection.target)];
            (connection.effective ? target.incoming : target.ignored).push_back(c);
            groups[at(connection.source)].has_targets = true;
        }
        for (int m = 0; m < std::ssize(layout.modules); ++m) {
            for (const int g : layout.modules[at(m)].input_groups)
                if (g >= 0) groups[at(g)].readers.push_back(m);
            for (const int g : layout.modules[at(m)].output_groups)
                if (g >= 0) groups[at(g)].writers.push_back(m);
        }
        std::map<std::string_view, std::size_t> by_id;
        for (std::size_t g = 0; g < groups.size(); ++g) by_id[layout.groups[g].id] = g;
        for (const auto& p : system.processes)
            if (p.module && !p.module_enabled)
                for (const auto& r : p.module->outputs)
                    if (const auto it = by_id.find(r.target); it != by_id.end())
                        groups[it->second].disabled = model::trim(p.name);
    }
    static std::size_t at(int number) { return static_cast<std::size_t>(number); }
};

bool reads_input(const NeuronType& type) {
    return std::ranges::any_of(type.reads, [](bool reads) { return reads; });
}

/// Whether anything leads to a group, even if it has no effect.
bool is_reached(const Wiring::Group& wires) {
    return wires.driven() || !wires.ignored.empty() || !wires.disabled.empty();
}

std::string undriven_text(const Layout& layout, std::size_t group, const Wiring::Group& wires) {
    std::string out = fmt::format("nothing drives group '{}'", layout.groups[group].path);
    if (!wires.readers.empty())
        out += fmt::format(", which the module of process '{}' reads",
                           layout.modules[static_cast<std::size_t>(wires.readers.front())].process);
    return out;
}

class Explainer {
  public:
    Explainer(const model::System& system, const Layout& layout, const observe::GroupStatistics& statistics,
              const std::set<int>& manipulated)
        : layout_(layout), seen_(statistics.groups()), manipulated_(manipulated), wiring_(system, layout) {
        for (const auto& p : system.processes)
            for (const auto& g : p.groups) uses_[g.id] = &g.neuron;
    }

    std::vector<std::string> notes() const {
        std::vector<std::string> out;
        std::vector<bool> explained(layout_.groups.size());
        for (std::size_t g = 0; g < layout_.groups.size(); ++g)
            for (const int m : wiring_.groups[g].readers)
                if (silent(g)) {
                    explain_ways_back(g, m, explained, out);
                    break;
                }
        for (std::size_t g = 0; g < layout_.groups.size(); ++g) {
            if (silent(g) && !explained[g] && is_first(g) &&
                (wiring_.groups[g].driven() || is_manipulated(g)))
                out.push_back(fmt::format("{} was silent: {}", name(g), why_silent(g)));
            if (auto text = clipped(g); !text.empty()) out.push_back(text);
        }
        return out;
    }

  private:
    static std::size_t at(int number) { return static_cast<std::size_t>(number); }
    const std::string& name(std::size_t g) const { return layout_.groups[g].path; }
    const Spread& activity(std::size_t g) const {
        return seen_[g].states[at(layout_.groups[g].type.output())];
    }
    bool silent(std::size_t g) const { return activity(g).silent(); }
    bool is_manipulated(std::size_t g) const { return manipulated_.contains(static_cast<int>(g)); }
    const Spread* state(std::size_t g, std::string_view state_name) const {
        const auto& states = layout_.groups[g].type.states;
        for (std::size_t s = 0; s < states.size(); ++s)
            if (states[s].name == state_name) return &seen_[g].states[s];
        return nullptr;
    }
    /// The value of a number or a switch among the parameters of a group's type.
    std::optional<double> parameter(std::size_t g, std::string_view parameter_name) const {
        const auto& type = layout_.groups[g].type;
        for (const auto& p : type.parameters)
            if (p.name == parameter_name) {
                const auto cell = type.make();
                model::apply(*uses_.at(layout_.groups[g].id), type.parameters, cell->parameters());
                const ParameterValue value = p.get(cell->parameters());
                if (const auto* number = std::get_if<double>(&value)) return *number;
                if (const auto* on = std::get_if<bool>(&value)) return *on;
            }
        return std::nullopt;
    }
    /// The groups from which a group is excited.
    std::vector<std::size_t> sources(std::size_t g) const {
        std::vector<std::size_t> out;
        for (const int c : wiring_.groups[g].incoming)
            if (const auto& connection = layout_.connections[at(c)]; connection.kind == InputKind::excitatory)
                if (const auto s = at(connection.source); std::ranges::find(out, s) == out.end())
                    out.push_back(s);
        return out;
    }
    /// Whether the silence of a group is not explained by the silence of all its sources.
    bool is_first(std::size_t g) const {
        const auto from = sources(g);
        return from.empty() || is_manipulated(g) ||
               std::ranges::any_of(from, [&](auto s) { return !silent(s); }) ||
               !wiring_.groups[g].writers.empty();
    }

    /// "; modulation was 0.3 on average", of a group with modulatory connections; else empty
    std::string modulation(std::size_t g) const {
        const auto is_modulatory = [&](int c) {
            return layout_.connections[at(c)].kind == InputKind::modulatory;
        };
        if (std::ranges::none_of(wiring_.groups[g].incoming, is_modulatory)) return {};
        const Spread& spread = seen_[g].inputs[number_of(InputKind::modulatory)];
        return spread.silent()
                   ? "; its modulation was 0 in every cycle"
                   : fmt::format("; its modulation was {} on average, {} to {}", readable(spread.mean()),
                                 readable(spread.least), readable(spread.most));
    }

    std::string why_silent(std::size_t g) const {
        if (is_manipulated(g)) return "its activity is set or changed by --clamp, --add or --multiply";
        return why_quiet(g) + (wiring_.groups[g].driven() ? modulation(g) : "");
    }

    std::string why_quiet(std::size_t g) const {
        const auto& type = layout_.groups[g].type;
        const auto& wires = wiring_.groups[g];
        const auto& inputs = seen_[g].inputs;
        const Spread &excitation = inputs[number_of(InputKind::excitatory)],
                     &inhibition = inputs[number_of(InputKind::inhibitory)];
        if (!reads_input(type))
            return fmt::format("{} reads no input, and its parameters keep it silent", type.name);
        if (!wires.driven()) {
            if (!wires.disabled.empty())
                return fmt::format("the module of process '{}', which writes to it, is disabled",
                                   wires.disabled);
            if (!wires.ignored.empty())
                return fmt::format("its only input is {}, which {} does not read",
                                   name_of(layout_.connections[at(wires.ignored[0])].kind), type.name);
            return "nothing drives it: no connection ends there, and no module writes to it";
        }
        if (type.reads[number_of(InputKind::excitatory)] && excitation.silent()) {
            std::vector<std::string> active;
            for (const auto s : sources(g))
                if (!silent(s)) active.push_back(name(s));
            if (!active.empty())
                return fmt::format(
                    "it received no excitation, although {} was active: look at the weight and the "
                    "attenuation of the connection, and at excGain",
                    separated(active, " and "));
            for (const int m : wires.writers)
                return fmt::format("the module of process '{}' wrote only zeros to it",
                                   layout_.modules[at(m)].process);
            return "it received no excitation";
        }
        if (type.reads[number_of(InputKind::excitatory)] && excitation.most <= 0)
            return "its excitation was never above 0: a weight, or the activity of a source, is negative";
        const auto* potential = state(g, "vm");
        if (const auto threshold = parameter(g, "threshold");
            potential && threshold && potential->most < *threshold) {
            std::string text = fmt::format("its potential vm was {} at most, and its threshold is {}",
                                           readable(potential->most), to_text(*threshold));
            if (inhibition.most > 0)
                text += fmt::format("; excitation was {} on average, inhibition {}",
                                    readable(excitation.mean()), readable(inhibition.mean()));
            return text;
        }
        if (readable(inhibition.mean()) == readable(excitation.mean()))
            return fmt::format("inhibition is as strong as excitation: {} on average",
                               readable(inhibition.mean()));
        if (inhibition.mean() > excitation.mean())
            return fmt::format("inhibition ({} on average) outweighs excitation ({})",
                               readable(inhibition.mean()), readable(excitation.mean()));
        return fmt::format("its input ({} on average) is not enough for {}", readable(excitation.mean()),
                           type.name);
    }

    /// One sentence for each way back from a silent group to one whose silence needs another explanation, the
    /// shortest way first. Groups that have a sentence get no other one, except as the first group.
    void explain_ways_back(std::size_t g, int reader, std::vector<bool>& explained,
                           std::vector<std::string>& out) const {
        constexpr std::size_t limit = 5;
        std::string begin =
            fmt::format("{} was silent, so the module of process '{}' read only zeros there: ", name(g),
                        layout_.modules[at(reader)].process);
        std::map<std::size_t, std::size_t> next{{g, g}};  // towards g
        std::queue<std::size_t> waiting({g});
        std::size_t found = 0, more = 0;
        explained[g] = true;
        for (; !waiting.empty(); waiting.pop()) {
            const std::size_t now = waiting.front();
            for (const auto s : sources(now))
                if (silent(s) && next.emplace(s, now).second) waiting.push(s);
            if (!is_first(now) || (found > 0 && explained[now])) continue;
            explained[now] = true;
            if (++found > limit) {
                ++more;
                continue;
            }
            out.push_back(begin + way_back(g, now, next) + why_silent(now));
            begin = "another way back: ";
        }
        if (found == 0)
            out.push_back(begin + "it belongs to a loop of silent groups that nothing outside drives");
        if (more > 0)
            out.push_back(
                fmt::format("{} other ways back from {} end at other silent groups", more, name(g)));
    }

    /// "A <- B <- C. C is the first silent group on the way back: ", from a group A; empty if A is C.
    std::string way_back(std::size_t from, std::size_t first,
                         const std::map<std::size_t, std::size_t>& next) const {
        if (first == from) return {};
        std::vector<std::string> names;
        for (std::size_t step = first; step != from; step = next.at(step)) names.push_back(name(step));
        names.push_back(name(from));
        std::ranges::reverse(names);
        return fmt::format("{}. {} is the first silent group on the way back: ", separated(names, " <- "),
                           name(first));
    }

    std::string clipped(std::size_t g) const {
        const auto* potential = state(g, "vm");
        const auto clips = parameter(g, "clipVm"), limit = parameter(g, "vmMax");
        if (!potential || !clips || *clips == 0 || !limit || potential->most < *limit ||
            seen_[g].inputs[number_of(InputKind::excitatory)].most <= *limit)
            return {};
        return fmt::format("{} was clipped: its excitation was up to {}, and vmMax keeps its potential at {}",
                           name(g), readable(seen_[g].inputs[number_of(InputKind::excitatory)].most),
                           to_text(*limit));
    }

    const Layout& layout_;
    const std::vector<observe::GroupStatistics::Group>& seen_;
    const std::set<int>& manipulated_;  ///< groups
    Wiring wiring_;
    std::map<std::string, const model::TypeUse*> uses_;  ///< by the group's id
};

}  // namespace

std::vector<std::string> wiring_notes(const model::System& system, const Layout& layout,
                                      const std::set<int>& manipulated) {
    std::vector<std::string> out;
    const Wiring wiring(system, layout);
    for (const auto& p : system.processes)
        if (p.module && !p.module_enabled)
            out.push_back(fmt::format("the module of process '{}' is disabled", model::trim(p.name)));
    for (std::size_t g = 0; g < wiring.groups.size(); ++g) {
        const auto& about = layout.groups[g];
        const auto& wires = wiring.groups[g];
        const bool used = wires.has_targets || !wires.readers.empty();
        if (manipulated.contains(static_cast<int>(g))) continue;
        if (is_reached(wires)) continue;
        if (!used)
            out.push_back(
                fmt::format("group '{}' has neither incoming nor outgoing connections", about.path));
        else if (reads_input(about.type))
            out.push_back(undriven_text(layout, g, wires));
    }
    std::map<std::string_view, std::vector<std::string>> lines;  // by name
    for (const auto& c : system.connections)
        if (!c.name.empty()) lines[c.name].push_back(std::to_string(c.at.line));
    for (const auto& [name, where] : lines)
        if (where.size() > 1)
            out.push_back(
                fmt::format("{} connections have the name '{}', on lines {}; options name them by their ids",
                            where.size(), name, separated(where, ", ")));
    return out;
}

std::vector<UndrivenInput> undriven_inputs(const model::System& system, const Layout& layout,
                                           const std::set<int>& manipulated) {
    std::vector<UndrivenInput> out;
    const Wiring wiring(system, layout);
    for (std::size_t g = 0; g < wiring.groups.size(); ++g)
        if (const auto& wires = wiring.groups[g]; !wires.readers.empty() && !is_reached(wires) &&
                                                  reads_input(layout.groups[g].type) &&
                                                  !manipulated.contains(static_cast<int>(g)))
            out.push_back({static_cast<int>(g), undriven_text(layout, g, wires)});
    return out;
}

std::vector<UndrivenRobot> undriven_robots(const Run& run) {
    std::vector<UndrivenRobot> out;
    const auto* world = run.environment();
    if (!world) return out;
    const auto names = world->robot_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (world->driven(i)) return {};
        out.push_back({names[i], fmt::format("no module drives the robot {}", names[i])});
    }
    return out;
}

std::string activity_table(const Layout& layout, const observe::GroupStatistics& statistics) {
    std::size_t widest = 5;
    for (const auto& g : layout.groups) widest = std::max(widest, g.path.size());
    std::string out = fmt::format("{:<{}}  {:>10}  {:>10}  {:>10}  {:>7}\n", "group", widest + 2, "mean",
                                  "least", "largest", "active");
    const auto row = [&](const std::string& what, const Spread& s) {
        out += fmt::format("{:<{}}  {:>10}  {:>10}  {:>10}  {:>5.1f} %\n", what, widest + 2,
                           readable(s.mean()), readable(s.count ? s.least : 0),
                           readable(s.count ? s.most : 0), 100 * s.active_share());
    };
    for (std::size_t g = 0; g < layout.groups.size(); ++g) {
        const auto& seen = statistics.groups()[g];
        row(layout.groups[g].path, seen.states[static_cast<std::size_t>(layout.groups[g].type.output())]);
        const auto& type = layout.groups[g].type;
        for (std::size_t k = 0; k < type.input_count(); ++k)
            if (!seen.inputs[k].silent())
                row("  " + (k < input_kinds ? kind_names[k] : type.inputs[k - input_kinds]), seen.inputs[k]);
    }
    return out;
}

std::vector<std::string> explanation(const PreparedRun& prepared) {
    const Run& run = prepared.run;
    auto out = prepared.motor_report();
    for (auto& undriven : undriven_robots(run)) out.push_back(std::move(undriven.text));
    std::set<int> manipulated;
    for (const auto& o : run.observers())
        if (const auto* m = dynamic_cast<const observe::Manipulation*>(o.get()))
            manipulated.insert(m->settings().group);
    for (auto& note : wiring_notes(run.system(), run.layout(), manipulated)) out.push_back(std::move(note));
    for (auto& note : Explainer(run.system(), run.layout(), *prepared.statistics, manipulated).notes())
        out.push_back(std::move(note));
    return out;
}

}  // namespace forage
