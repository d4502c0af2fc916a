#include "core/xml/check.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <map>

#include "core/types/parameter.h"
#include "core/xml/format.h"

namespace forage::xml {
namespace {

class Checker {
  public:
    Checker(const Document& document, Diagnostics& out) : document_(document), out_(out) {}

    void element(const tinyxml2::XMLElement& e, const ElementRule& rule) {
        attributes(e, rule);
        std::map<std::string_view, int> count;
        for (const auto* child = e.FirstChildElement(); child; child = child->NextSiblingElement()) {
            const std::string_view name = child->Name();
            const auto allowed = std::find_if(rule.children.begin(), rule.children.end(), [&](const auto& c) { return c.name == name; });
            if (allowed == rule.children.end()) {
                out_.unknown(document_.at(*child), fmt::format("<{}> cannot hold a <{}>", rule.name, name), place_hint(rule, name));
                continue;
            }
            if (++count[allowed->name] > allowed->most)
                out_.error(document_.at(*child), fmt::format("<{}> holds more than {} <{}>", rule.name, allowed->most, name));
            if (const ElementRule* inner = find_element(name)) element(*child, *inner);
        }
        for (const auto& c : rule.children)
            if (count[c.name] < c.least)
                out_.error(document_.at(e), fmt::format("<{}> needs a <{}>", rule.name, c.name),
                           find_element(c.name) ? fmt::format("it says: {}", find_element(c.name)->doc) : "");
    }

  private:
    std::string place_hint(const ElementRule& parent, std::string_view name) const {
        std::vector<std::string> children;
        for (const auto& c : parent.children) children.push_back(c.name);
        if (nearest(name, children).empty())
            for (const auto& other : format_table())
                for (const auto& c : other.children)
                    if (c.name == name) return fmt::format("<{}> belongs into <{}>", name, other.name);
        return children.empty() ? fmt::format("<{}> holds no elements", parent.name) : suggest(name, children);
    }

    void attributes(const tinyxml2::XMLElement& e, const ElementRule& rule) {
        std::vector<std::string> known;
        for (const auto& a : rule.attributes) known.push_back(a.name);
        for (const auto* a = e.FirstAttribute(); a; a = a->Next()) {
            if (const AttributeRule* r = rule.attribute(a->Name())) value(*a, *r);
            else {
                std::string hint = suggest(a->Name(), known);
                if (known.empty()) hint = fmt::format("<{}> has no attributes", rule.name);
                out_.unknown(document_.name_of(*a), fmt::format("<{}> has no attribute '{}'", rule.name, a->Name()), hint);
            }
        }
        for (const auto& r : rule.attributes)
            if (r.required && !e.FindAttribute(r.name.c_str()))
                out_.error(document_.at(e), fmt::format("<{}> needs the attribute '{}'", rule.name, r.name), fmt::format("it says: {}", r.doc));
    }

    void value(const tinyxml2::XMLAttribute& a, const AttributeRule& rule) {
        const std::string_view text = a.Value();
        const auto wrong = [&](std::string message, std::string hint) {
            out_.error(document_.value_of(a), std::move(message), std::move(hint));
        };
        switch (rule.kind) {
            case ValueKind::text: return;
            case ValueKind::choice:
                if (std::find(rule.choices.begin(), rule.choices.end(), text) == rule.choices.end())
                    wrong(fmt::format("'{}' is not one of {}", text, fmt::join(rule.choices, ", ")), suggest(text, rule.choices));
                return;
            case ValueKind::boolean:
                if (!parse_parameter(ParameterKind::boolean, text)) wrong(fmt::format("{} = '{}' is not true or false", rule.name, text), rule.doc);
                return;
            case ValueKind::whole:
            case ValueKind::number: {
                const bool whole = rule.kind == ValueKind::whole;
                const auto parsed = parse_parameter(whole ? ParameterKind::integer : ParameterKind::real, text);
                if (!parsed) {
                    wrong(fmt::format("{} = '{}' is not a {}", rule.name, text, whole ? "whole number" : "number"), rule.doc);
                    return;
                }
                const double v = whole ? std::get<int>(*parsed) : std::get<double>(*parsed);
                if (v < rule.low || v > rule.high)
                    wrong(fmt::format("{} = {} is not possible", rule.name, text),
                          fmt::format("{}: from {} to {}", rule.doc, to_text(rule.low), to_text(rule.high)));
            }
        }
    }

    const Document& document_;
    Diagnostics& out_;
};

}  // namespace

void check(const Document& document, Diagnostics& diagnostics) {
    const std::string_view name = document.root().Name();
    if (name != "System") {
        diagnostics.error(document.at(document.root()), fmt::format("the file begins with <{}>, a system file with <System>", name),
                          name == "sdf" ? "this looks like a world; pass it with --world" : "");
        return;
    }
    Checker(document, diagnostics).element(document.root(), *find_element(name));
}

}  // namespace forage::xml
