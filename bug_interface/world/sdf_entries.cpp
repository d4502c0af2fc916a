#include "bug_interface/world/sdf_entries.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "bug_interface/world/material.h"

namespace forage::bug {
namespace {

using xml::SourceElement;

bool has_plugin(const SourceElement& e, std::string_view file) {
    return std::ranges::any_of(all(e, "plugin"), [&](const auto* p) { return p->value("filename") == file; });
}

/// Whether light sensors (at 0.35 m) see one of its cylinders and proximity sensors (at 0.175 m) do not.
bool is_target(const ItemElement& body) {
    return std::ranges::any_of(forms_of(body, "collision"), [&](const Form& f) {
        const auto size = extents(body.text, *f.shape);
        if (f.shape->name != "cylinder" || size.size() != 2) return false;
        const double low = f.pose.z - size[1] / 2, high = f.pose.z + size[1] / 2;
        return low < 0.35 && 0.35 < high && !(low < 0.175 && 0.175 < high);
    });
}

/// Whether a model, or one that is merged into it, is made a robot or a resource: "robot", "resource" or "".
std::string_view role_of(std::string_view text, const SourceElement& model, ModelTexts& models,
                         int depth = 0) {
    if (has_plugin(model, "libvel_plugin.so")) return "robot";
    if (has_plugin(model, "libtarget_plugin.so")) return "resource";
    constexpr int max_depth = 8;
    if (depth == max_depth) return {};
    for (const auto* include : all(model, "include")) {
        const auto merge = include->value("merge");
        if (merge != "true" && merge != "1") continue;
        const std::string& file = models.of(decoded(content(text, child(*include, "uri"))));
        const SourceElement root = file.empty() ? SourceElement() : xml::scan(file);
        for (const auto* merged : all(root, "model"))
            if (const auto role = role_of(file, *merged, models, depth + 1); !role.empty()) return role;
    }
    return {};
}

std::string kind_of(std::string_view text, const Entry& e, ModelTexts& models) {
    if (e.name.starts_with("Reset_")) return "start";
    if (e.name.starts_with("Home_")) return "home";
    if (!e.body.element) return "other";
    const auto& body = *e.body.element;
    if (body.name == "light") return "sun";
    if (const auto role = role_of(e.body.text, body, models); !role.empty()) return std::string(role);
    if (!all(body, "plane").empty()) return "floor";
    const auto* set = e.form == Entry::Form::include ? child(*e.element, "static") : nullptr;
    if (set ? !is_true(text, set) : !is_true(e.body.text, child(body, "static"))) return "object";
    if (all(body, "collision").empty()) return "patch";
    return is_target(e.body) ? "light" : "wall";
}

Entry entry(std::string_view text, const SourceElement& element, ModelTexts& models) {
    Entry out;
    out.element = &element;
    if (element.name == "include") {
        out.form = Entry::Form::include;
        const auto uri = decoded(content(text, child(element, "uri")));
        if (const std::string& file = models.of(uri); !file.empty()) {
            out.body.text = file, out.body.root = xml::scan(file);
            for (const auto& e : out.body.root.children)
                if (!out.body.element && (e.name == "model" || e.name == "light")) out.body.element = &e;
        }
        out.name = decoded(content(text, child(element, "name")));
        if (out.name.empty())  // then it has the name in the model's file
            out.name = out.body.element ? decoded(out.body.element->value("name"))
                                        : uri.substr(std::min(uri.rfind('/') + 1, uri.size()));
    } else {
        out.form = element.name == "light" ? Entry::Form::light : Entry::Form::model;
        out.name = decoded(element.value("name"));
        out.body.text = text, out.body.element = &element;
    }
    out.kind = kind_of(text, out, models);
    return out;
}

}  // namespace

PoseText Entry::pose(std::string_view text) const {
    if (form == Form::site) {
        const auto v = numbers_in(text, element);
        return v.size() < 2 ? PoseText() : PoseText{v[0], v[1]};
    }
    if (state || child(*element, "pose") || !body.element) return pose_of(text, placed_by());
    return pose_of(body.text, *body.element);
}

std::vector<Entry> entries_of(std::string_view text, const WorldTree& tree, ModelTexts& models) {
    std::vector<Entry> out;
    if (!tree.world) return out;
    const auto add = [&](Entry::Form form, const SourceElement& e, std::string kind, std::string name) {
        out.push_back({form, {}, std::move(name), std::move(kind), &e});
    };
    add(Entry::Form::world, *tree.world, "world", decoded(tree.world->value("name")));
    for (const auto& e : tree.world->children) {
        if (e.name == "include" || e.name == "model" || e.name == "light")
            out.push_back(entry(text, e, models));
        if (e.name != "plugin") continue;
        const auto file = e.value("filename");
        if (file == "libforage_trials.so") add(Entry::Form::trials, e, "trials", "Trials");
        if (file != "libforage_game.so") continue;
        add(Entry::Form::game, e, "game", "Game");
        int n = 0;
        for (const auto& site : e.children)
            if (site.name == "site") add(Entry::Form::site, site, "site", fmt::format("Site {}", ++n));
    }
    if (const auto* state = child(*tree.world, "state"))
        for (const auto& e : state->children)
            if (e.name == "model" && child(e, "pose"))
                if (const auto it = std::ranges::find(out, decoded(e.value("name")), &Entry::name);
                    it != out.end() && it->is_model())
                    it->state = &e;
    std::set<std::string> taken;
    for (auto& e : out) {
        e.id = e.name;
        for (int n = 2; !taken.insert(e.id).second; ++n) e.id = fmt::format("{} ({})", e.name, n);
    }
    return out;
}

std::vector<Form> forms_of(const ItemElement& body, std::string_view owner) {
    std::vector<Form> out;
    if (!body.element) return out;
    for (const auto& link : body.element->children) {
        if (link.name != "link") continue;
        const auto at = pose_of(body.text, link);
        for (const auto& e : link.children) {
            const auto* geometry = e.name == owner ? child(e, "geometry") : nullptr;
            if (!geometry || geometry->children.empty()) continue;
            const auto shape = geometry->children.front().name;
            if (shape != "box" && shape != "cylinder" && shape != "sphere") continue;
            auto pose = pose_of(body.text, e);
            const double c = std::cos(at.yaw), s = std::sin(at.yaw);
            pose = {at.x + c * pose.x - s * pose.y,
                    at.y + s * pose.x + c * pose.y,
                    at.z + pose.z,
                    0,
                    0,
                    at.yaw + pose.yaw};
            out.push_back({&link, &e, &geometry->children.front(), pose});
        }
    }
    return out;
}

std::vector<double> extents(std::string_view text, const SourceElement& shape) {
    if (shape.name == "box") return numbers_in(text, child(shape, "size"));
    auto out = numbers_in(text, child(shape, "radius"));
    if (const auto length = numbers_in(text, child(shape, "length")); !length.empty())
        out.push_back(length[0]);
    return out;
}

std::string colour_of(std::string_view text, const SourceElement& visual) {
    Colour colour = Material().diffuse;
    if (const auto* material = child(visual, "material")) {
        if (const auto* script = child(*material, "script")) {
            for (const auto& e : script->children)
                if (e.name == "uri" && content(text, &e).starts_with("model://")) return {};
            const auto known = named_material(decoded(content(text, child(*script, "name"))));
            if (known) colour = known->diffuse;
        }
        if (const auto v = numbers_in(text, child(*material, "diffuse")); v.size() >= 3)
            colour = Colour(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
    }
    return hex_of(colour);
}

}  // namespace forage::bug
