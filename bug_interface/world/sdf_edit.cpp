#include "bug_interface/world/sdf_edit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "bug_interface/world/sdf_format.h"
#include "bug_interface/world/sdf_new_items.h"
#include "bug_interface/world/sdf_properties.h"
#include "bug_interface/world/sdf_unpack.h"
#include "core/base/capitalized.h"
#include "core/base/number.h"
#include "core/base/sequence.h"
#include "core/xml/check.h"

namespace forage::bug {
namespace {

using xml::SourceElement;

constexpr const char* ground = "GroundPlane";  ///< the model whose bounds end trials

/// A text as its tree and entries; it must not change meanwhile.
struct Opened {
    Opened(const std::string& text, ModelTexts& models)
        : tree(text), entries(entries_of(text, tree, models)) {}
    WorldTree tree;
    std::vector<Entry> entries;

    const Entry& find(std::string_view id) const {
        const auto it = std::ranges::find(entries, id, &Entry::id);
        if (it == entries.end())
            throw std::invalid_argument(fmt::format("nothing in the world is called '{}'", id));
        return *it;
    }
    bool has(std::string_view name) const { return contains(entries, name, &Entry::name); }
};

std::vector<ItemPart> parts_of(const Entry& e) {
    std::vector<ItemPart> out;
    if (e.body.element && e.body.element->name == "light") return out;
    auto forms = e.kind == "floor" ? std::vector<Form>() : forms_of(e.body, "visual");
    if (forms.empty()) forms = forms_of(e.body, "collision");
    for (const auto& f : forms) {
        ItemPart part{f.pose.x, f.pose.y, f.pose.yaw, extents(e.body.text, *f.shape), {}};
        if (part.size.empty()) continue;
        part.size.resize(f.shape->name == "box" && part.size.size() == 3 ? 2 : 1);
        if (f.owner->name == "visual") part.color = colour_of(e.body.text, *f.owner);
        out.push_back(std::move(part));
    }
    return out;
}

/// A name that nothing in the world has.
std::string free_name(const Opened& here, const std::string& kind) {
    const auto first_free = [&](const std::string& stem, int from, int to) {
        for (int n = from; n < to; ++n)
            if (auto name = fmt::format("{}{}", stem, n); !here.has(name)) return name;
        throw std::invalid_argument(fmt::format("there are already {} of this kind", to - from));
    };
    if (kind == "start") return first_free("Reset_", 0, 10);
    if (kind == "home") {
        for (const char* name : {"Home_A", "Home_B"})
            if (!here.has(name)) return name;
        throw std::invalid_argument("there are already two homes");
    }
    if (kind == "floor") return ground;
    const std::string stem = capitalized(kind);
    return here.has(stem) ? first_free(stem + "_", 2, 100'000) : stem;
}

/// The floor whose bounds hold all items, with room for a robot around them.
NewItem ground_around(const std::vector<WorldItem>& items) {
    constexpr double room = 0.5, step = 0.1, usual = 2.5;
    Eigen::Vector2d reach(usual, usual);
    for (const auto& i : items) {
        if (!i.placed || i.kind == "floor") continue;
        const auto hold = [&](const Eigen::Vector2d& at, const Eigen::Vector2d& half) {
            reach = reach.cwiseMax(at.cwiseAbs() + half + Eigen::Vector2d(room, room));
        };
        const Eigen::Vector2d middle(i.x, i.y);
        hold(middle, {0, 0});
        for (const auto& p : i.parts) {
            const Eigen::Matrix2d turn = Eigen::Rotation2Dd(i.yaw + p.yaw).toRotationMatrix().cwiseAbs();
            const Eigen::Vector2d half = p.size.size() == 1
                                             ? Eigen::Vector2d(p.size[0], p.size[0])
                                             : turn * Eigen::Vector2d(p.size[0], p.size[1]) / 2;
            hold(middle + Eigen::Rotation2Dd(i.yaw) * Eigen::Vector2d(p.x, p.y), half);
        }
    }
    const auto whole = [&](double half) { return 2 * step * std::ceil(half / step); };
    return {.kind = "floor", .name = ground, .width = whole(reach.x()), .depth = whole(reach.y())};
}

/// Reports a start pose that is not inside the bounds of trials, with which the world could not run.
void check_start(const std::vector<WorldItem>& items, const NewItem& start) {
    const auto it = std::ranges::find(items, ground, &WorldItem::name);
    if (it == items.end() || it->parts.empty() || it->yaw != 0) return;
    constexpr double jitter = 0.01;  // of start poses
    const auto& bounds = it->parts.back();
    if (bounds.size.size() != 2) return;
    if (std::abs(start.x - it->x - bounds.x) > bounds.size[0] / 2 - jitter ||
        std::abs(start.y - it->y - bounds.y) > bounds.size[1] / 2 - jitter)
        throw std::invalid_argument(
            fmt::format("a start pose is inside the bounds of {}, {:g} x {:g} m: make them larger first",
                        ground, bounds.size[0], bounds.size[1]));
}

/// Reports what a world has only once.
void check_single(const Opened& here, const std::string& kind) {
    static const std::map<std::string_view, const char*> single = {
        {"sun", "a sun"}, {"game", "rules of a game"}, {"trials", "rules of trials"}};
    const auto found = single.find(kind);
    if (found != single.end() && contains(here.entries, kind, &Entry::kind))
        throw std::invalid_argument(
            fmt::format("there {} already {}", kind == "sun" ? "is" : "are", found->second));
}

/// The value as it is written, when it fits the property.
std::string checked(const ItemProperty& p, const std::string& value) {
    if (p.kind == "color") return colour_text(value), value;
    if (p.kind == "boolean") return value == "1" || value == "true" ? "1" : "0";
    if (p.kind == "text" || p.kind == "choice") {
        if (value.empty()) throw std::invalid_argument(fmt::format("'{}' is empty", p.label));
        return value;
    }
    const auto v = parse_number<double>(value);
    if (!v || (p.low && *v < *p.low) || (p.high && *v > *p.high) ||
        (p.kind == "integer" && *v != std::round(*v)))
        throw std::invalid_argument(
            p.low && p.high ? fmt::format("'{}' is a number from {:g} to {:g}", p.label, *p.low, *p.high)
                            : fmt::format("'{}' is a number", p.label));
    return value;
}

bool same(const ItemProperty& p, const std::string& value) {
    if (p.kind != "number" && p.kind != "integer") return p.value == value;
    return parse_number<double>(p.value) == parse_number<double>(value);
}

}  // namespace

std::vector<WorldItem> items_of_world(std::string_view text, ModelTexts& models) {
    const WorldTree tree(text);
    std::vector<WorldItem> out;
    for (const auto& e : entries_of(text, tree, models)) {
        const auto pose = e.placed() ? e.pose(text) : PoseText();
        out.push_back({e.id, e.name, e.kind, e.placed(), may_unpack(text, e), pose.x, pose.y, pose.z,
                       pose.yaw, parts_of(e), properties_of(text, e, models)});
    }
    return out;
}

std::string add_to_world(const std::string& text, NewItem item, ModelTexts& models, std::string& id) {
    const Opened here(text, models);
    if (!here.tree.world) throw std::invalid_argument("the file has no <world>");
    check_single(here, item.kind);
    if (item.kind == "start") check_start(items_of_world(text, models), item);
    if (item.name.empty()) item.name = free_name(here, item.kind);
    if (item.kind != "site" && here.has(item.name))
        throw std::invalid_argument(fmt::format("there is already a '{}'", item.name));
    std::string added = new_item_text(item, contains(here.entries, "floor", &Entry::kind), models);
    const auto game = std::ranges::find(here.entries, Entry::Form::game, &Entry::form);
    const bool site = item.kind == "site", of_game = site && game != here.entries.end();
    if (site && !of_game)
        added = "<plugin name=\"game\" filename=\"libforage_game.so\">" + added + "</plugin>";
    SdfEdit to{text, here.tree.layout};
    const SourceElement* after = nullptr;
    for (const auto& e : here.entries)
        if (e.form != Entry::Form::world && e.form != Entry::Form::site) after = e.element;
    if (of_game)
        to.append(*game->element, added);
    else
        to.insert(*here.tree.world, after, added);
    auto out = to.applied();
    const Opened now(out, models);
    // The new one is the last of its kind in the file.
    for (const auto& e : now.entries)
        if (site || item.kind == "game" || item.kind == "trials" ? e.kind == item.kind : e.name == item.name)
            id = e.id;
    if (item.kind != "start" || now.has(ground)) return out;
    std::string ground_id;
    return add_to_world(out, ground_around(items_of_world(out, models)), models, ground_id);
}

std::string removed_from_world(const std::string& text, std::string_view id, ModelTexts& models) {
    const Opened here(text, models);
    const auto& e = here.find(id);
    if (e.form == Entry::Form::world) throw std::invalid_argument("the world itself cannot be removed");
    xml::TextEdits edits;
    edits.cut(text, e.element->whole);
    if (e.state) edits.cut(text, e.state->whole);
    return edits.applied(text);
}

std::string moved_in_world(const std::string& text, std::string_view id, double x, double y,
                           std::optional<double> yaw, ModelTexts& models) {
    const Opened here(text, models);
    const auto& e = here.find(id);
    if (!e.placed()) throw std::invalid_argument(fmt::format("'{}' has no place", id));
    SdfEdit to{text, here.tree.layout};
    if (e.form == Entry::Form::site) {
        const auto at = words(text, e.element->content);
        if (at.size() >= 2) to.edits.replace(at[0], number_text(x)), to.edits.replace(at[1], number_text(y));
    } else {
        auto pose = e.pose(text);
        pose.x = x, pose.y = y, pose.yaw = yaw.value_or(pose.yaw);
        write_pose(to, e, pose);
    }
    return to.applied();
}

std::string set_in_world(const std::string& text, std::string& id, std::string_view property,
                         const std::string& value, ModelTexts& models) {
    const Opened here(text, models);
    const auto& e = here.find(id);
    const auto index = static_cast<std::size_t>(&e - here.entries.data());
    const auto properties = properties_of(text, e, models);
    const auto p = std::ranges::find(properties, property, &ItemProperty::name);
    if (p == properties.end()) throw std::invalid_argument(fmt::format("'{}' has no '{}'", id, property));
    const auto wanted = checked(*p, value);
    if (same(*p, wanted)) return text;
    if (property == "name" && here.has(wanted))
        throw std::invalid_argument(fmt::format("there is already a '{}'", wanted));
    const auto write = [&](const std::string& from, const Opened& now) {
        SdfEdit to{from, now.tree.layout};
        write_property(to, now.entries[index], *p, wanted);
        return to.applied();
    };
    std::string out;
    if (is_own(e, property)) {
        out = write(text, here);
    } else {
        const auto own = with_own_model(text, here.tree, e);
        out = write(own, Opened(own, models));
    }
    id = Opened(out, models).entries[index].id;
    return out;
}

std::string unpacked_in_world(const std::string& text, std::string_view id, ModelTexts& models,
                              std::vector<std::string>& ids) {
    const Opened here(text, models);
    const auto& e = here.find(id);
    if (!may_unpack(text, e)) throw std::invalid_argument(fmt::format("'{}' has no parts of its own", id));
    const auto index = static_cast<std::size_t>(&e - here.entries.data());
    std::string out = e.form == Entry::Form::include ? with_own_model(text, here.tree, e) : text;
    const Opened now(out, models);
    std::set<std::string> taken;
    for (const auto& other : now.entries) taken.insert(other.name);
    std::size_t models_now = 1;
    auto split = split_model(out, now.tree, now.entries[index], taken, models_now);
    const Opened last(split, models);
    ids.clear();
    for (std::size_t i = 0; i < models_now; ++i) ids.push_back(last.entries[index + i].id);
    return split;
}

void check_world_text(const std::string& path, const std::string& text, Diagnostics& diagnostics) {
    if (const auto document = xml::open(path, text, sdf_format(), diagnostics))
        xml::check(*document, sdf_format(), diagnostics);
}

}  // namespace forage::bug
