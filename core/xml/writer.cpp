#include "core/xml/writer.h"

#include <array>
#include <type_traits>

#include "core/xml/canvas.h"
#include "core/xml/printer.h"

namespace forage::xml {
namespace {

class Writer : Printer {
  public:
    using Printer::result;

    void system(const model::System& s) {
        comments(s.comments);
        open("System", {{"id", s.id},
                        {"name", s.name},
                        {"author", s.author},
                        {"date", s.date},
                        {"cylesPerSecond", s.cycles_per_second},
                        {"syncPlots", s.sync_plots},
                        unless_empty("port", s.port)});
        note(s.note);
        for (const auto& p : s.processes) process(p.linked() ? p.placeholder.front() : p);
        for (const auto& c : s.connections)
            if (!c.linked) connection(c);
        for (const auto& c : s.canvas_comments) comment(write_canvas_part(c));
        close();
    }

    void process_file(const model::ProcessFile& f) {
        open("iqrEntity", {{"type", "Process"}});
        process(f.process);
        for (const auto& c : f.connections) connection(c);
        close();
    }

  private:
    static Attribute unless_empty(const char* name, const std::string& value) {
        return {name, value, value.empty()};
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
        if (i) leaf("DiagramIcon", {{"x", i->x}, {"y", i->y}, {"width", i->width}, {"height", i->height}});
    }

    void process(const model::Process& p) {
        comments(p.comments);
        open("Process", {{"id", p.id},
                         {"name", p.name},
                         unless_empty("hostname", p.hostname),
                         unless_empty("port", p.port),
                         {"enableModule", p.module_enabled},
                         unless_empty("path", p.path),
                         unless_empty("color", p.color)});
        if (p.module) {
            use("Module", *p.module);
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

    void use(const char* element, const model::TypeUse& u) {
        open(element, {{"name", u.type}});
        for (const auto& s : u.settings) leaf("Parameter", {{"name", s.name}, {"value", s.value}});
    }
    void end_use(const model::TypeUse& u) { note(u.note), close(); }
    void references(const char* holder, const std::vector<model::CrossReference>& all) {
        if (all.empty()) return;
        open("XRefHolder", {{"name", holder}});
        for (const auto& r : all) leaf("XRef", {{"name", r.name}, {"target", r.target}});
        close();
    }

    void group(const model::Group& g) {
        comments(g.comments);
        open("Group", {{"id", g.id}, {"name", g.name}, unless_empty("color", g.color)});
        open("Topology");
        if (const auto* rect = std::get_if<model::RectTopology>(&g.topology))
            leaf("TopologyRect", {{"hcount", rect->width},
                                  {"vcount", rect->height},
                                  {"cylinderHor", rect->wrap_y},
                                  {"cylinderVert", rect->wrap_x}});
        else
            points("TopologySparse", std::get<model::SparseTopology>(g.topology).points);
        close();
        use("Neuron", g.neuron), end_use(g.neuron);
        note(g.note);
        icon(g.icon);
        close();
    }

    void point(const model::Point& p) { leaf("Point", {{"x", p.x}, {"y", p.y}}); }
    void points(const char* name, const std::vector<model::Point>& all) {
        open(name);
        for (const auto& p : all) point(p);
        close();
    }

    void population(const model::Population& p) {
        if (const auto* r = std::get_if<model::Region>(&p))
            leaf("Region", {{"xstart", r->x}, {"ystart", r->y}, {"width", r->width}, {"height", r->height}});
        else if (const auto* l = std::get_if<model::List>(&p))
            points("List", l->points);
        else
            leaf("All");
    }

    void pattern(const model::Pattern& pattern) {
        open("Pattern");
        if (const auto* mapped = std::get_if<model::MappedPattern>(&pattern)) {
            open("PatternMapped", {{"type", mapped->all ? "all" : "center"}});
            population(mapped->source), population(mapped->target);
        } else if (const auto* each = std::get_if<model::ForeachPattern>(&pattern)) {
            open("PatternForeach");
            population(each->source), population(each->target);
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
        const Attribute direction{"direction", a.direction == model::Direction::projective ? "PF" : "RF"},
            probability{"initialization_probability", a.probability};
        const auto rect = [&](const char* name, const auto& s) {
            leaf(name, {{"width", s.width}, {"height", s.height}, direction, probability});
        };
        const auto window = [&](const char* name, const auto& s) {
            leaf(name, {{"innerwidth", s.inner_width},
                        {"innerheight", s.inner_height},
                        {"outerwidth", s.outer_width},
                        {"outerheight", s.outer_height},
                        direction,
                        probability});
        };
        open("Arborization");
        if (const auto* rectangle = std::get_if<model::RectArbor>(&a.shape))
            rect("ArbRect", *rectangle);
        else if (const auto* ellipse = std::get_if<model::EllipseArbor>(&a.shape))
            rect("ArbEllipse", *ellipse);
        else if (const auto* frame = std::get_if<model::RectWindowArbor>(&a.shape))
            window("ArbRectWindow", *frame);
        else if (const auto* ring = std::get_if<model::EllipseWindowArbor>(&a.shape))
            window("ArbEllipseWindow", *ring);
        else if (const auto* random = std::get_if<model::RandomArbor>(&a.shape))
            leaf("ArbRandom", {{"count", random->count}, direction, probability});
        else
            leaf("ArbAll", {direction, probability});
        close();
    }

    void form(const model::UniformFunction& f) { leaf("FunUniform", {{"value", f.value}}); }
    void form(const model::LinearFunction& f) { leaf("FunLinear", {{"min", f.min}, {"max", f.max}}); }
    void form(const model::GaussianFunction& f) {
        leaf("FunGaussian", {{"min", f.min}, {"max", f.max}, {"sigma", f.sigma}});
    }
    void form(const model::BlockFunction& f) {
        leaf("FunBlock",
             {{"min", f.min}, {"max", f.max}, {"width", f.width}, {"height", f.height, f.height == 0}});
    }
    void form(const model::RandomFunction& f) { leaf("FunRandom", {{"max", f.max}}); }
    void function(const char* name, const model::DistanceFunction& f) {
        open(name);
        std::visit([this](const auto& g) { form(g); }, f.form);
        close();
    }

    void connection(const model::Connection& c) {
        static constexpr std::array kinds{"excitatory", "inhibitory", "modulatory"};
        comments(c.comments);
        open("Connection", {{"id", c.id},
                            {"name", c.name},
                            {"type", kinds[static_cast<std::size_t>(c.kind)]},
                            {"source", c.source},
                            {"target", c.target}});
        const auto written = [&c](const auto& part) {
            return !c.terse || part != std::remove_cvref_t<decltype(part)>{};
        };
        if (written(c.pattern)) pattern(c.pattern);
        if (written(c.arborization)) arborization(c.arborization);
        if (written(c.attenuation)) function("AttenuationFunction", c.attenuation);
        if (written(c.delay)) function("DelayFunction", c.delay);
        if (c.synapse) {
            use("Synapse", *c.synapse);
            references("Freedback", c.synapse->feedback);
            end_use(*c.synapse);
        }
        note(c.note);
        if (c.line) {
            open("DiagramLine", {{"APSource", c.line->source_anchor}, {"APTarget", c.line->target_anchor}});
            for (const auto& v : c.line->vertices) point(v);
            for (const bool of_source : {true, false})
                if (const auto& v = of_source ? c.line->source_vertices : c.line->target_vertices; !v.empty())
                    comment(write_canvas_part(PageVertices{of_source, v}));
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
