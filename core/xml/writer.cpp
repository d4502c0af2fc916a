#include "core/xml/writer.h"

#include <type_traits>

#include "core/model/lookup.h"
#include "core/model/parts.h"
#include "core/xml/canvas.h"
#include "core/xml/printer.h"
#include "core/xml/system_elements.h"

namespace forage::xml {
namespace {

class Writer : Printer {
  public:
    using Printer::result;

    void system(const model::System& s) {
        comments(s.comments);
        begin(s);
        for (const auto& c : s.constants) leaf_of(c);
        types(s);
        note(s.note);
        for (const auto& p : s.processes)
            if (p.within.empty()) process(p.linked() ? p.placeholder.front() : p);
        const auto ports = model::ports_by_group(s);
        for (const auto& c : s.connections)
            if (!c.linked) connection(model::renamed(ports, c));
        for (const auto& c : s.canvas_comments) comment(write_canvas_part(c));
        close();
    }

    void process_file(const model::ProcessFile& f) {
        open("iqrEntity", {{"type", "Process"}});
        types(f);
        process(f.process);
        for (const auto& p : f.parts)
            if (p.within.empty()) process(p.linked() ? p.placeholder.front() : p);
        for (const auto& c : f.connections) connection(c);
        close();
    }

  private:
    /// Opens the element that describes `s`, with its attributes and those of `more`.
    template <class Struct, class... More>
    void begin(const Struct& s, const More&... more) {
        open(element_of<Struct>().rule.name.c_str());
        attributes(s), (attributes(more), ...);
    }
    template <class... Structs>
    void leaf_of(const Structs&... all) {
        begin(all...), close();
    }
    template <class Struct>
    void attributes(const Struct& s, bool defaults = true) {
        for (const auto& a : element_of<Struct>().attributes)
            if (const auto* formula = formula_of(a, s))
                attribute(a.rule.name.c_str(), *formula);
            else if (const auto value = value_of(a, s);
                     (defaults && !a.rule.omit_default) || value != value_of(a, Struct()))
                attribute(a.rule.name.c_str(), value);
    }

    void comments(const std::vector<std::string>& all) {
        for (const auto& c : all) comment(c);
    }
    void note(const std::optional<std::string>& n) {
        if (!n) return;
        open("Note");
        if (!n->empty()) text(*n);
        close();
    }
    void icon(const std::optional<model::Icon>& i) {
        if (i) leaf_of(*i);
    }

    void types(const auto& all) {
        for (const auto& type : all.neuron_types)
            if (!type.linked) declaration("NeuronType", type);
        for (const auto& type : all.synapse_types)
            if (!type.linked) declaration("SynapseType", type);
    }
    void declaration(const char* kind, const model::TypeDeclaration& type) {
        open(kind), attributes(type);
        for (const auto& c : type.constants) leaf_of(c);
        for (const auto& s : type.states) leaf_of(s);
        open("Equations");
        std::string all;
        for (const auto& piece : type.equations) all += (all.empty() ? "" : "\n") + piece.text;
        if (!all.empty()) text(all);
        close(), close();
    }

    void process(const model::Process& p) {
        comments(p.comments);
        begin(p);
        for (const auto& c : p.constants) leaf_of(c);
        for (const auto& port : p.ports) leaf_of(port);
        if (p.module) {
            use(*p.module);
            references("InputFromGroup", p.module->inputs);
            references("OutputToGroup", p.module->outputs);
            end_use(*p.module);
        }
        note(p.note);
        icon(p.icon);
        for (const auto& g : p.groups) group(g);
        // At the end, where they are not taken for remarks about the next group.
        for (const auto& c : p.canvas_comments) comment(write_canvas_part(c));
        for (const auto& f : p.phantoms) comment(write_canvas_part(f));
        close();
    }

    void use(const auto& u) {
        begin(u);
        for (const auto& s : u.settings) leaf_of(s);
        for (const auto& i : u.initial) leaf_of(i);
    }
    void end_use(const model::TypeUse& u) { note(u.note), close(); }
    void references(const char* holder, const std::vector<model::CrossReference>& all) {
        if (all.empty()) return;
        open("XRefHolder", {{"name", holder}});
        for (const auto& r : all) leaf_of(r);
        close();
    }

    void group(const model::Group& g) {
        comments(g.comments);
        begin(g);
        if (const auto* rect = std::get_if<model::RectTopology>(&g.topology); rect && g.terse) {
            attributes(*rect, false);
        } else {
            open("Topology");
            if (rect)
                leaf_of(*rect);
            else
                points("TopologySparse", std::get<model::SparseTopology>(g.topology).points);
            close();
        }
        use(g.neuron), end_use(g.neuron);
        note(g.note);
        icon(g.icon);
        close();
    }

    void points(const char* name, const std::vector<model::Point>& all) {
        open(name);
        for (const auto& p : all) leaf_of(p);
        close();
    }

    void population(const model::Population& p) {
        if (const auto* r = std::get_if<model::Region>(&p))
            leaf_of(*r);
        else if (const auto* l = std::get_if<model::List>(&p))
            points("List", l->points);
        else
            leaf("All");
    }

    void pattern(const model::Pattern& pattern, bool terse) {
        open("Pattern");
        const auto populations = [&](const auto& p) {
            if (terse && std::holds_alternative<model::All>(p.source) &&
                std::holds_alternative<model::All>(p.target))
                return;
            population(p.source), population(p.target);
        };
        if (const auto* mapped = std::get_if<model::MappedPattern>(&pattern)) {
            begin(*mapped);
            populations(*mapped);
        } else if (const auto* each = std::get_if<model::ForeachPattern>(&pattern)) {
            open("PatternForeach");
            populations(*each);
        } else {
            open("PatternTuples");
            for (const auto& t : std::get<model::TuplesPattern>(pattern).tuples) {
                open("Tuple");
                points("SourceList", t.sources), points("TargetList", t.targets);
                close();
            }
        }
        close();
        close();
    }

    void arborization(const model::Arborization& a) {
        open("Arborization");
        std::visit([&](const auto& shape) { leaf_of(shape, a); }, a.shape);
        close();
    }

    void function(const char* name, const model::DistanceFunction& f) {
        open(name);
        std::visit([&](const auto& form) { leaf_of(form); }, f.form);
        close();
    }

    /// Whether synapses have a fixed weight, and nothing else that an attribute could not say.
    static bool has_only_weight(model::SynapseUse s) {
        if (s.settings.size() == 1 && s.settings.front().name == "weight") s.settings.clear();
        return s == model::fixed_weight();
    }

    void connection(const model::Connection& c) {
        comments(c.comments);
        open("Connection"), attributes(c, !c.terse);
        const auto* weights = std::get_if<model::Weights>(&c.pattern);
        const bool only_weight = c.terse_synapse && c.synapse && has_only_weight(*c.synapse) &&
                                 (!weights || c.synapse->settings.empty());  // never beside <Weights>
        if (only_weight)
            for (const auto& s : c.synapse->settings) attribute("weight", s.value);
        const auto written = [&c](const auto& part) {
            return !c.terse || part != std::remove_cvref_t<decltype(part)>{};
        };
        const auto* mapped = std::get_if<model::MappedPattern>(&c.pattern);
        if (weights) {
            begin(*weights);
            if (!weights->text.empty()) text(weights->text);
            close();
        } else if (written(c.pattern) || (mapped && mapped->is_stated))
            pattern(c.pattern, c.terse);
        if (written(c.arborization)) arborization(c.arborization);
        if (written(c.attenuation)) function("AttenuationFunction", c.attenuation);
        if (written(c.delay)) function("DelayFunction", c.delay);
        if (c.synapse && !only_weight) {
            use(*c.synapse);
            references("Freedback", c.synapse->feedback);
            end_use(*c.synapse);
        }
        note(c.note);
        if (c.line) {
            begin(*c.line);
            for (const auto& v : c.line->vertices) leaf_of(v);
            for (const bool of_target : {false, true})
                if (const auto& v = of_target ? c.line->target_vertices : c.line->source_vertices; !v.empty())
                    comment(write_canvas_part(PageVertices{of_target, v}));
            close();
        }
        close();
    }
};

constexpr const char* declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"no\"?>\n";

}  // namespace

std::string write_system(const model::System& system) {
    Writer writer;
    writer.system(system);
    std::string instructions;
    for (const auto& i : system.instructions) instructions += "<?" + i + "?>\n";
    return declaration + instructions + "<!DOCTYPE System PUBLIC '-//INI/iqr421' 'iqrSystem.dtd'>\n" +
           writer.result();
}

std::string write_process(const model::ProcessFile& file) {
    Writer writer;
    writer.process_file(file);
    return declaration + writer.result();
}

}  // namespace forage::xml
