// File formats as tables: the elements and attributes, their places and their meaning. The check, its hints
// and the schemas come from these tables.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace forage::xml {

enum class ValueKind {
    text,
    choice,   ///< one of several words
    boolean,  ///< true or false; in an open format also 1, 0 and capitals
    number,   ///< one number or several
    whole,    ///< a whole number
    any,      ///< texts and elements that are checked only by their reader
};

/// What a text names.
enum class Names {
    nothing,
    neuron,     ///< a neuron type
    synapse,    ///< a synapse type
    module,     ///< a module type
    parameter,  ///< a parameter of the type in whose element it stands
    value,      ///< the value of this parameter
    port,       ///< a cross reference of this type
    group,      ///< the id of a group
    target,     ///< what is connected to a port: a group of the process, or a state of the target's cells
};

/// The values that an attribute or an element may have.
struct ValueRule {
    ValueKind kind = ValueKind::text;
    std::string doc = {};
    double low = -std::numeric_limits<double>::infinity();  ///< numbers outside `low` to `high` are errors
    double high = std::numeric_limits<double>::infinity();
    std::vector<std::string> choices = {};
    std::size_t least = 1, most = 1;  ///< smallest and largest count of numbers
    bool may_be_empty = false;        ///< whether an empty element counts as absent
    bool formula = false;             ///< whether a number may be a formula in braces
    bool decisive = false;  ///< whether what depends on the value cannot be checked when it is wrong

    /// Another rule, which holds in an element whose `attribute` has the value `value`.
    struct Exception {
        std::string_view attribute, value;
        std::string_view rule;  ///< a key of Format::values
    };
    Exception exception = {};
    std::string unit = {};       ///< of numbers; empty when they have none
    std::string otherwise = {};  ///< the value that holds where the file has none; empty when it has no text
    Names names = Names::nothing;
    std::string label = {};                       ///< in forms; empty: the name of the attribute
    std::vector<std::string> choice_labels = {};  ///< in forms; empty: the choices
};

struct AttributeRule {
    std::string name;
    ValueRule value;
    bool required = false;
    bool omit_default = false;   ///< whether a value that is the default is not written
    bool alternative = false;    ///< whether its element has exactly one of several such attributes
    bool relative_path = false;  ///< whether it is a path from the folder of the file
    std::optional<std::string> inert = {};  ///< as in ChildRule
};

struct ElementRule;

/// An element that may stand in another one.
struct ChildRule {
    std::string name;
    int least = 0, most = 1;
    bool first_counts = false;          ///< whether further ones have no effect
    const ValueRule* value = nullptr;   ///< the rule for its text; null when it has no text
    const ElementRule* rule = nullptr;  ///< its attributes and elements
    /// Of an element that nothing reads: the value that holds anyway, with commas between numbers and |
    /// between alternatives, or "*" for every value. Other values give a warning.
    std::optional<std::string> inert = {};
};

struct ElementRule {
    std::string name, doc;
    /// The elements that may stand in it, with blanks between them: "Note?:text Process". After a name stands
    /// ? for at most once, ! for once, + for at least once, and nothing for any number; then :KIND, a key of
    /// Format::values, when the element has a value. A :KIND without a name is that of the element itself.
    /// In an open format, & stands for any number, nothing for at most one that counts, @ROW before :KIND for
    /// another row than that of the name, and =VALUE at the end for ChildRule::inert.
    std::string content = {};
    std::vector<AttributeRule> attributes = {};
    int choose = 0;        ///< the number of elements in it when they are alternatives, else 0
    bool or_none = false;  ///< whether all alternatives may be absent

    std::vector<ChildRule> children = {};  ///< made from `content` by Format::link()
    const ValueRule* value = nullptr;

    const AttributeRule* attribute(std::string_view name) const;
};

/// A kind of file.
struct Format {
    std::string_view name;            ///< with its article: "a system file"
    std::string_view beginning = {};  ///< the start tag of such a file: "<System ...>"
    std::vector<std::string_view> roots =
        {};  ///< names of the outermost element; the first one is in the table
    std::size_t max_nodes = std::size_t{1} << 20;  ///< elements, attributes and comments of a file
    /// Whether other programs extend the format. Unknown elements and attributes then have no effect and give
    /// warnings.
    bool open = false;
    std::string_view where_texts_stand = "a remark is written <!-- -->";  ///< hint for a text elsewhere
    std::map<std::string, ValueRule, std::less<>> values = {};            ///< rules by name of a kind
    std::vector<ElementRule> elements = {};

    /// The rule for an element; null when the format has no element with this name.
    const ElementRule* find(std::string_view element) const;
    /// Makes the children of all elements from their contents. Nothing may be added to the tables afterwards.
    Format&& link() &&;
};

// Rows of a table. A rule is optional unless required().
inline AttributeRule required(AttributeRule rule) {
    rule.required = true;
    return rule;
}
inline AttributeRule text(std::string_view name, std::string_view doc) {
    return {std::string(name), {ValueKind::text, std::string(doc)}};
}
inline AttributeRule flag(std::string_view name, std::string_view doc) {
    return {std::string(name), {ValueKind::boolean, std::string(doc)}};
}
inline AttributeRule choice(std::string_view name, std::string_view doc, std::vector<std::string> choices) {
    return {std::string(name),
            {.kind = ValueKind::choice, .doc = std::string(doc), .choices = std::move(choices)}};
}
inline AttributeRule number(std::string_view name, std::string_view doc,
                            double low = -std::numeric_limits<double>::infinity(),
                            double high = std::numeric_limits<double>::infinity()) {
    return {std::string(name), {ValueKind::number, std::string(doc), low, high}};
}
inline AttributeRule whole(std::string_view name, std::string_view doc, double low, double high = 1e6) {
    return {std::string(name), {ValueKind::whole, std::string(doc), low, high}};
}

/// An attribute that is not written when its value is the default.
inline AttributeRule omit_default(AttributeRule rule) {
    rule.omit_default = true;
    return rule;
}
/// A value on which the check of others depends.
inline AttributeRule decisive(AttributeRule rule) {
    rule.value.decisive = true;
    return rule;
}

/// The unit of a rule's numbers.
inline AttributeRule in(std::string_view unit, AttributeRule rule) {
    rule.value.unit = unit;
    return rule;
}
/// What forms call an attribute, and its choices, where the names in the file are not plain.
inline AttributeRule called(std::string_view label, AttributeRule rule,
                            std::vector<std::string> choice_labels = {}) {
    rule.value.label = label, rule.value.choice_labels = std::move(choice_labels);
    return rule;
}
inline AttributeRule alternative(AttributeRule rule) {
    rule.alternative = true;
    return rule;
}
inline AttributeRule relative_path(AttributeRule rule) {
    rule.relative_path = true;
    return rule;
}

/// A rule whose text names something.
inline AttributeRule naming(Names what, AttributeRule rule) {
    rule.value.names = what;
    return rule;
}

const Format& system_format();
const Format& process_format();
const Format& experiment_format();

}  // namespace forage::xml
