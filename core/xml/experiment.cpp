#include "core/xml/experiment.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/base/number.h"
#include "core/model/lookup.h"
#include "core/types/parameter.h"
#include "core/xml/check.h"
#include "core/xml/format.h"

namespace forage::xml {
namespace {

using tinyxml2::XMLElement;

/// Builds the model from a document that has passed check().
class ExperimentReader {
  public:
    ExperimentReader(const Document& document, Diagnostics& out) : document_(document), out_(out) {}

    model::Experiment run() {
        const XMLElement& root = document_.root();
        experiment_.path = document_.source()->path;
        each(root, "note", [&](const XMLElement& e) {
            if (const char* note = e.GetText()) experiment_.note = note;
        });
        each(root, "system", [&](const XMLElement& e) {
            experiment_.system = file(e, "file"), experiment_.system_at = at(e, "file");
        });
        each(root, "world", [&](const XMLElement& e) {
            experiment_.world = file(e, "file"), experiment_.world_at = at(e, "file");
            experiment_.real_time_factor = number(e, "pace");
            experiment_.noise = text(e, "noise") != "false";
        });
        each(root, "length", [&](const XMLElement& e) { length(e); });
        each(root, "seeds", [&](const XMLElement& e) { seeds(e); });
        each(root, "set", [&](const XMLElement& e) { experiment_.settings.push_back(assignment(e)); });
        each(root, "at", [&](const XMLElement& e) {
            experiment_.changes.push_back({wish(e, "when"), assignment(e)});
        });
        for (const auto* e = root.FirstChildElement(); e; e = e->NextSiblingElement()) manipulation(*e);
        each(root, "record", [&](const XMLElement& e) {
            experiment_.recordings.push_back({wish(e, "column"), whole(e, "every").value_or(1)});
        });
        each(root, "plot", [&](const XMLElement& e) { experiment_.plots.push_back(wish(e, "what")); });
        each(root, "measure", [&](const XMLElement& e) { measure(e); });
        each(root, "sweep", [&](const XMLElement& e) { sweep(e); });
        if (count_runs() > most_runs)
            out_.error(document_.at(root),
                       fmt::format("these sweeps and seeds make more than {} runs", most_runs),
                       "every value is combined with every value of the other sweeps, and with every seed");
        return std::move(experiment_);
    }

  private:
    static std::string text(const XMLElement& e, const char* name) {
        const char* value = e.Attribute(name);
        return value ? value : "";
    }
    static std::optional<double> number(const XMLElement& e, const char* name) {
        return parse_number<double>(text(e, name));
    }
    /// Empty also where the check has refused the value.
    static std::optional<std::uint64_t> whole(const XMLElement& e, const char* name) {
        const auto v = number(e, name);
        if (!v || !(*v >= 0 && *v <= 2e9)) return std::nullopt;
        return static_cast<std::uint64_t>(*v);
    }
    template <class F>
    static void each(const XMLElement& e, const char* name, F visit) {
        for (const auto* c = e.FirstChildElement(name); c; c = c->NextSiblingElement(name)) visit(*c);
    }
    Location at(const XMLElement& e, const char* name) const {
        const auto* a = e.FindAttribute(name);
        return a ? document_.value_of(*a) : document_.at(e);
    }
    model::Expression wish(const XMLElement& e, const char* name) const { return {text(e, name), at(e, name)}; }

    /// A path as seen from the working directory.
    std::string file(const XMLElement& e, const char* name) const {
        return (std::filesystem::path(experiment_.path).parent_path() / text(e, name)).string();
    }
    model::Expression assignment(const XMLElement& e) const {
        return {text(e, "parameter") + "=" + text(e, "value"), at(e, "parameter")};
    }

    /// Whether an element has an attribute that the check has refused: it may have meant any other.
    static bool misspelt(const XMLElement& e) {
        const ElementRule* rule = find_element(e.Name(), experiment_format());
        for (const auto* a = e.FirstAttribute(); a; a = a->Next())
            if (!rule->attribute(a->Name())) return true;
        return false;
    }

    /// The one of these attributes that an element has; reports none or several.
    const char* one_of(const XMLElement& e, std::span<const char* const> names) {
        const char* found = nullptr;
        for (const char* name : names)
            if (e.FindAttribute(name)) {
                if (found)
                    out_.error(at(e, name), fmt::format("<{}> has both '{}' and '{}'", e.Name(), found, name),
                               "keep one of them");
                found = name;
            }
        if (!found && !misspelt(e))
            out_.error(document_.at(e), fmt::format("<{}> does not say what it is", e.Name()),
                       fmt::format("give it one of '{}'", fmt::join(names, "', '")));
        return found;
    }

    void length(const XMLElement& e) {
        static constexpr std::array names = {"cycles", "seconds", "trials"};
        const char* kind = one_of(e, names);
        experiment_.length_at = kind ? at(e, kind) : document_.at(e);
        experiment_.cycles = whole(e, "cycles");
        experiment_.trials = whole(e, "trials");
        experiment_.seconds = number(e, "seconds");
        experiment_.trial_timeout = number(e, "longest-trial").value_or(experiment_.trial_timeout);
        if (e.FindAttribute("until")) experiment_.until = wish(e, "until");
    }

    void seeds(const XMLElement& e) {
        const bool listed = e.FindAttribute("list");
        if (listed && (e.FindAttribute("first") || e.FindAttribute("count")))
            out_.error(at(e, "list"), "<seeds> has both a list and a count", "keep one of them");
        experiment_.seeds.clear();
        const std::uint64_t count = whole(e, "count").value_or(1);
        if (!listed)
            for (std::uint64_t i = 0; i < std::min(count, most_runs + 1); ++i)
                experiment_.seeds.push_back(whole(e, "first").value_or(1) + i);
        const auto list = words(wish(e, "list"));
        if (listed && list.empty())
            out_.error(at(e, "list"), "there are no seeds in the list", "for example list=\"1 2 3\"");
        for (const auto& word : list) {
            const auto seed = parse_number<int>(word.text);
            if (!seed || *seed < 0)
                out_.error(word.at, fmt::format("'{}' is not a seed", word.text),
                           "a seed is a whole number, at least 0");
            else
                experiment_.seeds.push_back(static_cast<std::uint64_t>(*seed));
        }
    }

    /// <clamp>, <add> and <multiply>.
    void manipulation(const XMLElement& e) {
        static constexpr std::array modes = {"clamp", "add", "multiply"};
        static constexpr std::array sources = {"cells", "patterns"};
        const auto mode = std::find(modes.begin(), modes.end(), std::string_view(e.Name())) - modes.begin();
        if (mode == std::ssize(modes) || !one_of(e, sources)) return;
        model::ManipulationSpec m;
        m.mode = static_cast<model::ManipulationSpec::Mode>(mode);
        m.group = wish(e, "group");
        if (e.FindAttribute("cells")) m.cells = wish(e, "cells");
        if (e.FindAttribute("patterns")) m.patterns = {file(e, "patterns"), at(e, "patterns")};
        m.every = whole(e, "every").value_or(1), m.step = whole(e, "step").value_or(1);
        m.times = whole(e, "times");
        m.backwards = text(e, "backwards") == "true";
        if (e.FindAttribute("from")) m.from = wish(e, "from");
        if (e.FindAttribute("until")) m.until = wish(e, "until");
        experiment_.manipulations.push_back(std::move(m));
    }

    void measure(const XMLElement& e) {
        static constexpr std::array names = {"success", "duration", "first", "final"};
        const char* kind = one_of(e, names);
        if (!kind) return;
        model::Measure m;
        m.name = text(e, "name"), m.at = at(e, "name"), m.what = wish(e, kind);
        if (m.name.empty() && e.FindAttribute("name"))
            out_.error(m.at, "a measure needs a name", "names are columns of the table of results");
        m.kind = static_cast<model::Measure::Kind>(
            std::find(names.begin(), names.end(), std::string_view(kind)) - names.begin());
        for (const auto& other : experiment_.measures)
            if (other.name == m.name && !m.name.empty())
                out_.error(m.at,
                           fmt::format("there is a measure '{}' already, on line {}", m.name, other.at.line),
                           "names are columns of the table of results");
        if (m.kind == model::Measure::Kind::success || m.kind == model::Measure::Kind::duration) {
            const auto said = words(m.what);
            const auto n =
                said.size() == 2 && said[0].text == "last" ? parse_number<int>(said[1].text) : std::nullopt;
            if (n && *n > 0)
                m.last = static_cast<std::uint64_t>(*n);
            else if (m.what.text != "all")
                out_.error(m.what.at, fmt::format("{} = '{}' names no trials", kind, m.what.text),
                           "'all', or for example 'last 100'");
        }
        experiment_.measures.push_back(std::move(m));
    }

    void sweep(const XMLElement& e) {
        model::Sweep s{wish(e, "parameter"), words(wish(e, "values"))};
        if (s.values.empty())
            out_.error(at(e, "values"), "there are no values to sweep", "for example values=\"0.1 0.01\"");
        std::set<std::string> seen;
        for (const auto& v : s.values)
            if (!seen.insert(v.text).second)
                out_.error(v.at, fmt::format("the value {} is given twice", v.text), "remove one of them");
        for (const auto& other : experiment_.sweeps)
            if (other.parameter.text == s.parameter.text && !s.parameter.empty())
                out_.error(s.parameter.at,
                           fmt::format("'{}' is swept already, on line {}", s.parameter.text,
                                       other.parameter.at.line),
                           "put all values into one sweep");
        experiment_.sweeps.push_back(std::move(s));
    }

    /// The parts of a list, each with its place.
    static std::vector<model::Expression> words(const model::Expression& list) {
        std::vector<model::Expression> out;
        constexpr std::string_view blanks = " \t\r\n";
        for (std::size_t from = list.text.find_first_not_of(blanks); from != std::string::npos;) {
            const auto to = std::min(list.text.find_first_of(blanks, from), list.text.size());
            Location at = list.at;
            at.column += static_cast<int>(from);
            out.push_back({list.text.substr(from, to - from), at});
            from = list.text.find_first_not_of(blanks, to);
        }
        return out;
    }

    /// Of what is too many, no more than that it is.
    std::uint64_t count_runs() const {
        std::uint64_t out = experiment_.seeds.size();
        for (const auto& s : experiment_.sweeps) out = std::min(out * s.values.size(), most_runs + 1);
        return out;
    }

    static constexpr std::uint64_t most_runs = 100'000;

    const Document& document_;
    Diagnostics& out_;
    model::Experiment experiment_;
};

}  // namespace

namespace {
std::optional<model::Experiment> build(const std::optional<Document>& document, Diagnostics& diagnostics) {
    const int errors_before = diagnostics.errors();
    if (!document) return std::nullopt;
    check(*document, "experiment", diagnostics);
    if (document->root().Name() != std::string_view("experiment")) return std::nullopt;
    auto out = ExperimentReader(*document, diagnostics).run();
    if (diagnostics.errors() > errors_before) return std::nullopt;
    return out;
}
}  // namespace

std::optional<model::Experiment> read_experiment(const std::string& path, Diagnostics& diagnostics) {
    return build(Document::read(path, "<experiment>", diagnostics), diagnostics);
}

std::optional<model::Experiment> parse_experiment(std::string path, std::string text,
                                                  Diagnostics& diagnostics) {
    return build(Document::parse(std::move(path), std::move(text), "<experiment>", diagnostics), diagnostics);
}

}  // namespace forage::xml
