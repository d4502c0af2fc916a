#include "core/xml/reader.h"

#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "core/base/sequence.h"
#include "core/model/constants.h"
#include "core/xml/canvas.h"
#include "core/xml/check.h"
#include "core/xml/link.h"
#include "core/xml/system_elements.h"

namespace forage::xml {
namespace {

/// The part of the diagram that a comment holds, if it stands where such a part may stand.
std::optional<CanvasPart> canvas_part(const Comment& comment) {
    auto part = read_canvas_part(comment.text);
    const auto in = comment.parent ? comment.parent.name() : std::string_view();
    const bool placed =
        part && (std::holds_alternative<model::CanvasComment>(*part) ? in == "System" || in == "Process"
                 : std::holds_alternative<model::Phantom>(*part)     ? in == "Process"
                                                                     : in == "DiagramLine");
    if (!placed) part.reset();
    return part;
}

/// Builds the model from a document in which check() has found no missing element.
class Reader {
  public:
    Reader(const Document& document, Diagnostics& out) : document_(document), out_(out) {
        const auto is_owner = [](Element e) {
            return e.name() == "Process" || e.name() == "Group" || e.name() == "Connection";
        };
        for (const Comment& c : document.comments()) {
            if (auto part = canvas_part(c)) {
                if (auto* comment = std::get_if<model::CanvasComment>(&*part))
                    comment->at = document.place(c.at);
                canvas_[c.parent].push_back(*std::move(part));
                continue;
            }
            if (begins_canvas_part(c.text))
                out.warning(document.place(c.at), "this is no part of the diagram that Forage can read",
                            canvas_forms());
            Element owner = c.before && is_owner(c.before) ? c.before : c.parent;
            while (owner && !is_owner(owner)) owner = owner.parent();
            comments_[owner ? owner : document.root()].emplace_back(c.text);
        }
    }

    model::System system() {
        const Element& e = document_.root();
        auto s = located<model::System>(e);
        s.constants = constants(e);
        s.neuron_types = declarations(e, "NeuronType");
        s.synapse_types = declarations(e, "SynapseType");
        s.note = note(e);
        s.comments = comments_of(e);
        s.canvas_comments = canvas_parts<model::CanvasComment>(e);
        s.instructions = document_.instructions();
        for (const Element& p : e.children("Process")) s.processes.push_back(process(p));
        for (const Element& c : e.children("Connection")) s.connections.push_back(connection(c));
        return s;
    }

    /// The content of a process file.
    model::System part() {
        const Element& e = document_.root();
        model::System s;
        s.at = e.where();
        s.neuron_types = declarations(e, "NeuronType");
        s.synapse_types = declarations(e, "SynapseType");
        for (const Element& p : e.children("Process")) s.processes.push_back(process(p));
        auto comments = comments_of(e);
        auto& first = s.processes.front().comments;
        first.insert(first.begin(), comments.begin(), comments.end());
        for (const Element& c : e.children("Connection")) s.connections.push_back(connection(c));
        return s;
    }

  private:
    /// A struct with the attributes of the element that describes it.
    template <class Struct>
    static Struct of(const Element& e) {
        Struct out;
        element_of<Struct>().read(e, out);
        return out;
    }
    /// The same, with the location of the element.
    template <class Struct>
    static Struct located(const Element& e) {
        auto out = of<Struct>(e);
        out.at = e.where();
        return out;
    }
    /// Makes `out` the alternative that the element describes.
    static void alternative(const Element& e, auto& out) {
        read_alternative(e.name(), out, [&](const auto& element, auto& s) { element.read(e, s); });
    }

    std::vector<std::string> comments_of(const Element& e) const {
        const auto it = comments_.find(e);
        return it == comments_.end() ? std::vector<std::string>() : it->second;
    }
    template <class Part>
    std::vector<Part> canvas_parts(const Element& e) const {
        std::vector<Part> out;
        if (const auto it = canvas_.find(e); it != canvas_.end())
            for (const auto& part : it->second)
                if (const auto* p = std::get_if<Part>(&part)) out.push_back(*p);
        return out;
    }
    static std::vector<model::Constant> constants(const Element& e) {
        return collected(e.children("Constant"), located<model::Constant>);
    }
    static std::vector<model::TypeDeclaration> declarations(const Element& e, std::string_view kind) {
        std::vector<model::TypeDeclaration> out;
        for (const Element& d : e.children(kind)) {
            auto& type = out.emplace_back(located<model::TypeDeclaration>(d));
            type.constants = constants(d);
            for (const Element& s : d.children("State"))
                type.states.push_back(located<model::DeclaredState>(s));
            for (const Value& text : d.child("Equations").texts())
                type.equations.push_back({text.text(), text.where()});
        }
        return out;
    }
    static std::optional<std::string> note(const Element& e) {
        const Element n = e.child("Note");
        return n ? std::optional(n.text()) : std::nullopt;
    }
    static std::optional<model::Icon> icon(const Element& e) {
        const Element i = e.child("DiagramIcon");
        if (!i) return std::nullopt;
        return of<model::Icon>(i);
    }

    model::Process process(const Element& e) {
        auto p = located<model::Process>(e);
        p.comments = comments_of(e);
        p.canvas_comments = canvas_parts<model::CanvasComment>(e);
        p.phantoms = canvas_parts<model::Phantom>(e);
        p.constants = constants(e);
        for (const Element& port : e.children("Port")) p.ports.push_back(located<model::Port>(port));
        if (const Element m = e.child("Module")) p.module = module(m);
        p.note = note(e);
        p.icon = icon(e);
        for (const Element& g : e.children("Group")) p.groups.push_back(group(g));
        return p;
    }

    template <class Use>
    static Use use(const Element& e) {
        auto u = of<Use>(e);
        u.note = note(e);
        for (const Element& p : e.children("Parameter")) u.settings.push_back(of<model::Setting>(p));
        for (const Element& i : e.children("Initial")) u.initial.push_back(located<model::Initial>(i));
        return u;
    }

    /// Reports holders in this element whose names are not in `meaningful`.
    void only_holders(const Element& e, const std::vector<std::string>& meaningful) {
        for (const Element& h : e.children("XRefHolder")) {
            const Value name = h["name"];
            if (!contains(meaningful, name.view))
                out_.unknown(name.where(),
                             fmt::format("a <{}> has no cross references '{}'", e.name(), name.view),
                             suggest(name.view, meaningful));
        }
    }

    std::vector<model::CrossReference> references(const Element& e, std::string_view holder) {
        std::vector<model::CrossReference> out;
        for (const Element& h : e.children("XRefHolder"))
            if (h["name"].view == holder)
                for (const Element& r : h.children("XRef")) out.push_back(located<model::CrossReference>(r));
        return out;
    }

    model::ModuleUse module(const Element& e) {
        auto m = use<model::ModuleUse>(e);
        only_holders(e, {"InputFromGroup", "OutputToGroup"});
        m.inputs = references(e, "InputFromGroup");
        m.outputs = references(e, "OutputToGroup");
        return m;
    }

    model::Group group(const Element& e) {
        auto g = located<model::Group>(e);
        if (const Element t = e.child("Topology")) {
            for (const auto& attribute : element_of<model::RectTopology>().attributes)
                if (const Value value = e[attribute.rule.name])
                    out_.error(value.where(),
                               fmt::format("a group has either <Topology> or {}", attribute.rule.name),
                               "remove one of them");
            g.topology = topology(t.children().front());
        } else {
            g.topology = of<model::RectTopology>(e);
            g.terse = true;
        }
        g.neuron = use<model::TypeUse>(e.child("Neuron"));
        g.note = note(e);
        g.icon = icon(e);
        g.comments = comments_of(e);
        return g;
    }

    model::Topology topology(const Element& e) {
        if (e.name() == "TopologySparse") return model::SparseTopology{points(e)};
        return of<model::RectTopology>(e);
    }

    std::vector<model::Point> points(const Element& e) {
        return collected(e.children("Point"), located<model::Point>);
    }

    model::Population population(const Element& e) {
        if (e.name() == "Region") return located<model::Region>(e);
        if (e.name() == "List") return model::List{points(e), e.where()};
        return model::All{};
    }

    template <class P>
    P populations(const Element& e, P pattern) {
        const auto inside = e.children();
        if (inside.empty()) return pattern;  // both are <All/>
        pattern.source = population(inside[0]);
        pattern.target = population(inside[1]);
        return pattern;
    }

    model::Pattern pattern(const Element& e) {
        if (e.name() == "PatternMapped") {
            auto mapped = of<model::MappedPattern>(e);
            mapped.is_stated = static_cast<bool>(e["type"]);
            return populations(e, std::move(mapped));
        }
        if (e.name() == "PatternForeach") return populations(e, model::ForeachPattern{});
        model::TuplesPattern tuples;
        for (const Element& t : e.children("Tuple"))
            tuples.tuples.push_back({points(t.child("SourceList")), points(t.child("TargetList"))});
        return tuples;
    }

    model::Arborization arborization(const Element& shape) {
        auto a = located<model::Arborization>(shape);
        alternative(shape, a.shape);
        return a;
    }

    model::DistanceFunction function(const Element& form) {
        model::DistanceFunction f;
        f.at = form.where();
        alternative(form, f.form);
        return f;
    }

    model::Connection connection(const Element& e) {
        auto c = located<model::Connection>(e);
        c.arborization.at = c.attenuation.at = c.delay.at = e.where();  // for defaults
        const auto read = [&](const char* name, auto& part, auto reader) {
            if (const Element form = e.child(name))
                part = (this->*reader)(form.children().front());
            else
                c.terse = true;
        };
        if (const Element w = e.child("Weights")) {
            if (const Element p = e.child("Pattern"))
                out_.error(p.where(), "a connection has either <Pattern> or <Weights>",
                           "remove <Pattern>: the weights say which cells have a synapse");
            auto weights = located<model::Weights>(w);
            weights.text = w.text(), weights.text_at = w.value().where();
            c.pattern = std::move(weights);
        } else {
            read("Pattern", c.pattern, &Reader::pattern);
        }
        read("Arborization", c.arborization, &Reader::arborization);
        read("AttenuationFunction", c.attenuation, &Reader::function);
        read("DelayFunction", c.delay, &Reader::function);
        const Value weight = e["weight"];
        const bool has_weights = std::holds_alternative<model::Weights>(c.pattern);
        if (weight && (e.child("Synapse") || has_weights))
            out_.error(
                weight.where(),
                fmt::format("a connection has either {} or weight", has_weights ? "<Weights>" : "<Synapse>"),
                "remove one of them");
        if (!e.child("Synapse") && !has_weights) {
            c.terse_synapse = true;
            c.synapse = model::fixed_weight();
            c.synapse->at = e.where();
            if (weight) c.synapse->settings = {{"weight", weight.text(), weight.where(), weight.where()}};
        }
        if (const Element s = e.child("Synapse")) {
            c.synapse = use<model::SynapseUse>(s);
            only_holders(s, {"Freedback"});
            c.synapse->feedback = references(s, "Freedback");
        }
        c.note = note(e);
        c.comments = comments_of(e);
        if (const Element l = e.child("DiagramLine")) {
            c.line = of<model::Line>(l);
            c.line->vertices = points(l);
            for (auto& v : canvas_parts<PageVertices>(l))
                (v.of_target ? c.line->target_vertices : c.line->source_vertices) = std::move(v.points);
        }
        return c;
    }

    const Document& document_;
    Diagnostics& out_;
    /// By the process, group or connection before which they stand. Other comments belong to the item that
    /// they stand in, or to the file's root.
    std::map<Element, std::vector<std::string>> comments_;
    std::map<Element, std::vector<CanvasPart>> canvas_;  ///< by the element in which they stand
};

/// The model that `read` makes from a document. Empty when the document has errors after which its meaning is
/// not clear, or when `read` has found further errors.
template <class Read>
auto build(const Document* document, const Format& format, Diagnostics& diagnostics, Read read) {
    std::optional<decltype(read(*document))> out;
    if (!document || !check(*document, format, diagnostics)) return out;
    const int errors_before = diagnostics.errors();
    out = read(*document);
    if (diagnostics.errors() > errors_before) out.reset();
    return out;
}

std::optional<model::System> build_system(const Document* document, Diagnostics& diagnostics) {
    auto out = build(document, system_format(), diagnostics, [&](const Document& d) {
        model::System system = Reader(d, diagnostics).system();
        link(system, false, nullptr, diagnostics);
        return system;
    });
    if (out && !model::compute(*out, diagnostics)) out.reset();
    return out;
}

}  // namespace

std::optional<model::System> read_system(const std::string& path, Diagnostics& diagnostics) {
    return build_system(open(path, system_format(), diagnostics).get(), diagnostics);
}

std::optional<model::System> parse_system(const std::string& path, std::string text,
                                          Diagnostics& diagnostics) {
    return build_system(open(path, std::move(text), system_format(), diagnostics).get(), diagnostics);
}

std::optional<model::System> read_part(const std::string& path, const Use* use, Diagnostics& diagnostics) {
    std::string used;
    if (use) {
        const auto& by = *use->at.file;
        used = fmt::format("{}:{}{}", by.path, use->at.line,
                           by.used.empty() ? "" : ", which is used at " + by.used);
    }
    bool complete = true;
    auto out = build(open(path, process_format(), diagnostics, used).get(), process_format(), diagnostics,
                     [&](const Document& d) {
                         model::System content = Reader(d, diagnostics).part();
                         complete = link(content, true, use, diagnostics);
                         return content;
                     });
    return complete ? std::move(out) : std::nullopt;
}

std::optional<model::ProcessFile> read_process(const std::string& path, Diagnostics& diagnostics) {
    auto content = read_part(path, nullptr, diagnostics);
    if (!content) return std::nullopt;
    model::ProcessFile out;
    out.process = std::move(content->processes.front());
    out.parts.assign(std::make_move_iterator(content->processes.begin() + 1),
                     std::make_move_iterator(content->processes.end()));
    out.connections = std::move(content->connections);
    out.neuron_types = std::move(content->neuron_types);
    out.synapse_types = std::move(content->synapse_types);
    return out;
}

}  // namespace forage::xml
