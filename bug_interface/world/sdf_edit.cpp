#include "bug_interface/world/sdf_edit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "bug_interface/world/sdf_format.h"
#include "core/base/number.h"
#include "core/xml/check.h"
#include "core/xml/source_tree.h"

namespace forage::bug {
namespace {

using xml::SourceElement;
using xml::Span;

const SourceElement* child(const SourceElement& e, std::string_view name) {
    const auto it = std::ranges::find(e.children, name, &SourceElement::name);
    return it == e.children.end() ? nullptr : &*it;
}

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
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

/// A length or angle, to a micrometre.
std::string number(double value) {
    if (!std::isfinite(value) || std::abs(value) > 1e6)
        throw std::invalid_argument("a place or a size is a number from -1e6 to 1e6");
    return fmt::format("{}", std::round(value * 1e6) / 1e6 + 0.0);
}

std::string_view content(std::string_view text, const SourceElement* e) {
    return e ? trimmed(e->content.of(text)) : std::string_view();
}

std::string name_of(std::string_view text, const SourceElement& e) {
    if (e.name != "include") return decoded(e.value("name"));
    const auto name = content(text, child(e, "name"));
    if (!name.empty()) return decoded(name);
    const auto uri = content(text, child(e, "uri"));  // then it has the name of its model
    return decoded(uri.substr(std::min(uri.rfind('/') + 1, uri.size())));
}

/// The words of a list with the places at which they stand in the text.
std::vector<Span> words(std::string_view text, Span span) {
    std::vector<Span> out;
    for (auto at = text.find_first_not_of(" \t\r\n", span.begin); at < span.end;
         at = text.find_first_not_of(" \t\r\n", at)) {
        const auto end = std::min(text.find_first_of(" \t\r\n", at), span.end);
        out.push_back({at, end});
        at = end;
    }
    return out;
}

std::vector<double> numbers(std::string_view text, const SourceElement* e) {
    std::vector<double> out;
    if (e)
        for (const Span& w : words(text, e->content))
            out.push_back(parse_number<double>(w.of(text)).value_or(0));
    return out;
}

/// The elements with this name at any depth.
void collect(const SourceElement& e, std::string_view name, std::vector<const SourceElement*>& out) {
    for (const auto& c : e.children) {
        if (c.name == name) out.push_back(&c);
        collect(c, name, out);
    }
}
std::vector<const SourceElement*> all(const SourceElement& e, std::string_view name) {
    std::vector<const SourceElement*> out;
    collect(e, name, out);
    return out;
}

/// The element <world>, in the file's tree.
const SourceElement* world_of(const SourceElement& root) {
    return root.name == "world" ? &root : child(root, "world");
}

bool is_item(const SourceElement& e) { return e.name == "include" || e.name == "model" || e.name == "light"; }

std::string kind_of(std::string_view text, const SourceElement& e, const WorldItem& item) {
    const auto says = [&](std::string_view word) {
        return item.uri.find(word) != std::string::npos || item.name.find(word) != std::string::npos;
    };
    if (item.name.starts_with("Reset_")) return "start";
    if (e.name == "light" || says("sun")) return "sun";
    if (says("loor") || says("round")) return "floor";
    if (e.name == "include") {
        if (says("arget") || says("ight")) return "light";
        if (says("wall") || says("Wall")) return "wall";
        return says("bug") || says("Bug") ? "robot" : "other";
    }
    for (const auto* plugin : all(e, "plugin"))
        if (plugin->value("filename") == "libvel_plugin.so") return "robot";
    if (content(text, child(e, "static")) != "true" && content(text, child(e, "static")) != "1")
        return "object";
    if (all(e, "collision").empty()) return "patch";
    return says("arget") ? "light" : "wall";
}

struct Found {
    SourceElement root;
    const SourceElement* item;
};

Found found(const std::string& text, std::string_view name) {
    Found out{xml::scan(text), nullptr};
    if (const auto* world = world_of(out.root))
        for (const auto& e : world->children)
            if (is_item(e) && name_of(text, e) == name) {
                out.item = &e;
                return out;
            }
    throw std::invalid_argument(fmt::format("nothing in the world is called '{}'", name));
}

std::string colour(const std::string& text) {
    const auto hex = [&](std::size_t at) {
        unsigned value = 0;
        for (const char c : text.substr(at, 2)) {
            if (!std::isxdigit(static_cast<unsigned char>(c)))
                throw std::invalid_argument(fmt::format("'{}' is not a colour such as #ff8000", text));
            value = value * 16 + static_cast<unsigned>(c <= '9' ? c - '0' : (c | 32) - 'a' + 10);
        }
        return value / 255.0;
    };
    if (text.size() != 7 || text[0] != '#')
        throw std::invalid_argument(fmt::format("'{}' is not a colour such as #ff8000", text));
    return fmt::format("{:.3g} {:.3g} {:.3g} 1", hex(1), hex(3), hex(5));
}

struct Body {
    std::string geometry, pose;  ///< of both
    bool collides = true, paints = true, moves = false;
};

std::string model_text(const NewItem& item, const Body& body) {
    const std::string name = xml::encoded(item.name), colours = colour(item.color);
    std::string out = fmt::format("<model name=\"{}\"><pose>{} {} 0 0 0 {}</pose>", name, number(item.x),
                                  number(item.y), number(item.yaw));
    if (!body.moves) out += "<static>true</static>";
    out += fmt::format("<link name=\"body\"><pose>{}</pose>", body.pose);
    if (body.moves) out += "<inertial><mass>0.05</mass></inertial>";
    if (body.collides)
        out +=
            fmt::format("<collision name=\"collision\"><geometry>{}</geometry></collision>", body.geometry);
    if (body.paints)
        out += fmt::format(
            "<visual "
            "name=\"visual\"><geometry>{}</geometry><material><ambient>{}</ambient><diffuse>{}</diffuse>"
            "</material></visual>",
            body.geometry, colours, colours);
    return out + "</link></model>";
}

std::string included(const NewItem& item, const std::string& uri) {
    return fmt::format("<include><name>{}</name><uri>{}</uri><pose>{} {} 0 0 0 {}</pose></include>",
                       xml::encoded(item.name), xml::encoded(uri), number(item.x), number(item.y),
                       number(item.yaw));
}

std::string item_text(const NewItem& item) {
    const auto box = [&](const char* height) {
        return fmt::format("<box><size>{} {} {}</size></box>", number(item.width), number(item.depth),
                           height);
    };
    const auto radius = number(item.radius);
    const auto cylinder = [&](const char* length) {
        return fmt::format("<cylinder><radius>{}</radius><length>{}</length></cylinder>", radius, length);
    };
    if (item.kind == "wall") return model_text(item, {box("0.25"), "0 0 0.125 0 0 0"});
    if (item.kind == "pillar") return model_text(item, {cylinder("0.25"), "0 0 0.125 0 0 0"});
    // A patch is paint just above the floor.
    if (item.kind == "patch") return model_text(item, {box("0.002"), "0 0 0.002 0 0 0", false});
    if (item.kind == "ball")
        return model_text(item, {fmt::format("<sphere><radius>{}</radius></sphere>", radius),
                                 fmt::format("0 0 {} 0 0 0", radius), true, true, true});
    if (item.kind == "light") return included(item, "model://target");
    if (item.kind == "start") return included(item, "model://start_disc");
    if (item.kind == "robot") return included(item, item.uri);
    throw std::invalid_argument(fmt::format("'{}' is not a kind of item", item.kind));
}

}  // namespace

std::vector<std::string> kinds_of_items() {
    return {"wall", "pillar", "patch", "ball", "light", "start", "robot"};
}

std::vector<WorldItem> items_of_world(std::string_view text) {
    std::vector<WorldItem> out;
    const auto root = xml::scan(text);
    const auto* world = world_of(root);
    if (!world) return out;
    for (const auto& e : world->children) {
        if (!is_item(e)) continue;
        WorldItem item;
        item.name = name_of(text, e);
        item.uri = decoded(content(text, child(e, "uri")));
        if (auto pose = numbers(text, child(e, "pose")); pose.size() == 6)
            item.x = pose[0], item.y = pose[1], item.z = pose[2], item.yaw = pose[5];
        item.kind = kind_of(text, e, item);
        const auto geometries = all(e, "geometry");
        if (!geometries.empty() && !geometries.front()->children.empty()) {
            const auto& form = geometries.front()->children.front();
            const auto size = numbers(text, child(form, "size"));
            if (form.name == "box" && size.size() == 3)
                item.size = {size[0], size[1]};
            else if (form.name == "cylinder" || form.name == "sphere")
                item.size = numbers(text, child(form, "radius"));
        }
        out.push_back(std::move(item));
    }
    return out;
}

std::string add_to_world(const std::string& text, NewItem item, std::string& name) {
    const auto items = items_of_world(text);
    const auto taken = [&](const std::string& wanted) {
        return std::ranges::any_of(items, [&](const auto& i) { return i.name == wanted; });
    };
    if (item.name.empty()) {
        const bool start = item.kind == "start";
        std::string stem = start ? "Reset_" : item.kind;
        if (!start && !stem.empty())
            stem[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(stem[0])));
        int n = start ? 0 : 1;
        do item.name = start ? fmt::format("{}{}", stem, n) : n == 1 ? stem : fmt::format("{}_{}", stem, n);
        while (++n, taken(item.name));
    }
    if (taken(item.name)) throw std::invalid_argument(fmt::format("there is already a '{}'", item.name));
    const std::string added = item_text(item);
    const auto root = xml::scan(text);
    const auto* world = world_of(root);
    if (!world) throw std::invalid_argument("the file has no <world>");
    const SourceElement* after = nullptr;
    for (const auto& e : world->children)
        if (is_item(e)) after = &e;
    const auto piece = xml::scan(added);
    xml::TextEdits edits;
    xml::insert_into(edits, text, *world, after, xml::layout_of(text, root), {{added, &piece}});
    name = item.name;
    return edits.applied(text);
}

std::string removed_from_world(const std::string& text, std::string_view name) {
    const auto here = found(text, name);
    xml::TextEdits edits;
    edits.cut(text, here.item->whole);
    return edits.applied(text);
}

std::string moved_in_world(const std::string& text, std::string_view name, double x, double y,
                           std::optional<double> yaw) {
    const auto here = found(text, name);
    xml::TextEdits edits;
    const auto* pose = child(*here.item, "pose");
    const auto old = pose ? words(text, pose->content) : std::vector<Span>();
    if (old.size() == 6) {
        const auto set = [&](std::size_t i, double value) {
            if (parse_number<double>(old[i].of(text)) != value) edits.replace(old[i], number(value));
        };
        set(0, x), set(1, y);
        if (yaw) set(5, *yaw);
    } else {
        const std::string added =
            fmt::format("<pose>{} {} 0 0 0 {}</pose>", number(x), number(y), number(yaw.value_or(0)));
        if (pose) {
            edits.replace(pose->whole, added);
        } else {
            const auto piece = xml::scan(added);
            const SourceElement* last = nullptr;
            if (here.item->name == "include" && !here.item->children.empty())
                last = &here.item->children.back();
            xml::insert_into(edits, text, *here.item, last, xml::layout_of(text, here.root),
                             {{added, &piece}});
        }
    }
    return edits.applied(text);
}

std::string resized_in_world(const std::string& text, std::string_view name,
                             const std::vector<double>& size) {
    const auto here = found(text, name);
    for (const double s : size)
        if (!(s > 0)) throw std::invalid_argument("a size is above 0");
    xml::TextEdits edits;
    for (const auto* geometry : all(*here.item, "geometry"))
        for (const auto& form : geometry->children) {
            if (form.name == "box" && size.size() == 2) {
                if (const auto* extent = child(form, "size")) {
                    const auto old = words(text, extent->content);
                    for (std::size_t i = 0; i < 2 && old.size() == 3; ++i)
                        edits.replace(old[i], number(size[i]));
                }
            } else if (form.name != "box" && size.size() == 1) {
                if (const auto* radius = child(form, "radius"))
                    edits.replace(radius->content, number(size[0]));
            }
        }
    if (edits.empty())
        throw std::invalid_argument(
            fmt::format("'{}' has no such size in this file", name) +
            (here.item->name == "include" ? ": the size of an included model is that of its file" : ""));
    return edits.applied(text);
}

std::string renamed_in_world(const std::string& text, std::string_view name, const std::string& new_name) {
    const auto here = found(text, name);
    for (const auto& i : items_of_world(text))
        if (i.name == new_name) throw std::invalid_argument(fmt::format("there is already a '{}'", new_name));
    xml::TextEdits edits;
    if (here.item->name != "include") {
        if (const auto* a = here.item->attribute("name")) edits.replace(a->inside, xml::encoded(new_name));
    } else if (const auto* e = child(*here.item, "name")) {
        edits.replace(e->content, xml::encoded(new_name));
    } else {
        const std::string added = "<name>" + xml::encoded(new_name) + "</name>";
        const auto piece = xml::scan(added);
        xml::insert_into(edits, text, *here.item, nullptr, xml::layout_of(text, here.root),
                         {{added, &piece}});
    }
    return edits.applied(text);
}

void check_world_text(const std::string& path, const std::string& text, Diagnostics& diagnostics) {
    if (const auto document = xml::open(path, text, sdf_format(), diagnostics))
        xml::check(*document, sdf_format(), diagnostics);
}

}  // namespace forage::bug
