#include "bug_interface/world/sdf_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/sequence.h"
#include "core/xml/document.h"

namespace forage::bug {
namespace {

using xml::SourceElement;
using xml::Span;

constexpr std::string_view blanks = " \t\r\n";

void collect(const SourceElement& e, std::string_view name, std::vector<const SourceElement*>& out) {
    for (const auto& c : e.children) {
        if (c.name == name) out.push_back(&c);
        collect(c, name, out);
    }
}

/// Takes the first word of a path off it.
std::string_view take_word(std::string_view& path) {
    const auto end = std::min(path.find('/'), path.size());
    const auto out = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));
    return out;
}

}  // namespace

const SourceElement* child(const SourceElement& e, std::string_view name) {
    return find_by(e.children, name, &SourceElement::name);
}

const SourceElement* at_path(const SourceElement& e, std::string_view path) {
    const auto* out = &e;
    while (out && !path.empty()) {
        const auto word = take_word(path);
        out = child(*out, word.substr(0, word.find(' ')));
    }
    return out;
}

std::vector<const SourceElement*> all(const SourceElement& e, std::string_view name) {
    std::vector<const SourceElement*> out;
    collect(e, name, out);
    return out;
}

std::string_view content(std::string_view text, const SourceElement* e) {
    if (!e) return {};
    const auto inside = e->content.of(text);
    const auto first = inside.find_first_not_of(blanks);
    if (first == inside.npos) return {};
    return inside.substr(first, inside.find_last_not_of(blanks) + 1 - first);
}

bool is_true(std::string_view text, const SourceElement* e) {
    const auto value = content(text, e);
    return value == "true" || value == "1";
}

std::string decoded(std::string_view text) {
    std::string out(text);
    for (const auto& [entity, character] : {std::pair<std::string_view, std::string_view>{"&lt;", "<"},
                                            {"&gt;", ">"},
                                            {"&quot;", "\""},
                                            {"&apos;", "'"},
                                            {"&amp;", "&"}})
        for (auto at = out.find(entity); at != out.npos; at = out.find(entity, at + 1))
            out.replace(at, entity.size(), character);
    return out;
}

std::vector<Span> words(std::string_view text, Span span) {
    std::vector<Span> out;
    for (const auto word : xml::words(span.of(text))) {
        const auto begin = static_cast<std::size_t>(word.data() - text.data());
        out.push_back({begin, begin + word.size()});
    }
    return out;
}

std::vector<double> numbers_in(std::string_view text, const SourceElement* e) {
    std::vector<double> out;
    if (e)
        for (const Span& w : words(text, e->content))
            out.push_back(parse_number<double>(w.of(text)).value_or(0));
    return out;
}

std::string number_text(double value) {
    if (!std::isfinite(value) || std::abs(value) > 1e6)
        throw std::invalid_argument("a number of a world is from -1e6 to 1e6");
    return fmt::format("{}", std::round(value * 1e9) / 1e9 + 0.0);
}

PoseText pose_of(std::string_view text, const SourceElement& parent) {
    const auto* e = child(parent, "pose");
    const auto v = numbers_in(text, e);
    if (v.size() == 7) {  // a quaternion x y z w
        const double x = v[3], y = v[4], z = v[5], w = v[6];
        return {v[0],
                v[1],
                v[2],
                std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
                std::asin(std::clamp(2 * (w * y - z * x), -1., 1.)),
                std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))};
    }
    if (v.size() != 6) return {};
    const auto degrees = e->value("degrees");
    const double unit = degrees == "true" || degrees == "1" ? std::numbers::pi / 180 : 1;
    return {v[0], v[1], v[2], unit * v[3], unit * v[4], unit * v[5]};
}

void SdfEdit::insert(const SourceElement& parent, const SourceElement* after, std::string_view added) {
    const auto piece = xml::scan(added);
    xml::insert_into(edits, text, parent, after, layout, {{added, &piece}});
}

void SdfEdit::set_value(const SourceElement& parent, std::string_view path, std::string_view value) {
    const auto* e = &parent;
    std::string_view word;
    for (std::string_view rest = path; !rest.empty(); path = rest) {
        word = take_word(rest);
        const auto* next = child(*e, word.substr(0, word.find(' ')));
        if (!next) break;
        e = next;
    }
    if (path.empty()) {
        if (e->closed)
            edits.replace(e->content, std::string(value));
        else
            edits.replace(e->whole, fmt::format("<{0}>{1}</{0}>", e->name, value));
        return;
    }
    std::string before, after;
    while (!path.empty()) {
        word = take_word(path);
        before += fmt::format("<{}>", word);
        after = fmt::format("</{}>", word.substr(0, word.find(' '))) + after;
    }
    append(*e, before + std::string(value) + after);
}

void SdfEdit::set_pose(const SourceElement& parent, const PoseText& pose) {
    const auto* e = child(parent, "pose");
    const auto old = e ? words(text, e->content) : std::vector<Span>();
    const auto was = pose_of(text, parent);
    if (old.size() != 6 && old.size() != 7) {
        const std::string value = fmt::format("{} {} {} 0 0 {}", number_text(pose.x), number_text(pose.y),
                                              number_text(pose.z), number_text(pose.yaw));
        if (e || parent.name == "include") return set_value(parent, "pose", value);
        return insert(parent, nullptr, "<pose>" + value + "</pose>");  // of a model, the first element
    }
    const auto set = [&](std::size_t i, double value) {
        if (parse_number<double>(old[i].of(text)) != value) edits.replace(old[i], number_text(value));
    };
    set(0, pose.x), set(1, pose.y), set(2, pose.z);
    if (pose.yaw == was.yaw) return;
    if (old.size() == 7) {  // turned about the vertical, so that a tilt stays
        const double s = std::sin((pose.yaw - was.yaw) / 2), c = std::cos((pose.yaw - was.yaw) / 2);
        const auto q = numbers_in(text, e);
        set(3, c * q[3] - s * q[4]), set(4, c * q[4] + s * q[3]);
        set(5, c * q[5] + s * q[6]), set(6, c * q[6] - s * q[5]);
    } else {
        const auto degrees = e->value("degrees");
        set(5, degrees == "true" || degrees == "1" ? pose.yaw * 180 / std::numbers::pi : pose.yaw);
    }
}

WorldTree::WorldTree(std::string_view text) : root(xml::scan(text)) {
    world = root.name == "world" ? &root : child(root, "world");
    layout = xml::layout_of(text, root);
}

}  // namespace forage::bug
