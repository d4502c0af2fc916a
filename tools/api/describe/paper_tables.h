// A description as the tables and equations of a paper, before they are Markdown or LaTeX.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tools/api/describe/system_description.h"

namespace forage {

/// A field of a table: texts, and terms in mathematics (typeset.h).
struct PaperField {
    struct Piece {
        std::string text;
        bool math = false;
    };
    std::vector<Piece> pieces;

    PaperField() = default;
    PaperField(std::string text) : pieces{{std::move(text)}} {}
    PaperField(const char* text) : PaperField(std::string(text)) {}
    void add(std::string text, bool math = false) { pieces.push_back({std::move(text), math}); }
};

struct PaperTable {
    std::string title;              ///< may be empty
    std::vector<std::string> head;  ///< empty: the table has no head
    std::vector<double> widths;     ///< of the columns, as parts of the width of the text; their sum is 1
    std::vector<std::vector<PaperField>> rows;
};

/// A neuron, synapse or module type: its equations, and the values that are in force.
struct TypeSection {
    std::string title, doc;
    std::vector<std::string> equations;  ///< in mathematics
    PaperTable values;
};

struct Paper {
    std::vector<PaperTable> tables;
    /// What values, primes and the names of inputs mean; a name of equations stands between two '`'.
    std::string note;
    std::vector<TypeSection> types;  ///< those in use
};

Paper paper_of(const SystemDescription& description);

}  // namespace forage
