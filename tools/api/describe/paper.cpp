// Descriptions for papers: Markdown and LaTeX.
#include <map>

#include <fmt/format.h>

#include "tools/api/describe/paper_tables.h"
#include "tools/api/describe/typeset.h"

namespace forage {
namespace {

std::string markdown_text(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (c == '\n')
            out += ' ';
        else
            out += std::string_view("|\\*_`<$").find(c) == std::string_view::npos ? std::string(1, c)
                                                                                  : std::string("\\") + c;
    return out;
}

/// Lines may end behind '/', '_' and '.', where there is no blank. A hyphen before a number is a minus.
std::string latex_text(const std::string& text) {
    static const std::map<char, const char*> named = {
        {'\\', "\\textbackslash{}"}, {'^', "\\textasciicircum{}"},
        {'~', "\\textasciitilde{}"}, {'<', "\\textless{}"},
        {'>', "\\textgreater{}"},    {'|', "\\textbar{}"},
        {'"', "\\textquotedbl{}"},   {'\n', " "},
        {'/', "/\\penalty500{}"},    {'_', "\\_\\penalty500{}"},
        {'.', ".\\penalty500{}"},    {'-', "$-$"},
        {'x', "$\\times$"}};
    const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i], before = i == 0 ? ' ' : text[i - 1];
        const bool minus = c == '-' && digit(i + 1) && before == ' ';
        const bool times = c == 'x' && i > 1 && digit(i - 2) && before == ' ' && digit(i + 2);
        const bool plain = std::string_view("\\{}$&#^_~%\n<>|\"/.-x").find(c) == std::string_view::npos ||
                           (c == '.' && digit(i + 1)) || (c == '-' && !minus) || (c == 'x' && !times);
        const auto it = named.find(c);
        out += plain ? std::string(1, c) : it == named.end() ? std::string("\\") + c : it->second;
    }
    return out;
}

std::string markdown_field(const PaperField& field) {
    std::string out;
    for (const auto& p : field.pieces) out += p.math ? "$" + p.text + "$" : markdown_text(p.text);
    return out;
}
/// The space allows a hyphen in a first word that is wider than its column.
std::string latex_field(const PaperField& field) {
    std::string out = "\\hspace{0pt}";
    for (const auto& p : field.pieces) out += p.math ? "$" + p.text + "$" : latex_text(p.text);
    return out;
}

/// A row of a table: the fields with `between` among them, between `before` and `after`.
std::string row_of_table(const std::vector<PaperField>& fields, std::string (*written)(const PaperField&),
                         std::string_view before, std::string_view between, std::string_view after) {
    std::string out(before);
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (i) out += between;
        out += written(fields[i]);
    }
    return out + std::string(after);
}

std::vector<PaperField> head_of(const PaperTable& t) {
    std::vector<PaperField> out;
    for (const auto& text : t.head) out.emplace_back(text);
    if (out.empty()) out.resize(t.widths.size());  // Markdown has no table without a head
    return out;
}

/// A note, with its names in mathematics and the rest written by `text`.
std::string note_with_names(std::string_view rest, std::string (*text)(const std::string&)) {
    std::string out;
    for (bool inside = false;; inside = !inside) {
        const auto end = rest.find('`');
        const auto part = rest.substr(0, end);
        out += inside ? "$" + typeset_name(part) + "$" : text(std::string(part));
        if (end == rest.npos) return out;
        rest.remove_prefix(end + 1);
    }
}

std::string markdown(const PaperTable& t) {
    std::string out = t.title.empty() ? "\n" : fmt::format("\n## {}\n\n", t.title);
    out += row_of_table(head_of(t), markdown_field, "| ", " | ", " |\n") + "|";
    for (std::size_t i = 0; i < t.widths.size(); ++i) out += "---|";
    out += "\n";
    for (const auto& fields : t.rows) out += row_of_table(fields, markdown_field, "| ", " | ", " |\n");
    return out;
}

std::string latex(const PaperTable& t) {
    std::string columns;
    for (const double width : t.widths)
        columns +=
            fmt::format(">{{\\raggedright\\arraybackslash}}p{{\\dimexpr{}\\linewidth-2\\tabcolsep}}", width);
    std::string out = fmt::format("\\begin{{longtable}}[l]{{@{{}}{}@{{}}}}\n", columns);
    if (!t.title.empty())
        out += fmt::format("\\multicolumn{{{}}}{{@{{}}l}}{{\\textbf{{{}}}}}\\\\\n", t.widths.size(), t.title);
    out += "\\toprule\n";
    // A head is repeated on each page.
    if (!t.head.empty())
        out += row_of_table(head_of(t), latex_field, "", " & ", " \\\\\n\\midrule\n\\endhead\n");
    for (const auto& fields : t.rows) out += row_of_table(fields, latex_field, "", " & ", " \\\\\n");
    return out + "\\bottomrule\n\\end{longtable}\n";
}

}  // namespace

std::string as_markdown(const SystemDescription& d) {
    const Paper paper = paper_of(d);
    std::string out = "# " + markdown_text(d.name) + "\n";
    if (!d.notes.empty()) out += "\n" + d.notes + "\n";
    for (const auto& t : paper.tables) out += markdown(t);
    out += "\n## Types\n\n" + note_with_names(paper.note, markdown_text) + "\n";
    for (const auto& t : paper.types) {
        out += fmt::format("\n### {}\n", markdown_text(t.title));
        if (!t.doc.empty()) out += fmt::format("\n{}\n", markdown_text(t.doc));
        for (const auto& e : t.equations) out += fmt::format("\n$$\n{}\n$$\n", e);
        if (!t.values.rows.empty()) out += markdown(t.values);
    }
    return out;
}

std::string as_latex(const SystemDescription& d) {
    const Paper paper = paper_of(d);
    std::string out =
        "% \\usepackage[T1]{fontenc}\n% \\usepackage{amsmath,array,booktabs,longtable}\n"
        "{\\footnotesize\\setlength\\tabcolsep{3pt}\\setlength\\parindent{0pt}\\raggedright\n";
    for (const auto& t : paper.tables) out += latex(t);
    out += "\\textbf{Types}\\par\\nopagebreak\\smallskip\\nopagebreak\n" +
           note_with_names(paper.note, latex_text) + "\\par\n";
    for (const auto& t : paper.types) {
        out += fmt::format("\\medskip\\textbf{{{}}}{}\\par\\nopagebreak\n", latex_text(t.title),
                           t.doc.empty() ? "" : " " + latex_text(t.doc));
        // In the line, so that TeX can divide an equation that is wider than the text.
        for (const auto& e : t.equations)
            out += fmt::format(
                "\\smallskip\\hangindent3em\\hangafter1\\hspace*{{1.5em}}$\\displaystyle {}$\\par\n", e);
        if (!t.values.rows.empty()) out += latex(t.values);
    }
    return out + "}\n";
}

}  // namespace forage
