#include "core/xml/canvas.h"

#include <charconv>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "core/xml/source_tree.h"

namespace forage::xml {
namespace {

constexpr std::string_view canvas_blanks = " \t\r\n", canvas_prefix = "forage:";

std::optional<int> canvas_number(std::string_view text, int lowest = -model::farthest_coordinate) {
    int out = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error != std::errc() || end != text.data() + text.size() || out < lowest ||
        out > model::farthest_coordinate)
        return std::nullopt;
    return out;
}

std::optional<std::vector<model::Point>> canvas_points(std::string_view list) {
    std::vector<model::Point> out;
    while (true) {
        const auto from = list.find_first_not_of(canvas_blanks);
        if (from == list.npos) return out;
        list.remove_prefix(from);
        const auto word = list.substr(0, list.find_first_of(canvas_blanks));
        list.remove_prefix(word.size());
        const auto comma = std::min(word.find(','), word.size() - 1);
        const auto x = canvas_number(word.substr(0, comma)), y = canvas_number(word.substr(comma + 1));
        if (!x || !y) return std::nullopt;
        out.push_back({*x, *y, {}});
    }
}

/// The attributes of an element, of which canvas_part_of() takes those that it knows.
struct CanvasAttributes {
    const tinyxml2::XMLElement& element;
    int taken = 0;
    bool right = true;

    std::string text(const char* name, bool required = true) {
        const char* value = element.Attribute(name);
        taken += value != nullptr;
        right &= value || !required;
        return value ? value : "";
    }
    int number(const char* name, int lowest = -model::farthest_coordinate) {
        const auto value = canvas_number(text(name), lowest);
        right &= value.has_value();
        return value.value_or(0);
    }
    bool done() const {
        int all = 0;
        for (const auto* a = element.FirstAttribute(); a; a = a->Next()) ++all;
        return right && taken == all;
    }
};

std::optional<CanvasPart> canvas_part_of(CanvasAttributes in) {
    const std::string_view name = in.element.Name();
    std::optional<CanvasPart> out;
    if (name == "forage:comment") {
        model::CanvasComment c;
        c.id = in.text("id");
        c.box = {in.number("x"), in.number("y"), in.number("width", 1), in.number("height", 1)};
        c.color = in.text("color", false), c.text = in.text("text", false);
        out = std::move(c);
    } else if (name == "forage:phantom") {
        out = model::Phantom{in.text("group"), in.number("x"), in.number("y")};
    } else if (name == "forage:vertices") {
        const auto page = in.text("page");
        auto list = canvas_points(in.text("points"));
        if ((page == "source" || page == "target") && list)
            out = PageVertices{page == "source", *std::move(list)};
    }
    return in.done() ? out : std::nullopt;
}

std::string canvas_attribute(std::string_view name, std::string_view value) {
    std::string inside = encoded(value);
    // Two hyphens would end the comment. A carriage return would be read as a line feed.
    for (std::size_t at = 0; (at = inside.find_first_of("-\r'", at)) != inside.npos; ++at)
        if (inside[at] == '\r')
            inside.replace(at, 1, "&#13;");
        else if (inside[at] == '\'')
            inside.replace(at, 1, "&apos;");
        else if (at > 0 && inside[at - 1] == '-')
            inside.replace(at, 1, "&#45;");
    return fmt::format(" {}=\"{}\"", name, inside);
}
std::string canvas_attribute(std::string_view name, int value) {
    return canvas_attribute(name, std::to_string(value));
}

std::string written(const model::CanvasComment& c) {
    std::string out = " forage:comment" + canvas_attribute("id", c.id) + canvas_attribute("x", c.box.x) +
                      canvas_attribute("y", c.box.y) + canvas_attribute("width", c.box.width) +
                      canvas_attribute("height", c.box.height);
    if (!c.color.empty()) out += canvas_attribute("color", c.color);
    return out + canvas_attribute("text", c.text) + " ";
}
std::string written(const model::Phantom& p) {
    return " forage:phantom" + canvas_attribute("group", p.group) + canvas_attribute("x", p.x) +
           canvas_attribute("y", p.y) + " ";
}
std::string written(const PageVertices& v) {
    std::string list;
    for (const auto& p : v.points) list += fmt::format("{}{},{}", list.empty() ? "" : " ", p.x, p.y);
    return " forage:vertices" + canvas_attribute("page", v.of_source ? "source" : "target") +
           canvas_attribute("points", list) + " ";
}

}  // namespace

bool begins_canvas_part(std::string_view comment) {
    comment.remove_prefix(std::min(comment.find_first_not_of(canvas_blanks), comment.size()));
    return comment.starts_with(canvas_prefix);
}

std::optional<CanvasPart> read_canvas_part(std::string_view comment) {
    if (!begins_canvas_part(comment)) return std::nullopt;
    comment.remove_prefix(comment.find_first_not_of(canvas_blanks));
    comment = comment.substr(0, comment.find_last_not_of(canvas_blanks) + 1);
    const std::string element = fmt::format("<{}/>", comment);
    tinyxml2::XMLDocument document;
    if (document.Parse(element.data(), element.size()) != tinyxml2::XML_SUCCESS) return std::nullopt;
    const auto* root = document.RootElement();
    if (!root || root != document.LastChild() || root->FirstChild()) return std::nullopt;
    return canvas_part_of({*root});
}

std::string write_canvas_part(const CanvasPart& part) {
    return std::visit([](const auto& p) { return written(p); }, part);
}

std::string canvas_forms() {
    return "there are forage:comment with id, x, y, width, height, color and text in a <System> or "
           "<Process>, forage:phantom with group, x and y in a <Process>, and forage:vertices with page and "
           "points in a <DiagramLine>";
}

}  // namespace forage::xml
