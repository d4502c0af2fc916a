#include "core/xml/check.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/base/number.h"
#include "core/types/parameter.h"
#include "core/xml/format.h"

namespace forage::xml {
namespace {

class Checker {
  public:
    Checker(const Document& document, const Format& format, Diagnostics& out)
        : document_(document), format_(format), out_(out) {}

    /// Whether a model of the document is wrong only where that was reported: nothing is missing from it, and
    /// no cell.
    bool sound() const { return sound_; }

    void element(const tinyxml2::XMLElement& e, const ElementRule& rule) {
        attributes(e, rule);
        const int errors_before = out_.errors();
        const int inner = children(e, rule);
        if (out_.errors() > errors_before + inner) sound_ = false;
    }

  private:
    /// Returns the number of errors in the children themselves.
    int children(const tinyxml2::XMLElement& e, const ElementRule& rule) {
        int inside = 0;
        std::map<std::string_view, int> count;
        int chosen = 0;
        bool strangers = false;
        for (const auto* node = e.FirstChild(); node; node = node->NextSibling()) {
            if (const auto* text = node->ToText(); text && !rule.has_text) inside += stray(*text, rule);
            const auto* child = node->ToElement();
            if (!child) continue;
            if (out_.errors() >= most_errors) {
                sound_ = false;
                return inside;
            }
            const std::string_view name = child->Name();
            const auto allowed = std::find_if(rule.children.begin(), rule.children.end(),
                                              [&](const auto& c) { return c.name == name; });
            if (allowed == rule.children.end()) {
                const auto at = document_.at(*child);
                const auto message = fmt::format("<{}> cannot hold <{}>", rule.name, name);
                // Where one of several is chosen, nothing says what the unknown one might have meant: no
                // leniency.
                if (rule.choose)
                    out_.error(at, message, place_hint(rule, name));
                else
                    out_.unknown(at, message, place_hint(rule, name));
                strangers = true;
                continue;
            }
            ++chosen;
            if (rule.choose && chosen > rule.choose)
                out_.error(document_.at(*child),
                           fmt::format("<{}> holds more than {}", rule.name, amount(rule)),
                           "remove what is too much");
            else if (++count[allowed->name] > allowed->most)
                out_.error(document_.at(*child),
                           fmt::format("<{}> holds more than {} <{}>", rule.name, allowed->most, name),
                           "keep one of them");
            if (const ElementRule* inner = find_element(name, format_)) {
                const int before = out_.errors();
                element(*child, *inner);
                inside += out_.errors() - before;
            }
        }
        // What is missing is probably what was misspelt; but under leniency that was no error, and this must
        // be one.
        if (strangers && (rule.choose || !out_.lenient)) return inside;
        if (chosen < rule.choose)
            out_.error(document_.at(e),
                       fmt::format("<{}> holds {}, it needs {}", rule.name,
                                   chosen ? "only one element" : "no element", amount(rule)),
                       fmt::format("{} of <{}>", rule.choose > 1 ? "source, then target, each one" : "one",
                                   fmt::join(child_names(rule), ">, <")));
        for (const auto& c : rule.children)
            if (count[c.name] < c.least)
                out_.error(document_.at(e), fmt::format("<{}> needs the element <{}>", rule.name, c.name),
                           fmt::format("<{}>: {}", c.name, find_element(c.name, format_)->doc));
        return inside;
    }

    static std::string amount(const ElementRule& rule) {
        return rule.choose == 1 ? "one element" : fmt::format("{} elements", rule.choose);
    }
    static std::vector<std::string> child_names(const ElementRule& rule) {
        std::vector<std::string> out;
        for (const auto& c : rule.children) out.push_back(c.name);
        return out;
    }

    /// Returns the number of errors.
    int stray(const tinyxml2::XMLText& text, const ElementRule& rule) {
        const Location at = document_.at(text);
        out_.unknown(at, fmt::format("<{}> holds no text", rule.name),
                     "a text for people stands in a <Note>, a remark in <!-- -->");
        return out_.lenient ? 0 : 1;
    }

    std::string place_hint(const ElementRule& parent, std::string_view name) const {
        const std::vector<std::string> children = child_names(parent);
        if (nearest(name, children).empty())
            for (const auto& other : format_)
                for (const auto& c : other.children)
                    if (c.name == name) return fmt::format("<{}> belongs into <{}>", name, other.name);
        return children.empty() ? fmt::format("<{}> holds no elements", parent.name)
                                : suggest(name, children);
    }

    void attributes(const tinyxml2::XMLElement& e, const ElementRule& rule) {
        std::vector<std::string> known;
        for (const auto& a : rule.attributes) known.push_back(a.name);
        std::vector<std::string_view> meant;  // by attributes that are misspelt: they are not missing as well
        for (const auto* a = e.FirstAttribute(); a; a = a->Next()) {
            if (const AttributeRule* r = rule.attribute(a->Name())) {
                const int before = out_.errors();
                value(*a, *r);
                // A wrong size would make groups look wrong where they are used, a wrong holder its
                // references unset.
                if (out_.errors() > before &&
                    (rule.name == "TopologyRect" || rule.name == "Point" || rule.name == "XRefHolder"))
                    sound_ = false;
            } else {
                meant.push_back(nearest(a->Name(), known));
                std::string hint = suggest(a->Name(), known);
                if (known.empty()) hint = fmt::format("<{}> has no attributes", rule.name);
                out_.unknown(document_.name_of(*a),
                             fmt::format("<{}> has no attribute '{}'", rule.name, a->Name()), hint);
            }
        }
        for (const auto& r : rule.attributes)
            if (r.required && !e.FindAttribute(r.name.c_str())) {
                sound_ = false;
                if (!out_.lenient && std::find(meant.begin(), meant.end(), r.name) != meant.end()) continue;
                out_.error(document_.at(e), fmt::format("<{}> needs the attribute '{}'", rule.name, r.name),
                           fmt::format("{}: {}", r.name, r.doc));
            }
    }

    void value(const tinyxml2::XMLAttribute& a, const AttributeRule& rule) {
        const std::string_view text = a.Value();
        const auto wrong = [&](std::string message, std::string hint) {
            out_.error(document_.value_of(a), std::move(message), std::move(hint));
        };
        switch (rule.kind) {
            case ValueKind::text:
                return;
            case ValueKind::choice:
                if (std::find(rule.choices.begin(), rule.choices.end(), text) == rule.choices.end())
                    wrong(fmt::format("'{}' is not one of {}", text, fmt::join(rule.choices, ", ")),
                          suggest(text, rule.choices));
                return;
            case ValueKind::boolean:
                if (!parse_parameter(ParameterKind::boolean, text))
                    wrong(fmt::format("{} = '{}' is not true or false", rule.name, text),
                          hint(ParameterKind::boolean, text, fmt::format("{}: {}", rule.name, rule.doc)));
                return;
            case ValueKind::whole:
            case ValueKind::number:
                number(text, rule, wrong);
        }
    }

    template <class Wrong>
    static void number(std::string_view text, const AttributeRule& rule, const Wrong& wrong) {
        const auto parsed = parse_number<double>(text);
        const double v = parsed.value_or(0);
        const bool whole = rule.kind == ValueKind::whole;
        const std::string range = fmt::format("{}: {}{}", rule.name, rule.doc, limits(rule));
        if (!parsed || (whole && v != std::trunc(v))) {
            wrong(fmt::format("{} = '{}' is not a {}", rule.name, text, whole ? "whole number" : "number"),
                  hint(whole ? ParameterKind::integer : ParameterKind::real, text, range));
        } else if (v < rule.low || v > rule.high) {
            wrong(fmt::format("{} = {} is not possible", rule.name, text), range);
        } else if (whole && !parse_number<int>(text)) {  // 1e2, 3.0
            wrong(fmt::format("{} = '{}' is not written as a whole number", rule.name, text),
                  fmt::format("write {}", to_text(v)));
        }
    }

    static std::string hint(ParameterKind kind, std::string_view text, std::string otherwise) {
        const std::string meant = mended(kind, text);
        return meant.empty() ? std::move(otherwise) : fmt::format("did you mean '{}'?", meant);
    }

    static std::string limits(const AttributeRule& rule) {
        if (rule.low < -1e299 || rule.high > 1e299) return {};
        return fmt::format(", from {:.0f} to {:.0f}", rule.low, rule.high);
    }

    static constexpr int most_errors = 100'000;  // nobody reads more

    const Document& document_;
    const Format& format_;
    Diagnostics& out_;
    bool sound_ = true;
};

/// A hint for a file of another kind than the one that is wanted.
std::string what_begins_with(std::string_view name, std::string_view wanted) {
    if (name == "sdf")
        return wanted == "experiment" ? "this looks like a world"
                                      : "this looks like a world; pass it with --world";
    if (name == "iqrEntity")
        return wanted == "system" ? "this is a process file: a part of a system, not a system"
                                  : "this is a process file";
    if (name == "System")
        return wanted == "process" ? "this is a system file, not a part of one"
                                   : "this is a system file; 'forage run' runs it";
    if (name == "experiment") return "this is an experiment file; 'forage experiment' runs it";
    return fmt::format("is this a {} file?", wanted);
}

}  // namespace

bool check(const Document& document, std::string_view root, Diagnostics& diagnostics) {
    const std::string_view name = document.root().Name();
    if (name != root) {
        const std::string_view kind = root == "System" ? "system" : root == "iqrEntity" ? "process" : root;
        diagnostics.error(document.at(document.root()),
                          fmt::format("the file begins with <{}>, {} {} file with <{}>", name,
                                      kind == "experiment" ? "an" : "a", kind, root),
                          what_begins_with(name, kind));
        return false;
    }
    const Format& format = root == "experiment" ? experiment_format() : format_table();
    Checker checker(document, format, diagnostics);
    checker.element(document.root(), *find_element(name, format));
    return checker.sound();
}

}  // namespace forage::xml
