#include "core/xml/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/base/number.h"
#include "core/base/printable.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/formula/formula.h"
#include "core/types/parameter.h"

namespace forage::xml {
namespace {

/// The attribute or element whose value is checked.
struct Subject {
    std::string_view name;
    bool is_element;
    const ValueRule& rule;

    std::string label() const { return is_element ? fmt::format("<{}>", name) : std::string(name); }
    /// "hcount: cells in a row, from 1 to 100000"
    std::string description() const {
        const bool low = std::isfinite(rule.low), high = std::isfinite(rule.high);
        return fmt::format("{}: {}{}", name, rule.doc,
                           low && high ? fmt::format(", from {:.15g} to {:.15g}", rule.low, rule.high)
                           : low       ? fmt::format(", at least {:.15g}", rule.low)
                                       : "");
    }
    /// A hint for `text`, which is not of this kind: what was probably meant.
    std::string hint(std::string_view text) const {
        if (text.ends_with(',')) return description();  // an element of a list
        const std::string meant = corrected(rule.kind == ValueKind::boolean ? ParameterKind::boolean
                                            : rule.kind == ValueKind::whole ? ParameterKind::integer
                                                                            : ParameterKind::real,
                                            text);
        return meant.empty() ? description() : fmt::format("did you mean '{}'?", meant);
    }
};

class Checker {
  public:
    Checker(const Format& format, Diagnostics& out) : format_(format), out_(out) {}

    bool sound() const { return sound_; }

    /// Reports what has no effect: once for all elements or attributes of the same name in the same element.
    void report_inert() {
        for (auto& [message, inert] : inert_)
            out_.warning(
                inert.first,
                inert.count == 1 ? message : fmt::format("{} ({} times in this file)", message, inert.count),
                inert.hint);
    }

    void element(const Element& e, const ChildRule& rule) {
        if (!rule.value) {
            if (!format_.open)  // the robot's own files have a stray character
                for (const Value& text : e.texts())
                    ignored(text.where(), fmt::format("<{}> holds no text", e.name()),
                            format_.where_texts_stand);
            return contents(e, *rule.rule);
        }
        const auto& exception = rule.value->exception;
        const bool excepted = !exception.attribute.empty() && e[exception.attribute].view == exception.value;
        value(e.value(), {}, excepted ? format_.values.find(exception.rule)->second : *rule.value);
        if (rule.value->kind == ValueKind::any)
            attributes(e, *rule.rule);
        else
            contents(e, *rule.rule);
    }

  private:
    // ---- elements ----

    void contents(const Element& e, const ElementRule& rule) {
        attributes(e, rule);
        children(e, rule);
    }

    /// Reports an error after which the meaning of the rest of the file is not clear.
    void structural(const Location& where, std::string message, std::string hint) {
        out_.error(where, std::move(message), std::move(hint));
        sound_ = false;
    }

    void children(const Element& e, const ElementRule& rule) {
        std::vector<int> count(rule.children.size());
        int chosen = 0;
        bool unknown_children = false;
        for (const Element& child : e.children()) {
            if (out_.errors() >= max_errors) {
                sound_ = false;
                return;
            }
            const auto known = std::ranges::find(rule.children, child.name(), &ChildRule::name);
            if (known == rule.children.end()) {
                unknown_children |= unknown(child, rule);
                continue;
            }
            const int n = ++count[static_cast<std::size_t>(known - rule.children.begin())];
            ++chosen;
            if (rule.choose && chosen > rule.choose)
                structural(child.where(), fmt::format("<{}> holds more than {}", e.name(), amount(rule)),
                           "remove what is too much");
            else if (n > known->most)
                structural(child.where(),
                           fmt::format("<{}> holds more than {} <{}>", e.name(), known->most, known->name),
                           "keep one of them");
            else if (known->first_counts && n == 2)
                out_.warning(child.where(), fmt::format("<{}> holds several <{}>", e.name(), known->name),
                             "the first one counts");
            if (known->inert)
                inert(child, *known);
            else
                element(child, *known);
        }
        if (unknown_children) return;  // a missing element is probably the misspelt one
        if (chosen < rule.choose && !(rule.or_none && chosen == 0))
            structural(e.where(),
                       fmt::format("<{}> holds {}, it needs {}", e.name(),
                                   chosen ? "only one element" : "no element", amount(rule)),
                       fmt::format("{} of <{}>", rule.choose > 1 ? "source, then target, each one" : "one",
                                   separated(names_of(rule.children), ">, <")));
        for (std::size_t i = 0; i < count.size(); ++i)
            if (const ChildRule& c = rule.children[i]; count[i] < c.least)
                structural(e.where(), fmt::format("<{}> needs the element <{}>", e.name(), c.name),
                           fmt::format("<{}>: {}", c.name, c.value ? c.value->doc : c.rule->doc));
    }

    /// Checks an element that nothing reads, and notes a value that does not hold anyway.
    void inert(const Element& e, const ChildRule& rule) {
        const int errors_before = out_.errors();
        const bool unchecked = !rule.value || rule.value->kind == ValueKind::any;
        if (!unchecked) value(e.value(), {}, *rule.value);
        if (out_.errors() > errors_before || *rule.inert == "*") return;
        if (unchecked ? !is_empty(e) : !e.value().view.empty() && !is_inert(e.value(), *rule.inert))
            note_inert(e.where(), fmt::format("<{}> in <{}> has no effect", e.name(), e.parent().name()),
                       unchecked && rule.value ? rule.value->doc : "");
    }

    /// Whether an element holds nothing but zeros and such elements.
    static bool is_empty(const Element& e) {
        const auto text = e.value().view;
        return e.attributes().empty() &&
               (text == "false" || text.find_first_not_of("0.- \t\r\n") == text.npos) &&
               std::ranges::all_of(e.children(), is_empty);
    }

    /// Whether a value is `inert`, an entry of ChildRule::inert.
    static bool is_inert(const Value& v, std::string_view inert) {
        const auto bar = inert.find('|');
        if (bar < inert.size() && is_inert(v, inert.substr(bar + 1))) return true;
        inert = inert.substr(0, bar);
        if (inert == "*" || v.view == inert) return true;
        if (v.flag() && (inert == "0" || inert == "1")) return *v.flag() == (inert == "1");
        std::string list(inert);
        std::ranges::replace(list, ',', ' ');
        const auto numbers = v.numbers();
        std::size_t i = 0;
        for (const std::string_view word : words(list)) {
            const auto wanted = parse_number<double>(word);
            if (!wanted || i >= numbers.size()) return false;
            if (std::abs(numbers[i++] - *wanted) > 0.01 * std::max(1.0, std::abs(*wanted)))
                return false;  // 9.81 is near to 9.8
        }
        return i > 0;
    }

    void note_inert(const Location& where, std::string message, std::string hint) {
        auto& inert = inert_[std::move(message)];
        if (inert.count++ == 0) inert.first = where, inert.hint = std::move(hint);
    }

    static std::string amount(const ElementRule& rule) {
        return rule.choose == 1 ? "one element" : fmt::format("{} elements", rule.choose);
    }

    void ignored(const Location& where, std::string message, std::string_view hint) {
        if (format_.open)
            out_.warning(where, std::move(message), std::string(hint));
        else
            out_.unknown(where, std::move(message), std::string(hint));
    }

    /// Reports an unknown element. Returns whether it may be a missing element with a misspelt name.
    bool unknown(const Element& e, const ElementRule& parent) {
        if (format_.open && e.name().find(':') != std::string_view::npos) return false;  // another program's
        const auto message =
            format_.open && !parent.choose
                ? fmt::format("<{}> is not known in <{}> and has no effect", e.name(), e.parent().name())
                : fmt::format("<{}> cannot hold <{}>", e.parent().name(), e.name());
        // Where an element is chosen from several, the meaning of an unknown one is not clear, so leniency
        // does not apply.
        if (parent.choose) return structural(e.where(), message, place_hint(parent, e)), true;
        ignored(e.where(), message, place_hint(parent, e));
        const bool error = !format_.open && !out_.lenient;
        if (error) sound_ = false;
        return error;
    }

    std::string place_hint(const ElementRule& parent, const Element& e) const {
        const std::vector<std::string> children = names_of(parent.children);
        std::vector<std::string_view> homes;
        for (const auto& other : format_.elements)
            for (const auto& c : other.children)
                if (c.name == e.name()) homes.push_back(other.name);
        if (!format_.open && homes.size() == 1 && nearest(e.name(), children).empty())
            return fmt::format("<{}> belongs into <{}>", e.name(), homes.front());
        return children.empty() ? fmt::format("<{}> holds no elements", e.parent().name())
                                : suggest(e.name(), children);
    }

    // ---- attributes and values ----

    void attributes(const Element& e, const ElementRule& rule) {
        std::vector<std::string> meant;  // misspelt attributes mean these, so they are not missing, too
        for (const Attribute& a : e.attributes()) {
            if (const AttributeRule* r = rule.attribute(a.name)) {
                value(a.value, a.name, r->value);
                if (r->inert && !a.value.view.empty() && !is_inert(a.value, *r->inert))
                    note_inert(e.document().place(a.at),
                               fmt::format("the attribute '{}' of <{}> has no effect", a.name, e.name()), {});
            } else if (format_.open) {
                if (rule.value && rule.value->kind == ValueKind::any) continue;
                if (a.name.starts_with("xmlns") || a.name.find(':') != std::string_view::npos) continue;
                const auto known = names_of(rule.attributes), inside = names_of(rule.children);
                const auto child = nearest(a.name, inside);
                note_inert(e.document().place(a.at),
                           fmt::format("<{}> has no attribute '{}': it has no effect", e.name(), a.name),
                           !child.empty() && (child == a.name || nearest(a.name, known).empty())
                               ? fmt::format("write <{0}>{1}</{0}> in <{2}>", child, a.value.view, e.name())
                           : known.empty() ? fmt::format("<{}> has no attributes", e.name())
                                           : suggest(a.name, known));
            } else {
                const std::vector<std::string> known = names_of(rule.attributes);
                meant.emplace_back(nearest(a.name, known));
                out_.unknown(
                    e.document().place(a.at), fmt::format("<{}> has no attribute '{}'", e.name(), a.name),
                    known.empty() ? fmt::format("<{}> has no attributes", e.name()) : suggest(a.name, known));
            }
        }
        for (const AttributeRule& r : rule.attributes)
            if (r.required && !e[r.name]) {
                sound_ = false;
                if (!out_.lenient && contains(meant, r.name)) continue;
                out_.error(e.where(), fmt::format("<{}> needs the attribute '{}'", e.name(), r.name),
                           r.value.doc.empty() ? fmt::format("<{} {}=\"...\">", e.name(), r.name)
                                               : fmt::format("{}: {}", r.name, r.value.doc));
            }
    }

    /// Checks the value of the attribute `attribute`, or of an element when the name is empty.
    void value(const Value& v, std::string_view attribute, const ValueRule& rule) {
        if (!attribute.empty() && !format_.open && has_odd_control(v.view))
            out_.error(v.where(), fmt::format("{} = '{}' has a control character", attribute, v.view),
                       "remove it");
        if (rule.kind == ValueKind::text || rule.kind == ValueKind::any) return;
        const Subject subject{attribute.empty() ? v.element.name() : attribute, attribute.empty(), rule};
        const int errors_before = out_.errors();
        if (subject.is_element && v.view.empty() && format_.open) {
            if (!rule.may_be_empty)
                out_.warning(v.where(), fmt::format("<{}> is empty and has no effect", subject.name));
        } else if (rule.kind == ValueKind::choice) {
            if (!contains(rule.choices, v.view))
                out_.error(v.where(),
                           fmt::format("'{}' is not one of {}", v.view, separated(rule.choices, ", ")),
                           suggest(v.view, rule.choices));
        } else if (rule.kind == ValueKind::boolean) {
            if (!v.flag() || (!format_.open && v.view != "true" && v.view != "false"))
                out_.error(v.where(), fmt::format("{} = '{}' is not true or false", subject.label(), v.view),
                           subject.hint(v.view));
        } else if (subject.is_element) {
            numbers(v, subject);
        } else {
            number(v, subject);
        }
        if (rule.decisive && out_.errors() > errors_before) sound_ = false;
    }

    void numbers(const Value& v, const Subject& subject) {
        const auto list = v.words();
        const int errors_before = out_.errors();
        for (const Value& word : list) {
            number(word, subject);
            if (out_.errors() > errors_before && subject.rule.most <= 1) return;  // "five minutes"
        }
        if (out_.errors() > errors_before) return;
        if (list.size() < subject.rule.least || list.size() > subject.rule.most)
            out_.error(v.element.where(),
                       fmt::format("<{}> has {} numbers instead of {}", subject.name, list.size(),
                                   subject.rule.most),
                       subject.description());
    }

    /// Checks that a word is a number that the rule allows.
    void number(const Value& v, const Subject& subject) {
        const std::string_view word = v.view;
        const ValueRule& rule = subject.rule;
        if (rule.formula && in_braces(word)) return;  // model::compute() checks it
        const bool whole = rule.kind == ValueKind::whole;
        const auto wrong = [&](std::string_view what, std::string hint) {
            out_.error(v.where(), fmt::format("{} = {}", subject.label(), what), std::move(hint));
        };
        if (in_braces(word) && format_.find("Constant"))
            return wrong(fmt::format("'{}' is a formula, which cannot stand here", word), "write the number");
        const auto number = parse_number<double>(word);
        if (!number && out_of_range(word)) return wrong(no_number(word), subject.description());
        if (!number || (whole && *number != std::trunc(*number)))
            return wrong(whole ? fmt::format("'{}' is not a whole number", word) : no_number(word),
                         subject.hint(word));
        if (*number < rule.low || *number > rule.high)
            return wrong(fmt::format("{} is not possible", word), subject.description());
        if (whole && !format_.open && !parse_number<int>(word))  // 1e2, 3.0
            return wrong(fmt::format("'{}' is not written as a whole number", word),
                         fmt::format("write {}", to_text(*number)));
    }

    static constexpr int max_errors = 100'000;  // further ones would not be printed

    struct Inert {
        Location first;
        std::string hint;
        int count = 0;
    };

    const Format& format_;
    Diagnostics& out_;
    std::map<std::string, Inert> inert_;  ///< by message
    bool sound_ = true;
};

/// The kind of a file whose outermost element has this name; empty when the kind is unknown.
std::string_view what_begins_with(std::string_view root) {
    static constexpr std::array<std::array<std::string_view, 2>, 4> known = {
        {{"System", "this is a system file: 'forage run' runs it, other files do not contain it"},
         {"iqrEntity", "this is a process file: a part of a system, not a system"},
         {"experiment", "this is an experiment file; 'forage experiment' runs it"},
         {"sdf",
          "this looks like a world file: pass it with --world, or name it in <world> of an experiment"}}};
    for (const auto& [name, what] : known)
        if (name == root) return what;
    return {};
}

}  // namespace

std::unique_ptr<const Document> open(const std::string& path, const Format& format, Diagnostics& diagnostics,
                                     std::string used) {
    constexpr std::size_t largest_file = std::size_t{32} << 20;
    auto text = read_file(path, largest_file, diagnostics);
    return text ? open(path, std::move(*text), format, diagnostics, std::move(used)) : nullptr;
}

std::unique_ptr<const Document> open(const std::string& path, std::string text, const Format& format,
                                     Diagnostics& diagnostics, std::string used) {
    auto document = Document::parse({path, std::move(text), std::move(used)}, format.beginning,
                                    format.max_nodes, diagnostics);
    if (!document) return nullptr;
    const std::string_view name = document->root().name();
    if (contains(format.roots, name)) return document;
    const std::string_view known = what_begins_with(name);
    diagnostics.error(
        document->root().where(),
        fmt::format("the file begins with <{}>, {} with <{}>", name, format.name, format.roots.front()),
        known.empty() ? fmt::format("a file of this kind begins with {}", format.beginning)
                      : std::string(known));
    return nullptr;
}

bool check(const Document& document, const Format& format, Diagnostics& diagnostics) {
    return check(document.root(), *format.find(format.roots.front()), format, diagnostics);
}

bool check(const Element& element, const ElementRule& rule, const Format& format, Diagnostics& diagnostics) {
    Checker checker(format, diagnostics);
    checker.element(element, {.name = rule.name, .value = rule.value, .rule = &rule});
    checker.report_inert();
    return checker.sound();
}

}  // namespace forage::xml
