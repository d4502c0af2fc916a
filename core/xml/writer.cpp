#include "core/xml/writer.h"

#include <algorithm>
#include <array>

#include <tinyxml2.h>

#include "core/types/parameter.h"

namespace forage::xml {
namespace {

class Writer {
  public:
    void system(const model::System& s) {
        comments(s.comments);
        open("System");
        attribute("id", s.id);
        attribute("name", s.name);
        attribute("author", s.author);
        attribute("date", s.date);
        attribute("cylesPerSecond", s.cycles_per_second);
        attribute("syncPlots", s.sync_plots);
        if (!s.port.empty()) attribute("port", s.port);
        note(s.note);
        for (const auto& p : s.processes) process(p.linked() ? p.placeholder.front() : p);
        for (const auto& c : s.connections)
            if (!c.linked) connection(c);
        close();
    }

    void process_file(const model::ProcessFile& f) {
        open("iqrEntity");
        attribute("type", "Process");
        process(f.process);
        for (const auto& c : f.connections) connection(c);
        close();
    }

    std::string text() const {
        std::string out;
        for (const char* c = out_.CStr(); *c; ++c) {
            if (*c == carriage_return)
                out += "&#13;";
            else if (*c == line_feed)
                out += "&#10;";
            else if (*c == tab)
                out += "&#9;";
            else
                out += *c;
        }
        return out;
    }

  private:
    void open(const char* name) { out_.OpenElement(name); }
    void close() { out_.CloseElement(); }
    void attribute(const char* name, std::string value) {
        for (char& c : value) c = c == '\r' ? carriage_return : c == '\n' ? line_feed : c == '\t' ? tab : c;
        out_.PushAttribute(name, value.c_str());
    }
    void attribute(const char* name, const char* value) { out_.PushAttribute(name, value); }
    void attribute(const char* name, bool value) { attribute(name, value ? "true" : "false"); }
    void attribute(const char* name, int value) { attribute(name, to_text(value)); }
    void attribute(const char* name, double value) { attribute(name, to_text(value)); }
    /// An element with nothing in it.
    template <class... Values>
    void leaf(const char* name, const Values&... attributes) {
        open(name);
        (attribute(attributes.first, attributes.second), ...);
        close();
    }

    void comments(const std::vector<std::string>& all) {
        for (const auto& c : all) out_.PushComment(c.c_str());
    }
    void note(const std::optional<std::string>& n) {
        if (!n) return;
        open("Note");
        if (!n->empty()) {
            std::string content = *n;
            std::replace(content.begin(), content.end(), '\r', carriage_return);
            out_.PushText(content.c_str());
        }
        close();
    }
    void icon(const std::optional<model::Icon>& i) {
        if (i)
            leaf("DiagramIcon", std::pair("x", i->x), std::pair("y", i->y), std::pair("width", i->width),
                 std::pair("height", i->height));
    }

    void process(const model::Process& p) {
        comments(p.comments);
        open("Process");
        attribute("id", p.id);
        attribute("name", p.name);
        if (!p.hostname.empty()) attribute("hostname", p.hostname);
        if (!p.port.empty()) attribute("port", p.port);
        attribute("enableModule", p.module_enabled);
        if (!p.path.empty()) attribute("path", p.path);
        if (!p.color.empty()) attribute("color", p.color);
        if (p.module) module(*p.module);
        note(p.note);
        icon(p.icon);
        for (const auto& g : p.groups) group(g);
        close();
    }

    void settings(const model::TypeUse& use) {
        attribute("name", use.type);
        for (const auto& s : use.settings)
            leaf("Parameter", std::pair("name", s.name), std::pair("value", s.value));
    }
    void references(const char* holder, const std::vector<model::CrossReference>& all) {
        if (all.empty()) return;
        open("XRefHolder");
        attribute("name", holder);
        for (const auto& r : all) leaf("XRef", std::pair("name", r.name), std::pair("target", r.target));
        close();
    }
    void module(const model::ModuleUse& m) {
        open("Module");
        settings(m);
        references("InputFromGroup", m.inputs);
        references("OutputToGroup", m.outputs);
        note(m.note);
        close();
    }

    void group(const model::Group& g) {
        comments(g.comments);
        open("Group");
        attribute("id", g.id);
        attribute("name", g.name);
        if (!g.color.empty()) attribute("color", g.color);
        open("Topology");
        if (const auto* rect = std::get_if<model::RectTopology>(&g.topology))
            leaf("TopologyRect", std::pair("hcount", rect->width), std::pair("vcount", rect->height),
                 std::pair("cylinderHor", rect->wrap_y), std::pair("cylinderVert", rect->wrap_x));
        else
            points("TopologySparse", std::get<model::SparseTopology>(g.topology).points);
        close();
        open("Neuron");
        settings(g.neuron);
        note(g.neuron.note);
        close();
        note(g.note);
        icon(g.icon);
        close();
    }

    void point(const model::Point& p) { leaf("Point", std::pair("x", p.x), std::pair("y", p.y)); }
    void points(const char* name, const std::vector<model::Point>& all) {
        open(name);
        for (const auto& p : all) point(p);
        close();
    }

    void population(const model::Population& p) {
        if (const auto* r = std::get_if<model::Region>(&p))
            leaf("Region", std::pair("xstart", r->x), std::pair("ystart", r->y), std::pair("width", r->width),
                 std::pair("height", r->height));
        else if (const auto* l = std::get_if<model::List>(&p))
            points("List", l->points);
        else
            leaf("All");
    }

    void pattern(const model::Pattern& pattern) {
        open("Pattern");
        if (const auto* mapped = std::get_if<model::MappedPattern>(&pattern)) {
            open("PatternMapped");
            attribute("type", mapped->all ? "all" : "center");
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

    void shape(const model::RectArbor& a) {
        open("ArbRect"), attribute("width", a.width), attribute("height", a.height);
    }
    void shape(const model::EllipseArbor& a) {
        open("ArbEllipse"), attribute("width", a.width), attribute("height", a.height);
    }
    void shape(const model::RectWindowArbor& a) { open("ArbRectWindow"), window(a); }
    void shape(const model::EllipseWindowArbor& a) { open("ArbEllipseWindow"), window(a); }
    void shape(const model::AllArbor&) { open("ArbAll"); }
    void shape(const model::RandomArbor& a) { open("ArbRandom"), attribute("count", a.count); }
    template <class Window>
    void window(const Window& a) {
        attribute("innerwidth", a.inner_width), attribute("innerheight", a.inner_height);
        attribute("outerwidth", a.outer_width), attribute("outerheight", a.outer_height);
    }

    void form(const model::UniformFunction& f) { leaf("FunUniform", std::pair("value", f.value)); }
    void form(const model::LinearFunction& f) {
        leaf("FunLinear", std::pair("min", f.min), std::pair("max", f.max));
    }
    void form(const model::GaussianFunction& f) {
        leaf("FunGaussian", std::pair("min", f.min), std::pair("max", f.max), std::pair("sigma", f.sigma));
    }
    void form(const model::BlockFunction& f) {
        open("FunBlock");
        attribute("min", f.min), attribute("max", f.max), attribute("width", f.width);
        if (f.height != 0) attribute("height", f.height);
        close();
    }
    void form(const model::RandomFunction& f) { leaf("FunRandom", std::pair("max", f.max)); }
    void function(const char* name, const model::DistanceFunction& f) {
        open(name);
        std::visit([this](const auto& g) { form(g); }, f.form);
        close();
    }

    void connection(const model::Connection& c) {
        static constexpr std::array kinds{"excitatory", "inhibitory", "modulatory"};
        comments(c.comments);
        open("Connection");
        attribute("id", c.id);
        attribute("name", c.name);
        attribute("type", kinds[static_cast<std::size_t>(c.kind)]);
        attribute("source", c.source);
        attribute("target", c.target);
        pattern(c.pattern);
        open("Arborization");
        std::visit([this](const auto& a) { shape(a); }, c.arborization.shape);
        attribute("direction", c.arborization.direction == model::Direction::projective ? "PF" : "RF");
        attribute("initialization_probability", c.arborization.probability);
        close();
        close();
        function("AttenuationFunction", c.attenuation);
        function("DelayFunction", c.delay);
        if (c.synapse) {
            open("Synapse");
            settings(*c.synapse);
            references("Freedback", c.synapse->feedback);
            note(c.synapse->note);
            close();
        }
        note(c.note);
        if (c.line) {
            open("DiagramLine");
            attribute("APSource", c.line->source_anchor), attribute("APTarget", c.line->target_anchor);
            for (const auto& v : c.line->vertices) point(v);
            close();
        }
        close();
    }

    // The printer writes these as they are, and a reader would take them for blanks (in a text, a carriage
    // return for a line end): they pass it as characters that no XML holds.
    static constexpr char carriage_return = 1, line_feed = 2, tab = 3;
    tinyxml2::XMLPrinter out_;
};

constexpr const char* declaration = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"no\"?>\n";

}  // namespace

std::string write_system(const model::System& system) {
    Writer writer;
    writer.system(system);
    std::string instructions;
    for (const auto& i : system.instructions) instructions += "<?" + i + "?>\n";
    return declaration + instructions + "<!DOCTYPE System PUBLIC '-//INI/iqr421' 'iqrSystem.dtd'>\n" +
           writer.text();
}

std::string write_process(const model::ProcessFile& file) {
    Writer writer;
    writer.process_file(file);
    return declaration + writer.text();
}

}  // namespace forage::xml
