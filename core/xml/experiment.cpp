#include "core/xml/experiment.h"

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/xml/check.h"
#include "core/xml/experiment_elements.h"

namespace forage::xml {
namespace {

/// Gives `s` the values of the attributes of `e` that are its members.
template <class Struct>
void read_attributes(const Element& e, Struct& s) {
    for (const auto& row : experiment_elements())
        if (row.type == typeid(Struct) && row.rule.name == e.name()) row.read(e, s);
}

/// Builds the model from a document in spite of errors that check() has found, to report further mistakes.
class ExperimentReader {
  public:
    ExperimentReader(const Document& document, Diagnostics& out) : document_(document), out_(out) {}

    model::Experiment run() {
        const Element root = document_.root();
        experiment_.path = document_.source->path;
        if (const Element e = root.child("note")) experiment_.note = e.text();
        for (const Element& e : root.children()) {
            read_attributes(e, experiment_);
            if (e.name() == "system") read_attributes(e, experiment_.systems.emplace_back());
        }
        if (const Element e = root.child("length"))
            experiment_.length_at = e[one_of(e, alternatives(e))].where();
        if (const Element e = root.child("seeds")) seeds(e);
        for (const Element& e : root.children()) {
            if (e.name() == "set") experiment_.settings.push_back(assignment(e));
            if (e.name() == "bind")
                experiment_.robots.push_back({e["robot"].text() + "=" + e["to"].text(), e["robot"].where()});
            if (e.name() == "at") experiment_.changes.push_back({written(e["when"]), assignment(e)});
            if (e.name() == "record") read_attributes(e, experiment_.recordings.emplace_back());
            if (e.name() == "plot") read_attributes(e, experiment_.plots.emplace_back());
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
        if (const Element e = root.child("confidence")) adaptation(e, model::Adaptation::Kind::confidence);
        if (const Element e = root.child("halving")) adaptation(e, model::Adaptation::Kind::halving);
        model::check_adaptation(experiment_, out_);
        if (const Element e = root.child("exercise")) exercise(e);
        if (count_runs() > max_runs)
            out_.error(root.where(), fmt::format("these sweeps and seeds make more than {} runs", max_runs),
                       "every value is combined with every value of the other sweeps, and with every seed");
        return std::move(experiment_);
    }

  private:
    static model::Expression written(const Value& v) { return {v.text(), v.where()}; }

    static model::Expression assignment(const Element& e) {
        return {e["parameter"].text() + "=" + e["value"].text(), e["parameter"].where(), e["value"].where()};
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

    static std::vector<std::string> alternatives(const Element& e) {
        std::vector<std::string> out;
        for (const AttributeRule& a : experiment_format().find(e.name())->attributes)
            if (a.alternative) out.push_back(a.name);
        return out;
    }
    /// The one of these attributes that an element has; empty when it has none. Reports an error when it has
    /// none or several.
    std::string one_of(const Element& e, const std::vector<std::string>& names) {
        std::string found;
        for (const auto& name : names)
            if (e[name]) {
                if (!found.empty())
                    out_.error(e[name].where(),
                               fmt::format("<{}> has both '{}' and '{}'", e.name(), found, name),
                               "keep one of them");
                found = name;
            }
        if (found.empty() && !misspelt(e))
            out_.error(e.where(), fmt::format("<{}> does not say what it is", e.name()),
                       fmt::format("give it one of '{}'", separated(names, "', '")));
        return found;
    }

    void seeds(const Element& e) {
        const bool listed(e["list"]);
        if (listed && (e["first"] || e["count"]))
            out_.error(e["list"].where(), "<seeds> has both a list and a count", "keep one of them");
        experiment_.seeds.clear();
        const std::uint64_t count = e["count"].count().value_or(1);
        if (!listed)
            for (std::uint64_t i = 0; i < std::min(count, max_runs + 1); ++i)
                experiment_.seeds.push_back(e["first"].count().value_or(1) + i);
        const auto list = expressions(e["list"]);
        if (listed && list.empty())
            out_.error(e["list"].where(), "there are no seeds in the list", "for example list=\"1 2 3\"");
        std::set<int> seen;
        bool reported = false;
        for (const auto& entry : list) {
            const std::string& word = entry.text;
            const Location& where = entry.at;
            const auto seed = parse_number<int>(word);
            if (!seed || *seed < 0)
                out_.error(where, fmt::format("'{}' is not a seed", word),
                           "a seed is a whole number, at least 0");
            else {
                if (!seen.insert(*seed).second && !std::exchange(reported, true))
                    out_.error(where, fmt::format("the seed {} is given twice", word),
                               "remove one of them: its runs are equal");
                experiment_.seeds.push_back(static_cast<std::uint64_t>(*seed));
            }
        }
    }

    /// Reads <clamp>, <add> or <multiply>.
    void manipulation(const Element& e) {
        using Spec = model::ManipulationSpec;
        const auto mode = std::ranges::find(Spec::modes, e.name()) - Spec::modes.begin();
        if (mode == std::ssize(Spec::modes) || one_of(e, alternatives(e)).empty()) return;
        auto& m = experiment_.manipulations.emplace_back();
        m.mode = static_cast<Spec::Mode>(mode);
        read_attributes(e, m);
    }

    void measure(const Element& e) {
        const auto kind = one_of(e, alternatives(e));
        if (kind.empty()) return;
        model::Measure m;
        read_attributes(e, m);
        if (m.name.empty() && e["name"])
            out_.error(m.at, "a measure needs a name", "names are columns of the table of results");
        read_measure(e, kind, experiment_.measures, m);
        experiment_.measures.push_back(std::move(m));
    }

    /// Reads the attribute `kind` of a measure whose name differs from those of the `others`.
    void read_measure(const Element& e, const std::string& kind, std::span<const model::Measure> others,
                      model::Measure& m) {
        m.what = written(e[kind]), m.of = written(e["of"]);
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
    }

    void exercise(const Element& e) {
        auto& exercise = experiment_.exercise.emplace();
        read_attributes(e, exercise);
        std::vector<model::Measure> measures = experiment_.measures;
        for (const Element& child : e.children("require")) {
            auto kinds = alternatives(child);
            kinds.emplace_back("to");  // the number of synapses
            const auto kind = one_of(child, kinds);
            if (kind.empty()) continue;
            model::Requirement r;
            read_attributes(child, r);
            r.advice = child.text();
            if (kind == kinds.back()) {
                if (!r.at_least && !r.at_most) r.at_least = 1;
            } else {
                auto& m = measures.emplace_back();
                m.name = r.what, m.at = child["what"].where();
                read_measure(child, kind, std::span(measures).first(measures.size() - 1), m);
                r.measure = m, r.from = {};  // which only synapses have
            }
            if (!r.at_least && !r.at_most)
                out_.error(child.where(), "<require> gives no bound", "give it 'at-least' or 'at-most'");
            exercise.requirements.push_back(std::move(r));
        }
    }

    void adaptation(const Element& e, model::Adaptation::Kind kind) {
        if (experiment_.adaptation)
            out_.error(e.where(), "<halving> and <confidence> exclude each other", "remove one of them");
        model::Adaptation a;
        a.kind = kind, a.at = e.where();
        read_attributes(e, a);
        // A width that is wrong has been reported.
        if ((e["width"] && !a.width) || (e["relative-width"] && !a.relative_width)) return;
        experiment_.adaptation = std::move(a);
    }

    /// Reads a sweep of the current axis.
    void sweep(const Element& e) {
        const auto kind = one_of(e, alternatives(e));
        if (kind.empty()) return;
        const auto list = e["systems"] ? one_of(e, {"values", "systems"}) : "values";
        model::Sweep s{written(e[kind]), expressions(e[list]), {}, axes_};
        if (e["systems"]) {
            s.parameter.text = "system";
            for (const Value& word : e[list].words())
                s.files.push_back(model::resolved(word.text(), word.where()));
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
        return collected(list.words(), written);
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

const Format& experiment_format() {
    static const Format table = [] {
        return Format{.name = "an experiment file",
                      .beginning = "<experiment>",
                      .roots = {"experiment"},
                      .where_texts_stand = "write a text in the <note>, and a remark in <!-- -->",
                      .values = {{"text", {}}},
                      .elements = rules_of(experiment_elements())}
            .link();
    }();
    return table;
}

std::optional<model::Experiment> read_experiment(const std::string& path, Diagnostics& diagnostics) {
    return build(open(path, experiment_format(), diagnostics).get(), diagnostics);
}

std::optional<model::Experiment> parse_experiment(std::string path, std::string text,
                                                  Diagnostics& diagnostics) {
    return build(open(path, std::move(text), experiment_format(), diagnostics).get(), diagnostics);
}

}  // namespace forage::xml
