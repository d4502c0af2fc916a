// XML text, element by element.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "core/types/parameter.h"

namespace forage::xml {

/// Writes elements with indentation, each on a line of its own. Reading the text gives the same names and
/// values. Names are literals.
class Printer {
  public:
    struct Attribute {
        const char* name;
        ParameterValue value;
    };
    using Attributes = std::initializer_list<Attribute>;

    void open(const char* name, Attributes attributes = {}) {
        out_.OpenElement(name);
        for (const Attribute& a : attributes) attribute(a.name, a.value);
    }
    /// Writes an attribute of the element that was opened last.
    void attribute(const char* name, const ParameterValue& value) {
        out_.PushAttribute(name, hidden(to_text(value), "\r\n\t").c_str());
    }
    void close() { out_.CloseElement(); }
    /// Writes an element without content.
    void leaf(const char* name, Attributes attributes = {}) { open(name, attributes), close(); }
    /// Writes the text of the element that was opened last; an element with a text has no elements in it.
    void text(const std::string& content) { out_.PushText(hidden(content, "\r").c_str()); }
    void comment(const std::string& content) { out_.PushComment(content.c_str()); }

    std::string result() const {
        std::string out;
        for (const char* c = out_.CStr(); *c; ++c)
            if (*c == 1)
                out += "&#13;";
            else if (*c == 2)
                out += "&#10;";
            else if (*c == 3)
                out += "&#9;";
            else
                out += *c;
        return out;
    }

  private:
    /// Replaces special characters, which tinyxml2 would write unchanged and a reader would take for
    /// blanks, by characters that cannot occur in XML. result() replaces these by character references.
    static std::string hidden(std::string text, std::string_view special) {
        for (char& c : text)
            if (special.find(c) != special.npos) c = c == '\r' ? 1 : c == '\n' ? 2 : 3;
        return text;
    }

    tinyxml2::XMLPrinter out_;
};

}  // namespace forage::xml
