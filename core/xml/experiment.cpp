#include "core/xml/experiment.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/xml/check.h"

namespace forage::xml {
namespace {

/// Builds the model from a document in spite of errors that check() has found, to report further mistakes.
class ExperimentReader {
  public:
    ExperimentReader(const Document& document, Diagnostics& out) : document_(document), out_(out) {}

    model::Experiment run() {
        const Element root = document_.root();
        experiment_.path = document_.source->path;
        if (const Element e = root.child("note")) experiment_.note = e.text();
        for (const Element& e : root.children("system"))
            experiment_.systems.push_back({file(e["file"]), e["file"].where()});
        if (const Element e = root.child("world")) world(e);
        if (const Element e = root.child("length")) length(e);
        if (const Element e = root.child("seeds")) seeds(e);
        for (const Element& e : root.children()) {
            if (e.name() == "set") experiment_.settings.push_back(assignment(e));
            if (e.name() == "bind")
                experiment_.robots.push_back({e["robot"].text() + "=" + e["to"].text(), e["robot"].where()});
            if (e.name() == "at") experiment_.changes.push_back({written(e["when"]), assignment(e)});
            if (e.name() == "record")
                experiment_.recordings.push_back({written(e["column"]), whole(e["every"]).value_or(1)});
            if (e.name() == "plot") experiment_.plots.push_back(written(e["what"]));
            manipulation(e);
        }
        for (const Element& e : root.children("measure")) measure(e);
        for (const Element& e : root.children()) {
            if (e.name() == "sweep") sweep(e), ++axes_;
            if (e.name() == "together") together(e);
        }
        if (experiment_.systems.empty() && !sweeps_systems() && !has_unknown(root))
            out_.error(root.where(), "<experiment> has no <system>",
                       "name one in <system file=\"...\"/>, or several in <sweep systems=\"...\"/>");
        if (const Element e = root.child("confidence")) confidence(e);
        if (const Element e = root.child("halving")) halving(e);
        model::check_adaptation(experiment_, out_);
        if (const Element e = root.child("exercise")) exercise(e);
        if (count_runs() > max_runs)
            out_.error(root.where(), fmt::format("these sweeps and seeds make more than {} runs", max_runs),
                       "every value is combined with every value of the other sweeps, and with every seed");
        return std::move(experiment_);
    }

  private:
    /// The value as a whole number; empty when there is none or when check() has refused it.
    static std::optional<std::uint64_t> whole(const Value& v) {
        const auto n = v.number();
        if (!n || !(*n >= 0 && *n <= 2e9)) return std::nullopt;
        return static_cast<std::uint64_t>(*n);
    }
    static model::Expression written(const Value& v) { return {v.text(), v.where()}; }

    /// A path relative to the working directory.
    std::string file(const Value& v) const {
        return (std::filesystem::path(experiment_.path).parent_path() / v.view).string();
    }
    static model::Expression assignment(const Element& e) {
        return {e["parameter"].text() + "=" + e["value"].text(), e["parameter"].where()};
    }

    /// Whether an element has an attribute that check() has refused, which may be any other one with a
    /// misspelt name.
    static bool misspelt(const Element& e) {
        const ElementRule* rule = experiment_format().find(e.name());
        const auto all = e.attributes();
        return std::ranges::any_of(all, [&](const Attribute& a) { return !rule->attribute(a.name); });
    }

    /// Whether an element holds one that check() has refused, which may be any other one with a misspelt
    /// name.
    static bool has_unknown(const Element& e) {
        const auto all = e.children();
        return std::ranges::any_of(
            all, [](const Element& child) { return !experiment_format().find(child.name()); });
    }

    /// The one of these attributes that an element has. Reports an error when it has none or several.
    const char* one_of(const Element& e, std::span<const char* const> names) {
        const char* found = nullptr;
        for (const char* name : names)
            if (e[name]) {
                if (found)
                    out_.error(e[name].where(),
                               fmt::format("<{}> has both '{}' and '{}'", e.name(), found, name),
                               "keep one of them");
                found = name;
            }
        if (!found && !misspelt(e))
            out_.error(e.where(), fmt::format("<{}> does not say what it is", e.name()),
                       fmt::format("give it one of '{}'", separated(names, "', '")));
        return found;
    }

    void world(const Element& e) {
        experiment_.world = file(e["file"]), experiment_.world_at = e["file"].where();
        experiment_.real_time_factor = e["pace"].number();
        experiment_.noise = e["noise"].flag(true);
    }

    void length(const Element& e) {
        static constexpr std::array names = {"cycles", "seconds", "trials"};
        const char* kind = one_of(e, names);
        experiment_.length_at = kind ? e[kind].where() : e.where();
        experiment_.cycles = whole(e["cycles"]);
        experiment_.trials = whole(e["trials"]);
        experiment_.seconds = e["seconds"].number();
        experiment_.trial_timeout = e["longest-trial"].number().value_or(experiment_.trial_timeout);
        experiment_.until = written(e["until"]);
    }

    void seeds(const Element& e) {
        const bool listed(e["list"]);
        if (listed && (e["first"] || e["count"]))
            out_.error(e["list"].where(), "<seeds> has both a list and a count", "keep one of them");
        experiment_.seeds.clear();
        const std::uint64_t count = whole(e["count"]).value_or(1);
        if (!listed)
            for (std::uint64_t i = 0; i < std::min(count, max_runs + 1); ++i)
                experiment_.seeds.push_back(whole(e["first"]).value_or(1) + i);
        const auto list = expressions(e["list"]);
        if (listed && list.empty())
            out_.error(e["list"].where(), "there are no seeds in the list", "for example list=\"1 2 3\"");
        std::set<int> seen;
        bool told = false;
        for (const auto& [word, where] : list) {
            const auto seed = parse_number<int>(word);
            if (!seed || *seed < 0)
                out_.error(where, fmt::format("'{}' is not a seed", word),
                           "a seed is a whole number, at least 0");
            else {
                if (!seen.insert(*seed).second && !std::exchange(told, true))
                    out_.error(where, fmt::format("the seed {} is given twice", word),
                               "remove one of them: its runs are equal");
                experiment_.seeds.push_back(static_cast<std::uint64_t>(*seed));
            }
        }
    }

    /// Reads <clamp>, <add> or <multiply>.
    void manipulation(const Element& e) {
        static constexpr std::array modes = {"clamp", "add", "multiply"};
        static constexpr std::array sources = {"cells", "patterns"};
        const auto mode = std::ranges::find(modes, e.name()) - modes.begin();
        if (mode == std::ssize(modes) || !one_of(e, sources)) return;
        model::ManipulationSpec m;
        m.mode = static_cast<model::ManipulationSpec::Mode>(mode);
        m.group = written(e["group"]);
        m.cells = written(e["cells"]);
        if (e["patterns"]) m.patterns = {file(e["patterns"]), e["patterns"].where()};
        m.every = whole(e["every"]).value_or(1), m.step = whole(e["step"]).value_or(1);
        m.times = whole(e["times"]);
        m.backwards = e["backwards"].flag(false);
        m.from = written(e["from"]), m.until = written(e["until"]);
        experiment_.manipulations.push_back(std::move(m));
    }

    void measure(const Element& e) {
        const char* kind = one_of(e, model::measure_kinds);
        if (kind) experiment_.measures.push_back(measure_of(e, kind, "name", experiment_.measures));
    }

    /// The measure that the attribute `kind` describes. Its name differs from those of the `others`.
    model::Measure measure_of(const Element& e, std::string_view kind, const char* name,
                              std::span<const model::Measure> others) {
        model::Measure m;
        m.name = e[name].text(), m.at = e[name].where(), m.what = written(e[kind]), m.of = written(e["of"]);
        if (m.name.empty() && e[name])
            out_.error(m.at, "a measure needs a name", "names are columns of the table of results");
        m.kind = static_cast<model::Measure::Kind>(std::ranges::find(model::measure_kinds, kind) -
                                                   model::measure_kinds.begin());
        if (e["of"] && m.kind != model::Measure::Kind::robot)
            out_.error(m.of.at, fmt::format("'{}' is not a measure of a robot", kind),
                       "leave out 'of', which names a robot");
        for (const auto& other : others)
            if (other.name == m.name && !m.name.empty())
                out_.error(m.at,
                           fmt::format("there is a measure '{}' already, on line {}", m.name, other.at.line),
                           "names are columns of the table of results");
        model::read_trials(m, out_);
        return m;
    }

    /// The attributes of requirements: measures, and `to` for synapses.
    static constexpr auto required = [] {
        std::array<const char*, model::measure_kinds.size() + 1> out{};
        std::ranges::copy(model::measure_kinds, out.begin());
        out.back() = "to";
        return out;
    }();

    void exercise(const Element& e) {
        model::Exercise exercise{file(e["start"]), e["start"].where(), {}};
        std::vector<model::Measure> measures = experiment_.measures;
        for (const Element& child : e.children("require")) {
            const char* kind = one_of(child, required);
            if (!kind) continue;
            model::Requirement r;
            r.what = child["what"].text(), r.advice = child.text(), r.kind = child["kind"].text();
            r.at_least = child["at-least"].number(), r.at_most = child["at-most"].number();
            if (kind == required.back()) {
                r.to = written(child["to"]), r.from = written(child["from"]);
                if (!r.at_least && !r.at_most) r.at_least = 1;
            } else {
                r.measure = measure_of(child, kind, "what", measures);
                measures.push_back(*r.measure);
            }
            if (!r.at_least && !r.at_most)
                out_.error(child.where(), "<require> gives no bound", "give it 'at-least' or 'at-most'");
            exercise.requirements.push_back(std::move(r));
        }
        experiment_.exercise = std::move(exercise);
    }

    void confidence(const Element& e) {
        model::Adaptation a{.measure = written(e["measure"]), .at = e.where()};
        a.width = e["width"].number(), a.relative_width = e["relative-width"].number();
        // A width that is wrong has been reported.
        if ((e["width"] && !a.width) || (e["relative-width"] && !a.relative_width)) return;
        a.most = whole(e["most"]).value_or(a.most);
        experiment_.adaptation = std::move(a);
    }

    void halving(const Element& e) {
        if (experiment_.adaptation)
            out_.error(e.where(), "<halving> and <confidence> exclude each other", "remove one of them");
        experiment_.adaptation = {.kind = model::Adaptation::Kind::halving,
                                  .measure = written(e["measure"]),
                                  .highest = e["keep"].text() != "lowest",
                                  .at = e.where()};
    }

    /// Reads a sweep of the current axis.
    void sweep(const Element& e) {
        static constexpr std::array kinds = {"parameter", "systems"}, lists = {"values", "systems"};
        const char* kind = one_of(e, kinds);
        if (!kind) return;
        const char* list = e["systems"] ? one_of(e, lists) : "values";
        model::Sweep s{written(e[kind]), expressions(e[list]), {}, axes_};
        if (e["systems"]) {
            s.parameter.text = "system";
            for (const Value& word : e[list].words()) s.files.push_back(file(word));
        }
        if (s.values.empty() && !misspelt(e))
            out_.error(
                e[list].where(), fmt::format("there are no {} to sweep", list),
                e["systems"] ? "for example systems=\"a.iqr b.iqr\"" : "for example values=\"0.1 0.01\"");
        std::set<std::string> seen;
        for (const auto& v : s.values)
            if (!seen.insert(v.text).second && e.parent().name() != "together")
                out_.error(v.at, fmt::format("the value {} is given twice", v.text), "remove one of them");
        for (const auto& other : experiment_.sweeps)
            if (other.parameter.text == s.parameter.text && !s.parameter.empty())
                out_.error(s.parameter.at,
                           fmt::format("'{}' is swept already, on line {}", s.parameter.text,
                                       other.parameter.at.line),
                           "put all values into one sweep");
        experiment_.sweeps.push_back(std::move(s));
    }

    /// Reads sweeps that share an axis.
    void together(const Element& e) {
        const std::size_t first = experiment_.sweeps.size();
        for (const Element& child : e.children("sweep")) sweep(child);
        for (std::size_t i = first + 1; i < experiment_.sweeps.size(); ++i) {
            const auto &s = experiment_.sweeps[i], &other = experiment_.sweeps[first];
            if (s.values.size() != other.values.size())
                out_.error(s.parameter.at,
                           fmt::format("'{}' has {} values, but '{}' on line {} has {}", s.parameter.text,
                                       s.values.size(), other.parameter.text, other.parameter.at.line,
                                       other.values.size()),
                           "sweeps in <together> have one value each for every combination");
        }
        ++axes_;
    }
    bool sweeps_systems() const {
        return std::ranges::any_of(experiment_.sweeps, [](const auto& s) { return !s.files.empty(); });
    }

    /// The words of a list with blanks between them.
    static std::vector<model::Expression> expressions(const Value& list) {
        std::vector<model::Expression> out;
        for (const Value& word : list.words()) out.push_back(written(word));
        return out;
    }

    /// The number of runs, at most `max_runs` + 1.
    std::uint64_t count_runs() const {
        std::uint64_t out = experiment_.seeds.size();
        const auto& a = experiment_.adaptation;
        if (a && a->kind == model::Adaptation::Kind::confidence) out = std::max(out, a->most);
        for (std::size_t axis = 0; const auto& s : experiment_.sweeps)
            if (s.axis == axis) out = std::min(out * s.values.size(), max_runs + 1), ++axis;
        return out;
    }

    static constexpr std::uint64_t max_runs = 100'000;

    const Document& document_;
    Diagnostics& out_;
    model::Experiment experiment_;
    std::size_t axes_ = 0;  ///< number of complete axes of sweeps
};

std::optional<model::Experiment> build(const Document* document, Diagnostics& diagnostics) {
    if (!document) return std::nullopt;
    const int errors_before = diagnostics.errors();
    check(*document, experiment_format(), diagnostics);
    auto out = ExperimentReader(*document, diagnostics).run();
    if (diagnostics.errors() > errors_before) return std::nullopt;
    return out;
}

}  // namespace

std::optional<model::Experiment> read_experiment(const std::string& path, Diagnostics& diagnostics) {
    return build(open(path, experiment_format(), diagnostics).get(), diagnostics);
}

std::optional<model::Experiment> parse_experiment(std::string path, std::string text,
                                                  Diagnostics& diagnostics) {
    return build(open(path, std::move(text), experiment_format(), diagnostics).get(), diagnostics);
}

}  // namespace forage::xml
