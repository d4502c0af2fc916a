#include "core/xml/canvas.h"

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/names.h"
#include "core/xml/check.h"
#include "core/xml/source_tree.h"
#include "core/xml/system_elements.h"

namespace forage::xml {
namespace {

/// The parts with their attributes in the order in which they are written. The doc of a part says where it
/// stands.
struct CanvasElements {
    using Comment = model::CanvasComment;
    ElementRow id = element<Comment>({}, {{&Comment::id, required(text("id", ""))}});
    ElementRow box = element<model::Icon>({}, {{&model::Icon::x, coordinate("x", "")},
                                               {&model::Icon::y, coordinate("y", "")},
                                               {&model::Icon::width, required(whole("width", "", 1))},
                                               {&model::Icon::height, required(whole("height", "", 1))}});
    ElementRow look = element<Comment>(
        {}, {{&Comment::color, omit_default(text("color", ""))}, {&Comment::text, text("text", "")}});
    ElementRow phantom = element<model::Phantom>({"forage:phantom", "in a <Process>"},
                                                 {{&model::Phantom::group, required(text("group", ""))},
                                                  {&model::Phantom::x, coordinate("x", "")},
                                                  {&model::Phantom::y, coordinate("y", "")}});
    ElementRow vertices = element<PageVertices>(
        {"forage:vertices", "in a <DiagramLine>"},
        {{&PageVertices::of_target, required(choice("page", "", {"source", "target"}))}},
        {required(text("points", ""))});
    Format format = [this] {
        ElementRule comment{"forage:comment", "in a <System> or <Process>"};
        for (const auto* row : {&id, &box, &look})
            comment.attributes.insert(comment.attributes.end(), row->rule.attributes.begin(),
                                      row->rule.attributes.end());
        return Format{.name = "a part of the diagram", .elements = {comment, phantom.rule, vertices.rule}}
            .link();
    }();
};

const CanvasElements& canvas() {
    static const CanvasElements elements;
    return elements;
}

std::optional<std::vector<model::Point>> canvas_points(std::string_view list) {
    std::vector<model::Point> out;
    for (const auto word : words(list)) {
        const auto comma = std::min(word.find(','), word.size() - 1);
        const auto x = parse_number<int>(word.substr(0, comma)),
                   y = parse_number<int>(word.substr(comma + 1));
        for (const auto& v : {x, y})
            if (!v || *v < -model::farthest_coordinate || *v > model::farthest_coordinate)
                return std::nullopt;
        out.push_back({*x, *y, {}});
    }
    return out;
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
template <class Struct>
std::string canvas_attributes(const ElementRow& element, const Struct& s) {
    std::string out;
    for (const auto& a : element.attributes)
        if (const auto value = value_of(a, s); !a.rule.omit_default || value != value_of(a, Struct()))
            out += canvas_attribute(a.rule.name, to_text(value));
    return out;
}

std::string written(const model::CanvasComment& c) {
    return "forage:comment" + canvas_attributes(canvas().id, c) + canvas_attributes(canvas().box, c.box) +
           canvas_attributes(canvas().look, c);
}
std::string written(const model::Phantom& p) {
    return canvas().phantom.rule.name + canvas_attributes(canvas().phantom, p);
}
std::string written(const PageVertices& v) {
    std::string list;
    for (const auto& p : v.points) list += fmt::format("{}{},{}", list.empty() ? "" : " ", p.x, p.y);
    return canvas().vertices.rule.name + canvas_attributes(canvas().vertices, v) +
           canvas_attribute("points", list);
}

}  // namespace

bool begins_canvas_part(std::string_view comment) { return model::trim(comment).starts_with("forage:"); }

std::optional<CanvasPart> read_canvas_part(std::string_view comment) {
    if (!begins_canvas_part(comment)) return std::nullopt;
    Diagnostics mistakes;
    const auto document =
        Document::parse({{}, fmt::format("<{}/>", model::trim(comment))}, {}, 100, mistakes);
    const auto e = document ? document->root() : Element();
    const auto* rule = e ? canvas().format.find(e.name()) : nullptr;
    if (!rule || !check(e, *rule, canvas().format, mistakes) || mistakes.failed()) return std::nullopt;
    if (rule->name == canvas().phantom.rule.name) {
        model::Phantom phantom;
        canvas().phantom.read(e, phantom);
        return phantom;
    }
    if (rule->name == canvas().vertices.rule.name) {
        PageVertices vertices;
        canvas().vertices.read(e, vertices);
        auto points = canvas_points(e["points"].view);
        if (!points) return std::nullopt;
        vertices.points = *std::move(points);
        return vertices;
    }
    model::CanvasComment out;
    canvas().id.read(e, out), canvas().box.read(e, out.box), canvas().look.read(e, out);
    return out;
}

std::string write_canvas_part(const CanvasPart& part) {
    return " " + std::visit([](const auto& p) { return written(p); }, part) + " ";
}

std::string canvas_forms() {
    std::vector<std::string> forms;
    for (const auto& e : canvas().format.elements) {
        auto names = names_of(e.attributes);
        const auto last = names.back();
        names.pop_back();
        forms.push_back(fmt::format("{} with {} and {} {}", e.name, separated(names, ", "), last, e.doc));
    }
    return fmt::format("there are {}, {}, and {}", forms[0], forms[1], forms[2]);
}

}  // namespace forage::xml
