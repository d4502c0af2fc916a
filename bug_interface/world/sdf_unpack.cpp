#include "bug_interface/world/sdf_unpack.h"

#include <cmath>

#include <fmt/format.h>

namespace forage::bug {
namespace {

using xml::SourceElement;

/// Whether a model is fixed and of links only, several of them, none of which is a floor.
bool is_divisible(const ItemElement& body) {
    if (!body.element || body.element->name != "model" || !all(*body.element, "plane").empty()) return false;
    std::size_t links = 0;
    for (const auto& e : body.element->children) {
        links += e.name == "link";
        if (e.name != "link" && e.name != "pose" && e.name != "static") return false;
    }
    const auto pose = pose_of(body.text, *body.element);
    return links > 1 && pose.roll == 0 && pose.pitch == 0;
}

/// The lines at one indentation; the first follows what stands before it.
std::string joined(const std::vector<std::string>& lines, std::string_view indentation,
                   const xml::Layout& layout) {
    std::string out;
    for (const auto& line : lines) {
        if (!out.empty()) out += layout.newline + std::string(layout.newline.empty() ? "" : indentation);
        out += line;
    }
    return out;
}

/// How elements are laid out in the place of `e`.
struct Place {
    std::string_view indentation;
    xml::Layout layout;
};
Place place_of(std::string_view text, const WorldTree& tree, const SourceElement& e) {
    const auto start = xml::line_start(text, e.whole.begin);
    return {start.indentation, start.alone ? tree.layout : xml::Layout{"", ""}};
}

}  // namespace

bool may_unpack(std::string_view text, const Entry& e) {
    if (!e.body.element) return false;
    return e.form == Entry::Form::include ||
           (e.form == Entry::Form::model && is_true(text, child(*e.element, "static")) &&
            is_divisible(e.body));
}

std::string with_own_model(const std::string& text, const WorldTree& tree, const Entry& e) {
    const auto& model = *e.body.element;
    const auto layout = xml::layout_of(e.body.text, e.body.root);
    SdfEdit to{e.body.text, layout};
    if (const auto* name = model.attribute("name"))
        to.edits.replace(name->whole, fmt::format("name=\"{}\"", xml::encoded(e.name)));
    for (const char* element : {"pose", "static"}) {  // those of the <include> count
        const auto* set = child(*e.element, element);
        if (!set) continue;
        if (const auto* own = child(model, element))
            to.edits.replace(own->whole, std::string(set->whole.of(text)));
        else
            to.insert(model, nullptr, set->whole.of(text));
    }
    for (const auto& plugin : e.element->children)
        if (plugin.name == "plugin") to.append(model, plugin.whole.of(text));
    const auto file = to.applied();
    const auto root = xml::scan(file);
    const auto* own = &root.children[static_cast<std::size_t>(&model - e.body.root.children.data())];
    const auto place = place_of(text, tree, *e.element);
    xml::TextEdits out;
    out.replace(e.element->whole, xml::rendered(file, *own, place.indentation, place.layout));
    return out.applied(text);
}

std::string split_model(const std::string& text, const WorldTree& tree, const Entry& e,
                        std::set<std::string> taken, std::size_t& count) {
    count = 1;
    if (e.form != Entry::Form::model || !may_unpack(text, e)) return text;
    const auto place = place_of(text, tree, *e.element);
    const auto at = e.pose(text);
    std::vector<std::string> lines;
    std::size_t done = e.element->tag.end;  // up to here, everything is in `lines`
    count = 0;
    const auto comments_until = [&](std::size_t end) {
        for (const auto& comment : e.element->comments)
            if (comment.begin >= done && comment.end <= end) lines.emplace_back(comment.of(text));
    };
    for (const auto& link : e.element->children) {
        if (link.name != "link") continue;
        comments_until(link.whole.begin);
        done = link.whole.end, ++count;
        const auto stem = fmt::format("{}_{}", e.name, decoded(link.value("name")));
        std::string name = stem;
        for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}_{}", stem, n);
        // The model is turned and placed in the plane; the height and the tilt stay in the link.
        const auto in = pose_of(text, link);
        const double c = std::cos(at.yaw), s = std::sin(at.yaw);
        xml::TextEdits edits;
        if (const auto* pose = child(link, "pose")) {
            edits.replace({pose->whole.begin - link.whole.begin, pose->whole.end - link.whole.begin},
                          fmt::format("<pose>0 0 {} {} {} 0</pose>", number_text(in.z), number_text(in.roll),
                                      number_text(in.pitch)));
        }
        const auto model =
            fmt::format("<model name=\"{}\"><pose>{} {} {} 0 0 {}</pose><static>true</static>{}</model>",
                        xml::encoded(name), number_text(at.x + c * in.x - s * in.y),
                        number_text(at.y + s * in.x + c * in.y), number_text(at.z),
                        number_text(at.yaw + in.yaw), edits.applied(link.whole.of(text)));
        const auto root = xml::scan(model);
        lines.push_back(xml::rendered(model, root, place.indentation, place.layout));
    }
    comments_until(e.element->whole.end);
    xml::TextEdits out;
    out.replace(e.element->whole, joined(lines, place.indentation, place.layout));
    if (e.state) out.cut(text, e.state->whole);
    return out.applied(text);
}

}  // namespace forage::bug
