#include "core/xml/reader.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/base/number.h"
#include "core/model/lookup.h"
#include "core/types/parameter.h"
#include "core/xml/check.h"
#include "core/xml/comments.h"

namespace forage::xml {
namespace {

using tinyxml2::XMLElement;

/// Builds the model from a document that has passed check(): names and values need no second look here.
class Reader {
  public:
    Reader(const Document& document, Diagnostics& out)
        : document_(document), out_(out), comments_(document.root()) {}

    model::System system(const XMLElement& e) {
        model::System s;
        s.at = document_.at(e);
        s.id = text(e, "id"), s.name = text(e, "name"), s.author = text(e, "author"),
        s.date = text(e, "date"), s.port = text(e, "port");
        s.cycles_per_second = number(e, "cylesPerSecond", 25);
        s.sync_plots = flag(e, "syncPlots", false);
        s.note = note(e);
        s.comments = comments_.of(e);
        for (const auto* n = e.GetDocument()->FirstChild(); n; n = n->NextSibling())
            if (n->ToDeclaration() && !std::string_view(n->Value()).starts_with("xml "))
                s.instructions.emplace_back(n->Value());
        each(e, "Process", [&](const XMLElement& p) { s.processes.push_back(process(p)); });
        each(e, "Connection", [&](const XMLElement& c) { s.connections.push_back(connection(c)); });
        return s;
    }

    model::ProcessFile process_file(const XMLElement& e) {
        model::ProcessFile f;
        if (const auto* p = e.FirstChildElement("Process")) f.process = process(*p);
        auto comments = comments_.of(e);
        f.process.comments.insert(f.process.comments.begin(), comments.begin(), comments.end());
        each(e, "Connection", [&](const XMLElement& c) { f.connections.push_back(connection(c)); });
        return f;
    }

  private:
    static std::string text(const XMLElement& e, const char* name) {
        const char* value = e.Attribute(name);
        return value ? value : "";
    }
    static double number(const XMLElement& e, const char* name, double otherwise) {
        const char* value = e.Attribute(name);
        return parse_number<double>(value ? value : "").value_or(otherwise);
    }
    static int whole(const XMLElement& e, const char* name, int otherwise) {
        const char* value = e.Attribute(name);
        return parse_number<int>(value ? value : "").value_or(otherwise);
    }
    static bool flag(const XMLElement& e, const char* name, bool otherwise) {
        const char* value = e.Attribute(name);
        return value ? std::string_view(value) == "true" : otherwise;
    }
    template <class F>
    static void each(const XMLElement& e, const char* name, F visit) {
        for (const auto* c = e.FirstChildElement(name); c; c = c->NextSiblingElement(name)) visit(*c);
    }
    Location value_at(const XMLElement& e, const char* name) const {
        const auto* a = e.FindAttribute(name);
        return a ? document_.value_of(*a) : document_.at(e);
    }

    /// A note's whole text, also where a comment or a CDATA section divides it.
    static std::optional<std::string> note(const XMLElement& e) {
        const auto* n = e.FirstChildElement("Note");
        if (!n) return std::nullopt;
        std::string out;
        for (const auto* node = n->FirstChild(); node; node = node->NextSibling())
            if (node->ToText()) out += node->Value();
        return model::trim(out).empty() ? std::string() : out;  // blanks alone say nothing
    }
    static std::optional<model::Icon> icon(const XMLElement& e) {
        const auto* i = e.FirstChildElement("DiagramIcon");
        if (!i) return std::nullopt;
        return model::Icon{whole(*i, "x", 0), whole(*i, "y", 0), whole(*i, "width", 50),
                           whole(*i, "height", 50)};
    }

    model::Process process(const XMLElement& e) {
        model::Process p;
        p.at = document_.at(e);
        p.id = text(e, "id"), p.name = text(e, "name"), p.color = text(e, "color"),
        p.hostname = text(e, "hostname");
        p.port = text(e, "port"), p.path = text(e, "path");
        p.module_enabled = flag(e, "enableModule", true);
        p.path_at = value_at(e, "path");
        p.comments = comments_.of(e);
        if (const auto* m = e.FirstChildElement("Module")) p.module = module(*m);
        p.note = note(e);
        p.icon = icon(e);
        each(e, "Group", [&](const XMLElement& g) { p.groups.push_back(group(g)); });
        return p;
    }

    void use(const XMLElement& e, model::TypeUse& u) {
        u.type = text(e, "name");
        u.at = value_at(e, "name");
        u.note = note(e);
        each(e, "Parameter", [&](const XMLElement& p) {
            u.settings.push_back(
                {text(p, "name"), text(p, "value"), value_at(p, "name"), value_at(p, "value")});
        });
    }

    /// Only holders of these names mean something in this element.
    void only_holders(const XMLElement& e, const std::vector<std::string>& meaningful) {
        each(e, "XRefHolder", [&](const XMLElement& h) {
            if (std::find(meaningful.begin(), meaningful.end(), text(h, "name")) == meaningful.end())
                out_.unknown(value_at(h, "name"),
                             fmt::format("a <{}> has no cross references '{}'", e.Name(), text(h, "name")),
                             suggest(text(h, "name"), meaningful));
        });
    }

    std::vector<model::CrossReference> references(const XMLElement& e, std::string_view holder) {
        std::vector<model::CrossReference> out;
        each(e, "XRefHolder", [&](const XMLElement& h) {
            if (text(h, "name") == holder)
                each(h, "XRef", [&](const XMLElement& r) {
                    out.push_back({text(r, "name"), text(r, "target"), document_.at(r)});
                });
        });
        return out;
    }

    model::ModuleUse module(const XMLElement& e) {
        model::ModuleUse m;
        use(e, m);
        only_holders(e, {"InputFromGroup", "OutputToGroup"});
        m.inputs = references(e, "InputFromGroup");
        m.outputs = references(e, "OutputToGroup");
        return m;
    }

    model::Group group(const XMLElement& e) {
        model::Group g;
        g.at = document_.at(e);
        g.id = text(e, "id"), g.name = text(e, "name"), g.color = text(e, "color");
        if (const auto* t = e.FirstChildElement("Topology")) g.topology = topology(*t);
        if (const auto* n = e.FirstChildElement("Neuron")) use(*n, g.neuron);
        g.note = note(e);
        g.icon = icon(e);
        g.comments = comments_.of(e);
        return g;
    }

    model::Topology topology(const XMLElement& e) {
        if (const auto* sparse = e.FirstChildElement("TopologySparse"))
            return model::SparseTopology{points(*sparse)};
        model::RectTopology rect;
        if (const auto* r = e.FirstChildElement("TopologyRect")) {
            rect.width = whole(*r, "hcount", 1), rect.height = whole(*r, "vcount", 1);
            rect.wrap_x = flag(*r, "cylinderVert", false), rect.wrap_y = flag(*r, "cylinderHor", false);
        }
        return rect;
    }

    std::vector<model::Point> points(const XMLElement& e) {
        std::vector<model::Point> out;
        each(e, "Point", [&](const XMLElement& p) {
            out.push_back({whole(p, "x", 1), whole(p, "y", 1), document_.at(p)});
        });
        return out;
    }

    model::Population population(const XMLElement& e) {
        const std::string_view name = e.Name();
        if (name == "Region")
            return model::Region{whole(e, "xstart", 1), whole(e, "ystart", 1), whole(e, "width", 1),
                                 whole(e, "height", 1), document_.at(e)};
        if (name == "List") return model::List{points(e), document_.at(e)};
        return model::All{};
    }

    template <class P>
    P populations(const XMLElement& e, P pattern) {
        const auto* source = e.FirstChildElement();
        const auto* target = source->NextSiblingElement();
        pattern.source = population(*source);
        pattern.target = population(*target);
        return pattern;
    }

    model::Pattern pattern(const XMLElement& e) {
        if (const auto* m = e.FirstChildElement("PatternMapped")) {
            model::MappedPattern mapped;
            mapped.all = text(*m, "type") == "all";
            return populations(*m, mapped);
        }
        if (const auto* f = e.FirstChildElement("PatternForeach"))
            return populations(*f, model::ForeachPattern{});
        model::TuplesPattern tuples;
        if (const auto* t = e.FirstChildElement("PatternTuples"))
            each(*t, "Tuple", [&](const XMLElement& tuple) {
                const auto* s = tuple.FirstChildElement("SourceList");
                const auto* d = tuple.FirstChildElement("TargetList");
                if (s && d) tuples.tuples.push_back({points(*s), points(*d)});
            });
        return tuples;
    }

    model::Arborization arborization(const XMLElement& e) {
        model::Arborization a;
        const XMLElement& s = *e.FirstChildElement();
        const std::string_view name = s.Name();
        a.at = document_.at(s);
        a.direction =
            text(s, "direction") == "PF" ? model::Direction::projective : model::Direction::receptive;
        a.probability = number(s, "initialization_probability", 1);
        const auto window = [&]<class W>(W) {
            return W{whole(s, "innerwidth", 0), whole(s, "innerheight", 0), whole(s, "outerwidth", 1),
                     whole(s, "outerheight", 1)};
        };
        if (name == "ArbRect")
            a.shape = model::RectArbor{whole(s, "width", 1), whole(s, "height", 1)};
        else if (name == "ArbEllipse")
            a.shape = model::EllipseArbor{whole(s, "width", 1), whole(s, "height", 1)};
        else if (name == "ArbRectWindow")
            a.shape = window(model::RectWindowArbor{});
        else if (name == "ArbEllipseWindow")
            a.shape = window(model::EllipseWindowArbor{});
        else if (name == "ArbAll")
            a.shape = model::AllArbor{};
        else
            a.shape = model::RandomArbor{whole(s, "count", 1)};
        return a;
    }

    model::DistanceFunction function(const XMLElement& e) {
        model::DistanceFunction f;
        const XMLElement& form = *e.FirstChildElement();
        const std::string_view name = form.Name();
        const double min = number(form, "min", 0), max = number(form, "max", 1);
        f.at = document_.at(form);
        if (name == "FunUniform")
            f.form = model::UniformFunction{number(form, "value", 0)};
        else if (name == "FunLinear")
            f.form = model::LinearFunction{min, max};
        else if (name == "FunGaussian")
            f.form = model::GaussianFunction{min, max, number(form, "sigma", 1)};
        else if (name == "FunBlock")
            f.form = model::BlockFunction{min, max, whole(form, "width", 0), whole(form, "height", 0)};
        else
            f.form = model::RandomFunction{max};
        return f;
    }

    model::Connection connection(const XMLElement& e) {
        model::Connection c;
        c.at = document_.at(e);
        c.id = text(e, "id"), c.name = text(e, "name"), c.source = text(e, "source"),
        c.target = text(e, "target");
        c.source_at = value_at(e, "source"), c.target_at = value_at(e, "target");
        const std::string kind = text(e, "type");
        c.kind = kind == "inhibitory"   ? InputKind::inhibitory
                 : kind == "modulatory" ? InputKind::modulatory
                                        : InputKind::excitatory;
        if (const auto* p = e.FirstChildElement("Pattern")) c.pattern = pattern(*p);
        if (const auto* a = e.FirstChildElement("Arborization")) c.arborization = arborization(*a);
        if (const auto* f = e.FirstChildElement("AttenuationFunction")) c.attenuation = function(*f);
        if (const auto* f = e.FirstChildElement("DelayFunction")) c.delay = function(*f);
        if (const auto* s = e.FirstChildElement("Synapse")) {
            c.synapse.emplace();
            use(*s, *c.synapse);
            only_holders(*s, {"Freedback"});
            c.synapse->feedback = references(*s, "Freedback");
        }
        c.note = note(e);
        c.comments = comments_.of(e);
        if (const auto* l = e.FirstChildElement("DiagramLine"))
            c.line = model::Line{whole(*l, "APSource", 0), whole(*l, "APTarget", 0), points(*l)};
        return c;
    }

    const Document& document_;
    Diagnostics& out_;
    const Comments comments_;
};

/// Reads the files of linked processes, which stand in for what the system itself says of them.
class Linker {
  public:
    Linker(model::System& system, const std::string& system_path, Diagnostics& out)
        : system_(system), directory_(std::filesystem::path(system_path).parent_path()), out_(out) {}

    void run() {
        for (auto& p : system_.processes)
            if (!p.path.empty()) link(p);
    }

  private:
    void link(model::Process& place) {
        const auto file = (directory_ / place.path).string();
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(file, ignored)) {
            out_.error(
                place.path_at,
                fmt::format("process '{}' is linked to '{}', which cannot be read", place.name, place.path),
                fmt::format(
                    "the path is relative to the system file: '{}'; empty it to use what this file says",
                    file));
            return;
        }
        auto content = read_process(file, out_);
        if (!content) return;
        if (!content->process.path.empty()) {
            out_.error(content->process.path_at, "the process of a process file is linked itself",
                       "a linked process cannot lead to another file: empty 'path'");
            return;
        }
        content->process.path = place.path;
        content->process.path_at = place.path_at;
        if (place.icon) content->process.icon = place.icon;
        content->process.placeholder.push_back(std::move(place));
        place = std::move(content->process);
        for (auto& c : content->connections) {
            c.linked = true;
            system_.connections.push_back(std::move(c));
        }
    }

    model::System& system_;
    std::filesystem::path directory_;
    Diagnostics& out_;
};

std::optional<model::System> build(const std::string& path, const std::optional<Document>& document,
                                   Diagnostics& diagnostics) {
    if (!document || !check(*document, "System", diagnostics)) return std::nullopt;
    const int errors_before = diagnostics.errors();
    auto system = Reader(*document, diagnostics).system(document->root());
    Linker(system, path, diagnostics).run();
    if (diagnostics.errors() > errors_before) return std::nullopt;
    return system;
}

}  // namespace

std::optional<model::System> read_system(const std::string& path, Diagnostics& diagnostics) {
    return build(path, Document::read(path, "<System ...>", diagnostics), diagnostics);
}

std::optional<model::System> parse_system(std::string path, std::string text, Diagnostics& diagnostics) {
    return build(path, Document::parse(path, std::move(text), "<System ...>", diagnostics), diagnostics);
}

std::optional<model::ProcessFile> read_process(const std::string& path, Diagnostics& diagnostics) {
    const auto document = Document::read(path, "<iqrEntity ...>", diagnostics);
    if (!document || !check(*document, "iqrEntity", diagnostics)) return std::nullopt;
    const int errors_before = diagnostics.errors();
    auto file = Reader(*document, diagnostics).process_file(document->root());
    if (diagnostics.errors() > errors_before) return std::nullopt;
    return file;
}

}  // namespace forage::xml
