// The file formats as tables: which elements and attributes there are, and what they mean. The check, its
// hints and the schema come from it; the original's spellings stand in it like any other.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace forage::xml {

enum class ValueKind { text, boolean, whole, number, choice };

struct AttributeRule {
    std::string name;
    ValueKind kind = ValueKind::text;
    bool required = false;
    std::string doc;
    double low = -1e300, high = 1e300;  ///< of a number; outside is an error
    std::vector<std::string> choices;
};

struct ChildRule {
    std::string name;
    int least = 0, most = 1;
};
inline constexpr int any_number = 1 << 30;

struct ElementRule {
    std::string name;
    std::string doc;
    std::vector<AttributeRule> attributes;
    std::vector<ChildRule> children;
    bool has_text = false;
    int choose = 0;  ///< how many of `children` it holds in all, when they are alternatives; 0: each as often
                     ///< as it says

    const AttributeRule* attribute(std::string_view name) const;
};

/// All elements of a kind of file.
using Format = std::vector<ElementRule>;

const Format& format_table();       ///< of system and process files
const Format& experiment_format();  ///< of experiment files

/// The rule of an element, or null when the format has none of that name.
const ElementRule* find_element(std::string_view name, const Format& format = format_table());

}  // namespace forage::xml
