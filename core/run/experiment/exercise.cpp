#include "core/run/experiment/exercise.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/sequence.h"
#include "core/connectivity/connect.h"
#include "core/model/lookup.h"
#include "core/observe/source.h"

namespace forage {
namespace {

/// A number that an exercise requires.
struct Number {
    std::optional<double> value;  ///< empty when there is none
    /// A share is `count` of `all` trials.
    std::uint64_t count = 0, all = 0;
};

/// Whether the number is a share of trials.
bool is_share(const model::Requirement& r) {
    using Measure = model::Measure;
    return r.measure &&
           (r.measure->kind == Measure::Kind::success || r.measure->kind == Measure::Kind::trials);
}

/// The mean over all runs of the measure with this index, which `r` requires.
Number measured(const model::Requirement& r, std::size_t measure, std::span<const RunResult> results) {
    Number out;
    double sum = 0, runs = 0, count = 0;
    for (const auto& result : results) {
        if (measure >= result.measures.size() || !result.measures[measure]) continue;
        const std::uint64_t finished = result.trials.value_or(0);
        const std::uint64_t trials = std::min(finished, r.measure->last.value_or(finished));
        sum += *result.measures[measure], ++runs;
        count += *result.measures[measure] * static_cast<double>(trials);
        out.all += trials;
    }
    if (runs == 0) return out;
    out.count = static_cast<std::uint64_t>(std::lround(count));
    out.value = is_share(r) ? count / static_cast<double>(out.all) : sum / runs;
    return out;
}

/// The number of synapses of a kind, or of any when it is empty, between the cells that a requirement names.
std::optional<double> synapses(const model::Requirement& r, std::string_view kind,
                               const model::System& system, const engine::Layout& layout,
                               Diagnostics& diagnostics) {
    const auto find = [&](const model::Expression& e) {
        return observe::find_source(layout, e.text, "require", diagnostics, e.at);
    };
    const auto to = find(r.to);
    const auto from = r.from.empty() ? std::nullopt : find(r.from);
    if (!to || (!from && !r.from.empty())) return std::nullopt;
    const auto holds = [](const observe::Source& s, int cell) {
        const auto& cells = s.part.numbers;
        return contains(cells, static_cast<std::size_t>(cell));
    };
    const model::GroupIndex groups(system);
    double count = 0;
    for (const auto& c : system.connections) {
        if (!kind.empty() && name_of(c.kind) != kind) continue;
        if (c.target != to->what().group_id || (from && c.source != from->what().group_id)) continue;
        Diagnostics known;  // those of a connection that cannot be built stop the run
        const auto made = connectivity::connect(c, groups.find(c.source).group->topology,
                                                groups.find(c.target).group->topology, 1, known);
        for (std::size_t i = 0; i < made.size(); ++i)
            if (holds(*to, made.post[i]) && (!from || holds(*from, made.pre[i]))) ++count;
    }
    return count;
}

std::string with_numbers(std::string text, const Number& n) {
    const auto put = [&](std::string_view name, const std::string& number) {
        for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + number.size()))
            text.replace(at, name.size(), number);
    };
    put("{n}", fmt::format("{}", n.count));
    put("{all}", fmt::format("{}", n.all));
    put("{value}", n.value ? plain_number(*n.value, 3) : "no number");
    return text;
}

/// The text in one line.
std::string joined(std::string_view text) {
    std::string out;
    for (const char c : model::trim(text))
        if (!std::isspace(static_cast<unsigned char>(c)))
            out += c;
        else if (!out.ends_with(' '))
            out += ' ';
    return out;
}

/// What may be wrong when no trial ended.
std::string no_trial(const model::Experiment& e, std::span<const RunResult> results) {
    const auto diverged = std::ranges::count_if(results, [](const auto& r) { return !r.diverged.empty(); });
    if (diverged > 0)
        return fmt::format(
            "No trial ended, and in {} of {} runs a number grew beyond all bounds. Is the learning rate, or "
            "a weight, too large?",
            diverged, results.size());
    std::error_code none;
    const auto world = std::filesystem::path(e.world).lexically_normal();
    const auto near = world.lexically_proximate(std::filesystem::current_path(none));
    return fmt::format(
        "No trial ended: the robot stands still, or never leaves the arena. `forage explain {} --world {} "
        "--seconds 20` says why.",
        e.systems.front().text, (near.string().starts_with("..") ? world : near).string());
}

/// Warns of what differs from the system to start from, and probably should not.
void warn_of_changes(const model::System& start, const model::System& own, Diagnostics& diagnostics) {
    const auto size = [](const model::Group& g) {
        const GroupShape shape = model::shape(g.topology);
        return fmt::format("{} x {} cells", shape.width, shape.height);
    };
    for (const auto& p : own.processes)
        for (const auto& q : start.processes) {
            if (model::trim(p.name) != model::trim(q.name)) continue;
            if (p.module && q.module && !p.module_enabled && q.module_enabled)
                diagnostics.warning(
                    p.at, fmt::format("the module of process '{}' is disabled", model::trim(p.name)),
                    "in the system to start from it is enabled");
            for (const auto& g : p.groups)
                for (const auto& h : q.groups)
                    if (model::trim(g.name) == model::trim(h.name) && size(g) != size(h))
                        diagnostics.warning(g.at,
                                            fmt::format("group '{}/{}' has {}", model::trim(p.name),
                                                        model::trim(g.name), size(g)),
                                            fmt::format("in the system to start from it has {}", size(h)));
        }
}

}  // namespace

model::Experiment with_system(model::Experiment e, const std::string& system) {
    if (e.systems.empty()) e.systems.emplace_back();
    e.systems.front() = {system};
    e.sweeps.clear(), e.adaptation.reset();
    if (e.exercise)
        for (const auto& r : e.exercise->requirements)
            if (r.measure) e.measures.push_back(*r.measure);
    return e;
}

void check_own(const model::Experiment& e, const model::System& start, const model::System& own,
               Diagnostics& diagnostics) {
    warn_of_changes(start, own, diagnostics);
    std::string texts;  // everything that may name a group or a connection
    const auto add = [&](const model::Expression& x) { texts += x.text + '\n'; };
    for (const auto& x : e.settings) add(x);
    for (const auto& x : e.changes) add(x.when), add(x.change);
    for (const auto& x : e.manipulations) add(x.group);
    for (const auto& x : e.recordings) add(x.column);
    for (const auto& x : e.plots) add(x);
    for (const auto& x : e.measures) add(x.what);
    for (const auto& r : e.exercise->requirements) add(r.from), add(r.to);
    // Whether the texts hold a name, not only as the beginning of a longer one.
    const auto named = [&](const std::string& name, const std::vector<std::string>& all) {
        for (auto at = texts.find(name); at != std::string::npos; at = texts.find(name, at + 1))
            if (std::ranges::none_of(all, [&](const std::string& longer) {
                    return longer.size() > name.size() && texts.compare(at, longer.size(), longer) == 0;
                }))
                return true;
        return false;
    };
    const auto check = [&](const char* kind, const std::vector<std::string>& wanted,
                           const std::vector<std::string>& there) {
        for (const auto& name : wanted)
            if (named(name, wanted) && !contains(there, name))
                diagnostics.error({}, fmt::format("the system has no {} '{}'", kind, name),
                                  "the exercise uses it: keep the names of the system to start from");
    };
    const auto connections = [](const model::System& s) {
        return collected(s.connections, [](const auto& c) { return std::string(model::trim(c.name)); });
    };
    check("group", model::group_paths(start), model::group_paths(own));
    check("connection", connections(start), connections(own));
}

std::vector<Finding> findings(const model::Experiment& experiment, std::span<const RunResult> results,
                              const model::System& system, const engine::Layout& layout,
                              Diagnostics& diagnostics) {
    std::vector<Finding> out;
    if (!experiment.exercise) return out;
    const auto& all = experiment.exercise->requirements;
    std::size_t measure =
        experiment.measures.size() - static_cast<std::size_t>(std::ranges::count_if(
                                         all, [](const auto& r) { return r.measure.has_value(); }));
    bool moved = true;  // until a requirement has said otherwise
    for (const auto& r : all) {
        const Number n = r.measure ? measured(r, measure++, results)
                                   : Number{synapses(r, r.kind, system, layout, diagnostics)};
        const bool met =
            n.value && (!r.at_least || *n.value >= *r.at_least) && (!r.at_most || *n.value <= *r.at_most);
        std::string advice = with_numbers(joined(r.advice), n);
        if (is_share(r) && n.all == 0)
            advice = std::exchange(moved, false) ? no_trial(experiment, results) : "";
        if (!met && n.value && !r.from.empty() && !r.kind.empty() && r.at_least)
            for (const std::string_view kind : input_kind_names)
                if (kind != r.kind && synapses(r, kind, system, layout, diagnostics).value_or(0) > 0)
                    advice =
                        fmt::format("It is connected, but {}: the `type` of the connection should be \"{}\".",
                                    kind, r.kind);
        out.push_back({r.what, met, met ? "" : std::move(advice)});
    }
    return out;
}

}  // namespace forage
