#include "core/xml/schema.h"

#include <cmath>

#include <fmt/format.h>

#include "core/xml/printer.h"
#include "core/xml/rules.h"

namespace forage::xml {
namespace {

class Schema : Printer {
  public:
    explicit Schema(const Registry& registry) : registry_(registry) {}

    /// A schema of the format. `roots` are the elements with which a file may begin.
    std::string grammar(const Format& format, const std::vector<std::string>& roots) {
        open("grammar", {{"xmlns", "http://relaxng.org/ns/structure/1.0"},
                         {"xmlns:a", "http://relaxng.org/ns/compatibility/annotations/1.0"},
                         {"datatypeLibrary", "http://www.w3.org/2001/XMLSchema-datatypes"}});
        open("start"), open("choice");
        for (const auto& root : roots) reference(root);
        close(), close();
        for (const auto& rule : format.elements) define(rule);
        if (format.find("Constant")) {
            open("define", {{"name", "formula"}}), open("data", {{"type", "string"}});
            open("param", {{"name", "pattern"}}), text("\\{.*\\}");
            close(), close(), close();
        }
        close();
        return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + result();
    }

  private:
    void element(const std::string& name) { open("element", {{"name", name}}); }
    void attribute(const std::string& name) { open("attribute", {{"name", name}}); }
    void reference(const std::string& name) { leaf("ref", {{"name", name}}); }
    void written(const char* name, const std::string& content) { open(name), text(content), close(); }
    void documentation(const std::string& doc) {
        if (!doc.empty()) written("a:documentation", doc);
    }
    void documentation(const ValueRule& rule) {
        documentation(rule.doc + (rule.unit.empty() ? "" : " (" + rule.unit + ")") +
                      (rule.otherwise.empty() ? "" : "; " + rule.otherwise + " if absent"));
    }
    void choice_of(const std::vector<std::string>& values) {
        open("choice");
        for (const auto& v : values) written("value", v);
        close();
    }
    void number(const char* type, double low, double high) {
        open("data", {{"type", type}});
        for (const auto& [name, limit] : {std::pair("minInclusive", low), std::pair("maxInclusive", high)})
            if (std::isfinite(limit)) {
                open("param", {{"name", name}});
                text(fmt::format("{:.15g}", limit));  // no exponent for a whole number
                close();
            }
        close();
    }

    void define(const ElementRule& rule) {
        open("define", {{"name", rule.name}}), element(rule.name);
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
        attribute(rule.name);
        documentation(rule.value);
        value(rule.value);
        close();
        if (!rule.required) close();
    }

    void value(const ValueRule& rule) {
        if (!rule.formula) return plain(rule);
        open("choice");
        plain(rule);
        reference("formula");
        close();
    }

    void plain(const ValueRule& rule) {
        switch (rule.kind) {
            case ValueKind::boolean:
                return choice_of({"true", "false"});
            case ValueKind::choice:
                return choice_of(rule.choices);
            case ValueKind::whole:
                return number("integer", rule.low, rule.high);
            case ValueKind::number:
                return number("double", rule.low, rule.high);
            default:
                return leaf("text");
        }
    }

    void content(const ElementRule& rule) {
        if (rule.value)
            value(*rule.value);
        else if (rule.children.empty())
            leaf("empty");
        else if (rule.choose > 0)
            alternatives(rule);
        else
            interleaved(rule.children);
    }

    void alternatives(const ElementRule& rule) {
        if (rule.or_none) open("optional");
        for (int i = 0; i < rule.choose; ++i) {
            open("choice");
            for (const auto& c : rule.children) reference(c.name);
            close();
        }
        if (rule.or_none) close();
    }

    /// Writes the children in any order, each as often as its rule allows.
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

    // The content of neurons, synapses and modules depends on the type that they name.

    template <class Map>
    void of_types(const Map& types) {
        open("choice");
        for (const auto& [name, type] : types) {
            open("group");
            attribute("name");
            documentation(type.label + ": " + type.doc);
            written("value", name);
            close();
            open("interleave");
            parameters(type.parameters);
            initial(type);
            holders(type);
            open("optional"), reference("Note"), close();
            close();
            close();
        }
        if constexpr (!std::is_same_v<typename Map::mapped_type, ModuleType>) of_declared_types(types);
        close();
    }
    /// Types that the file itself declares: any other name.
    template <class Map>
    void of_declared_types(const Map& shipped) {
        open("group"), attribute("name"), open("data", {{"type", "string"}}), open("except");
        choice_of(names(shipped));
        close(), close(), close();
        open("interleave");
        for (const char* child : {"Parameter", "Initial"}) open("zeroOrMore"), reference(child), close();
        open("optional"), reference("Note"), close();
        close(), close();
    }

    void parameters(const std::vector<Parameter>& all) {
        if (all.empty()) return;
        open("zeroOrMore"), element("Parameter"), open("choice");
        for (const auto& p : all) {
            open("group");
            attribute("name");
            documentation(p.label + ". " + p.doc + " Default " + to_text(p.default_value) + "." +
                          (p.at_start ? " Read at start." : ""));
            written("value", p.name);
            close();
            attribute("value");
            value({.kind = p.kind == ParameterKind::boolean   ? ValueKind::boolean
                           : p.kind == ParameterKind::real    ? ValueKind::number
                           : p.kind == ParameterKind::integer ? ValueKind::whole
                                                              : ValueKind::text,
                   .formula = p.kind == ParameterKind::real || p.kind == ParameterKind::integer});
            close();
            close();
        }
        close(), close(), close();
    }

    void initial(const auto& type) {
        if constexpr (requires { type.states; }) open("zeroOrMore"), reference("Initial"), close();
    }

    template <class Places>
    void holder(const char* name, const Places& places, bool any) {
        element("XRefHolder");
        attribute("name"), written("value", name), close();
        if (any) {
            open("zeroOrMore"), reference("XRef"), close();
        } else if (places.empty()) {
            leaf("empty");
        } else {
            open("zeroOrMore"), element("XRef");
            attribute("name"), open("choice");
            for (const auto& p : places) documentation(p.label), written("value", p.name);
            close(), close();
            attribute("target"), leaf("text"), close();
            close(), close();
        }
        close();
    }
    void holders(const NeuronType&) {}
    void holders(const SynapseType& type) {
        open("zeroOrMore");
        holder("Freedback", type.feedback, false);
        close();
    }
    void holders(const ModuleType& type) {
        std::vector<ModulePort> in, out;
        for (const auto& p : type.ports) (p.is_output ? out : in).push_back(p);
        open("zeroOrMore"), open("choice");
        holder("InputFromGroup", in, type.any_ports);
        holder("OutputToGroup", out, type.any_ports);
        close(), close();
    }

    const Registry& registry_;
};

}  // namespace

std::string relax_ng(const Registry& registry) {
    return Schema(registry).grammar(system_format(), {"System", "iqrEntity"});
}

std::string relax_ng_of_experiments() {
    return Schema(Registry{}).grammar(experiment_format(), {"experiment"});
}

}  // namespace forage::xml
