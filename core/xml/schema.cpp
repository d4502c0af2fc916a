#include "core/xml/schema.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/xml/format.h"

namespace forage::xml {
namespace {

class Schema {
  public:
    explicit Schema(const Registry& registry) : registry_(registry) {}

    std::string text() {
        open("grammar");
        attribute("xmlns", "http://relaxng.org/ns/structure/1.0");
        attribute("xmlns:a", "http://relaxng.org/ns/compatibility/annotations/1.0");
        attribute("datatypeLibrary", "http://www.w3.org/2001/XMLSchema-datatypes");
        open("start"), open("choice");
        reference("System"), reference("iqrEntity");
        close(), close();
        for (const auto& rule : format_table()) define(rule);
        close();
        return std::string("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n") + out_.CStr();
    }

  private:
    void open(const char* name) { out_.OpenElement(name); }
    void close() { out_.CloseElement(); }
    void attribute(const char* name, const std::string& value) { out_.PushAttribute(name, value.c_str()); }
    void reference(const std::string& name) { open("ref"), attribute("name", name), close(); }
    void documentation(const std::string& text) {
        if (text.empty()) return;
        open("a:documentation"), out_.PushText(text.c_str()), close();
    }
    void value(const std::string& text) { open("value"), out_.PushText(text.c_str()), close(); }
    void data(const char* type) { open("data"), attribute("type", type), close(); }
    void limit(const char* name, double v) {
        open("param"), attribute("name", name);
        out_.PushText(fmt::format("{:.15g}", v).c_str());  // no exponent for a whole number
        close();
    }
    void choice_of(const std::vector<std::string>& values) {
        open("choice");
        for (const auto& v : values) value(v);
        close();
    }

    void define(const ElementRule& rule) {
        open("define"), attribute("name", rule.name);
        open("element"), attribute("name", rule.name);
        documentation(rule.doc);
        if (rule.name == "Neuron")
            of_types(registry_.neurons());
        else if (rule.name == "Synapse")
            of_types(registry_.synapses());
        else if (rule.name == "Module")
            of_types(registry_.modules());
        else {
            for (const auto& a : rule.attributes) attribute_of(a);
            content(rule);
        }
        close(), close();
    }

    void attribute_of(const AttributeRule& rule) {
        if (!rule.required) open("optional");
        open("attribute"), attribute("name", rule.name);
        documentation(rule.doc);
        switch (rule.kind) {
            case ValueKind::text:
                open("text"), close();
                break;
            case ValueKind::boolean:
                choice_of({"true", "false"});
                break;
            case ValueKind::choice:
                choice_of(rule.choices);
                break;
            case ValueKind::whole:
            case ValueKind::number:
                open("data"), attribute("type", rule.kind == ValueKind::whole ? "integer" : "double");
                if (rule.low > -1e299) limit("minInclusive", rule.low);
                if (rule.high < 1e299) limit("maxInclusive", rule.high);
                close();
        }
        close();
        if (!rule.required) close();
    }

    void content(const ElementRule& rule) {
        if (rule.has_text)
            open("text"), close();
        else if (rule.children.empty())
            open("empty"), close();
        else if (rule.choose > 0)
            for (int i = 0; i < rule.choose; ++i) {
                open("choice");
                for (const auto& c : rule.children) reference(c.name);
                close();
            }
        else
            interleaved(rule.children);
    }

    /// The children in any order, each as often as its rule says.
    void interleaved(const std::vector<ChildRule>& children) {
        open("interleave");
        for (const auto& c : children) {
            const char* often = c.most > 1 ? (c.least ? "oneOrMore" : "zeroOrMore")
                                : c.least  ? nullptr
                                           : "optional";
            if (often) open(often);
            reference(c.name);
            if (often) close();
        }
        close();
    }

    // Neurons, synapses and modules: what they hold depends on the type that they name.

    template <class Map>
    void of_types(const Map& types) {
        open("choice");
        for (const auto& [name, type] : types) {
            open("group");
            open("attribute"), attribute("name", "name");
            documentation(type.label + ": " + type.doc);
            value(name);
            close();
            open("interleave");
            parameters(type.parameters);
            holders(type);
            open("optional"), reference("Note"), close();
            close();
            close();
        }
        close();
    }

    void parameters(const std::vector<Parameter>& all) {
        if (all.empty()) return;
        open("zeroOrMore"), open("element"), attribute("name", "Parameter"), open("choice");
        for (const auto& p : all) {
            open("group");
            open("attribute"), attribute("name", "name");
            documentation(p.label + ". " + p.doc + " Default " + to_text(p.default_value) + "." +
                          (p.at_start ? " Read at start." : ""));
            value(p.name);
            close();
            open("attribute"), attribute("name", "value");
            switch (p.kind) {
                case ParameterKind::boolean:
                    choice_of({"true", "false"});
                    break;
                case ParameterKind::real:
                    data("double");
                    break;
                case ParameterKind::integer:
                    data("integer");
                    break;
                case ParameterKind::text:
                    open("text"), close();
            }
            close();
            close();
        }
        close(), close(), close();
    }

    struct Place {
        std::string name, doc;
    };
    void holder(const char* name, const std::vector<Place>& places, bool any) {
        open("element"), attribute("name", "XRefHolder");
        open("attribute"), attribute("name", "name"), value(name), close();
        if (any)
            open("zeroOrMore"), reference("XRef"), close();
        else if (!places.empty()) {
            open("zeroOrMore"), open("element"), attribute("name", "XRef");
            open("attribute"), attribute("name", "name"), open("choice");
            for (const auto& p : places) {
                documentation(p.doc);
                value(p.name);
            }
            close(), close();
            open("attribute"), attribute("name", "target"), open("text"), close(), close();
            close(), close();
        } else
            open("empty"), close();
        close();
    }
    void holders(const NeuronType&) {}
    void holders(const SynapseType& type) {
        std::vector<Place> places;
        for (const auto& f : type.feedback) places.push_back({f.name, f.label});
        open("zeroOrMore");
        holder("Freedback", places, false);
        close();
    }
    void holders(const ModuleType& type) {
        std::vector<Place> in, out;
        for (const auto& p : type.ports) (p.is_output ? out : in).push_back({p.name, p.label});
        open("zeroOrMore"), open("choice");
        holder("InputFromGroup", in, type.any_ports);
        holder("OutputToGroup", out, type.any_ports);
        close(), close();
    }

    const Registry& registry_;
    tinyxml2::XMLPrinter out_;
};

}  // namespace

std::string relax_ng(const Registry& registry) { return Schema(registry).text(); }

}  // namespace forage::xml
