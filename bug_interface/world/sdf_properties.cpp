#include "bug_interface/world/sdf_properties.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "bug_interface/world/sdf_rules.h"
#include "core/base/number.h"

namespace forage::bug {
namespace {

using xml::SourceElement;

constexpr double degree = std::numbers::pi / 180;
constexpr double thinnest = 1e-6, longest = 1e4;  // m, of a shape

/// A number in an element of its own, below the element of the item.
struct ValueRow {
    std::string_view name, label, path;
    double otherwise, low, high;  ///< `otherwise` is what counts without the element
    bool whole = false;
    double unit = 1;  ///< of `otherwise`, `low` and `high`, in that of the element
};

constexpr ValueRow world_rows[] = {
    {"ambient", "Ambient light", "scene/ambient", 0.4, 0, 1},
    {"step", "Step, s", "physics type=\"ode\"/max_step_size", 0.001, 1e-6, 1},
    {"rate", "Steps per second", "physics type=\"ode\"/real_time_update_rate", 1000, 1e-6, 1e6},
};

std::vector<ValueRow> rows_of(const Entry& e) {
    std::vector<ValueRow> out;
    const auto add = [&]<class Rules>(const Rules& usual, const auto& table) {
        for (const RuleOf<Rules>& r : table) {
            const double value = std::visit([&](auto m) { return static_cast<double>(usual.*m); }, r.member);
            const double high = std::floor(r.high / r.unit);  // also in degrees a whole number
            out.push_back({r.name, r.label, r.name, std::min(value / r.unit, high), r.low / r.unit, high,
                           r.whole(), r.unit});
        }
    };
    if (e.form == Entry::Form::world) out.assign(std::begin(world_rows), std::end(world_rows));
    if (e.form == Entry::Form::trials) add(TrialRules(), trial_rules);
    if (e.form == Entry::Form::game) add(GameRules(), game_rules);
    if (e.is_model() && (e.kind == "object" || e.kind == "resource"))
        out.push_back({"mass", "Mass, kg", "link/inertial/mass", 1, 1e-6, 1e6});
    return out;
}

/// A number as a form shows it, in whole `unit`s.
ItemProperty number(std::string_view name, std::string_view label, double value,
                    std::optional<double> low = {}, std::optional<double> high = {}, double unit = 1e-6) {
    const auto shown = fmt::format("{:.10g}", std::round(value / unit) * unit + 0.0);
    return {std::string(name), std::string(label), "number", shown, low, high, {}};
}

/// All shapes of a model; of a floor, those that bound it.
std::vector<Form> solid_forms(const Entry& e) {
    auto out = forms_of(e.body, "collision");
    if (e.kind == "floor") return out;
    for (auto& f : forms_of(e.body, "visual")) out.push_back(f);
    return out;
}

/// A length of a shape: a word of the content of an element in it.
struct Length {
    std::string_view name, label, element;
    std::size_t word = 0;
    bool vertical = false;
};
std::vector<Length> lengths_of(std::string_view shape) {
    if (shape == "box")
        return {{"width", "Width, m", "size", 0},
                {"depth", "Depth, m", "size", 1},
                {"height", "Height, m", "size", 2, true}};
    if (shape == "cylinder")
        return {{"radius", "Radius, m", "radius"}, {"height", "Height, m", "length", 0, true}};
    return {{"radius", "Radius, m", "radius"}};
}
std::optional<double> length_of(std::string_view text, const Form& f, const Length& length) {
    const auto v = numbers_in(text, child(*f.shape, length.element));
    return length.word < v.size() ? std::optional(v[length.word]) : std::nullopt;
}

/// The lengths that all shapes of a model have in common. A robot has none: its sensors depend on its size.
std::vector<std::pair<Length, double>> common_lengths(const Entry& e) {
    std::vector<std::pair<Length, double>> out;
    const auto forms = solid_forms(e);
    if (forms.empty() || e.kind == "robot" || e.kind == "other") return out;
    for (const auto& length : lengths_of(forms.front().shape->name)) {
        if (length.vertical &&
            (e.kind == "floor" || e.kind == "patch" || e.kind == "start" || e.kind == "home"))
            continue;  // paint
        const auto value = length_of(e.body.text, forms.front(), length);
        if (value && std::ranges::all_of(forms, [&](const Form& f) {
                return f.shape->name == forms.front().shape->name &&
                       length_of(e.body.text, f, length) == value;
            }))
            out.emplace_back(length, *value);
    }
    return out;
}

/// The visuals of a model's own links, with their colours; without those that show a picture.
std::vector<std::pair<const SourceElement*, std::string>> painted(const ItemElement& body) {
    std::vector<std::pair<const SourceElement*, std::string>> out;
    if (!body.element || body.element->name != "model") return out;
    for (const auto& link : body.element->children)
        for (const auto& e : link.children)
            if (link.name == "link" && e.name == "visual")
                if (auto colour = colour_of(body.text, e); !colour.empty()) out.emplace_back(&e, colour);
    return out;
}

std::vector<const SourceElement*> collisions(const Entry& e) {
    return e.body.element ? all(*e.body.element, "collision") : std::vector<const SourceElement*>();
}

/// Where a directional light comes from.
struct Sun {
    double azimuth = 0, elevation = 90;  ///< degrees: to the left of x, and above the floor
};
Sun sun_of(const ItemElement& body) {
    const auto d = numbers_in(body.text, child(*body.element, "direction"));
    if (d.size() != 3) return {};
    const double along = std::hypot(d[0], d[1]);
    return {along > 0 ? std::atan2(-d[1], -d[0]) / degree : 0, std::atan2(-d[2], along) / degree};
}

/// Whether robots meet it, and it is none of them.
bool is_solid(const Entry& e) {
    return e.is_model() && (e.kind == "wall" || e.kind == "object" || e.kind == "resource") &&
           !collisions(e).empty();
}

void add_model_properties(const Entry& e, std::vector<ItemProperty>& out) {
    for (const auto& [length, value] : common_lengths(e)) {
        auto p = number(length.name, length.label, value, thinnest, longest);
        if (e.kind == "floor") p.label = length.word == 0 ? "Bounds along x, m" : "Bounds along y, m";
        out.push_back(std::move(p));
    }
    if (const auto visuals = painted(e.body); !visuals.empty())
        out.push_back({"color", "Colour", "color", visuals.front().second, {}, {}, {}});
    if (is_solid(e)) {
        if (e.kind != "resource")
            out.push_back({"movable", "Can be pushed", "boolean", e.kind == "wall" ? "0" : "1", {}, {}, {}});
        const auto* mu = at_path(*collisions(e).front(), "surface/friction/ode/mu");
        const auto friction = numbers_in(e.body.text, mu);
        out.push_back(number("friction", "Friction", friction.size() == 1 ? friction[0] : 1, 0, 1000));
    }
}

void write_length(SdfEdit& to, const Entry& e, const Length& length, double old, double value) {
    for (const auto& f : solid_forms(e)) {
        const auto* element = child(*f.shape, length.element);
        to.edits.replace(words(to.text, element->content)[length.word], number_text(value));
    }
    const bool ball = solid_forms(e).front().shape->name == "sphere";
    if (!length.vertical && !ball) return;
    // What stands on the floor stays there.
    const double half = ball ? 1 : 0.5;
    for (const auto& link : e.body.element->children) {
        const auto* pose = link.name == "link" ? child(link, "pose") : nullptr;
        const auto at = pose ? words(to.text, pose->content) : std::vector<xml::Span>();
        if (at.size() >= 6 && std::abs(pose_of(to.text, link).z - half * old) < 1e-9)
            to.edits.replace(at[2], number_text(half * value));
    }
}

/// Paints the visuals that have the colour of the first; others, such as the front of a robot, keep theirs.
void write_colour(SdfEdit& to, const Entry& e, const std::string& hex) {
    const auto value = colour_text(hex);
    const auto visuals = painted(e.body);
    for (const auto& [visual, colour] : visuals) {
        if (colour != visuals.front().second) continue;
        const std::string plain = fmt::format("<ambient>{0}</ambient><diffuse>{0}</diffuse>", value);
        const auto* material = child(*visual, "material");
        const auto* script = material ? child(*material, "script") : nullptr;
        if (!material) {
            to.append(*visual, "<material>" + plain + "</material>");
        } else if (!material->closed) {
            to.edits.replace(material->whole, "<material>" + plain + "</material>");
        } else if (script && !child(*material, "ambient") && !child(*material, "diffuse")) {
            to.edits.replace(script->whole, plain);
        } else {
            for (const char* name : {"ambient", "diffuse"}) to.set_value(*material, name, value);
        }
    }
}

void write_sun(SdfEdit& to, const Entry& e, Sun sun) {
    const double a = sun.azimuth * degree, h = sun.elevation * degree;
    const auto part = [](double v) { return number_text(std::round(v * 1e6) / 1e6); };
    to.set_value(*e.element, "direction",
                 fmt::format("{} {} {}", part(-std::cos(a) * std::cos(h)), part(-std::sin(a) * std::cos(h)),
                             part(-std::sin(h))));
}

void write_name(SdfEdit& to, const Entry& e, const std::string& name) {
    const auto value = xml::encoded(name);
    const bool included = e.form == Entry::Form::include;
    for (const auto* element : {e.state, included ? nullptr : e.element})
        if (const auto* a = element ? element->attribute("name") : nullptr)
            // With its quotes: the name may hold those that the author has.
            to.edits.replace(a->whole, fmt::format("name=\"{}\"", value));
    if (!included) return;
    if (child(*e.element, "name"))
        to.set_value(*e.element, "name", value);
    else
        to.insert(*e.element, nullptr, "<name>" + value + "</name>");
}

}  // namespace

std::string colour_text(const std::string& hex) {
    const auto digit = [](char c) { return c <= '9' ? c - '0' : (c | 32) - 'a' + 10; };
    if (hex.size() != 7 || hex[0] != '#' || hex.find_first_not_of("0123456789abcdefABCDEF", 1) != hex.npos)
        throw std::invalid_argument(fmt::format("'{}' is not a colour such as #ff8000", hex));
    const auto part = [&](std::size_t at) { return (digit(hex[at]) * 16 + digit(hex[at + 1])) / 255.0; };
    return fmt::format("{:.3g} {:.3g} {:.3g} 1", part(1), part(3), part(5));
}

std::vector<ItemProperty> properties_of(std::string_view text, const Entry& e, const ModelTexts& models) {
    std::vector<ItemProperty> out;
    const bool ruled = e.form == Entry::Form::game || e.form == Entry::Form::trials;
    if (!ruled && e.form != Entry::Form::site) out.push_back({"name", "Name", "text", e.name, {}, {}, {}});
    if (e.form == Entry::Form::include)
        out.push_back({"model",
                       "Model",
                       "choice",
                       decoded(content(text, child(*e.element, "uri"))),
                       {},
                       {},
                       models.uris()});
    if (e.placed()) {
        const auto pose = e.pose(text);
        out.push_back(number("x", "x, m", pose.x, -1000, 1000));
        out.push_back(number("y", "y, m", pose.y, -1000, 1000));
        if (e.is_model()) {
            out.push_back(number("heading", "Heading, °", pose.yaw / degree, {}, {}, 0.01));
            out.push_back(number("z", "Above the floor, m", pose.z, -1000, 1000));
        }
    }
    if (e.form == Entry::Form::site) {
        const auto v = numbers_in(text, e.element);
        out.push_back(number("chance", "Chance in a second", v.size() == 3 ? v[2] : 0, 0, 1));
    }
    if (e.body.element && e.body.element->name == "light") {
        const auto sun = sun_of(e.body);
        out.push_back(number("azimuth", "Comes from, °", sun.azimuth, -180, 180, 0.01));
        out.push_back(number("elevation", "Elevation, °", sun.elevation, 0, 90, 0.01));
    } else if (e.is_model() && e.body.element) {
        add_model_properties(e, out);
    }
    const auto* element = e.is_model() ? e.body.element : e.element;
    for (const ValueRow& r : rows_of(e)) {
        const auto v = numbers_in(e.is_model() ? e.body.text : text, at_path(*element, r.path));
        auto p = number(r.name, r.label, v.empty() ? r.otherwise : v[0] / r.unit, r.low, r.high,
                        r.unit == 1 ? 1e-6 : 0.01);
        if (r.whole) p.kind = "integer";
        out.push_back(std::move(p));
    }
    return out;
}

bool is_own(const Entry& e, std::string_view property) {
    if (e.form != Entry::Form::include) return true;
    constexpr std::string_view own[] = {"name", "model", "x", "y", "z", "heading", "movable"};
    return std::ranges::find(own, property) != std::end(own);
}

void write_pose(SdfEdit& to, const Entry& e, const PoseText& pose) {
    to.set_pose(e.placed_by(), pose);
    if (!e.state) return;
    for (const auto& part : e.state->children)  // their poses are those in the world before
        if (part.name == "link" || part.name == "model") to.edits.cut(to.text, part.whole);
}

void write_property(SdfEdit& to, const Entry& e, const ItemProperty& p, const std::string& value) {
    const double v = parse_number<double>(value).value_or(0);
    const auto& name = p.name;
    if (e.form == Entry::Form::site) {
        const auto at = words(to.text, e.element->content);
        const std::size_t word = name == "x" ? 0 : name == "y" ? 1 : 2;
        if (word < at.size()) to.edits.replace(at[word], number_text(v));
        return;
    }
    if (name == "name") return write_name(to, e, value);
    if (name == "model") return to.set_value(*e.element, "uri", xml::encoded(value));
    if (name == "color") return write_colour(to, e, value);
    if (name == "movable") return to.set_value(*e.element, "static", value == "1" ? "false" : "true");
    if (name == "friction") {
        for (const auto* c : collisions(e)) to.set_value(*c, "surface/friction/ode/mu", number_text(v));
        return;
    }
    if (name == "azimuth" || name == "elevation") {
        auto sun = sun_of(e.body);
        (name == "azimuth" ? sun.azimuth : sun.elevation) = v;
        return write_sun(to, e, sun);
    }
    for (const ValueRow& r : rows_of(e))
        if (r.name == name) {
            const auto one = number_text(v * r.unit);
            return to.set_value(*e.element, r.path,
                                name == "ambient" ? fmt::format("{0} {0} {0} 1", one) : one);
        }
    for (const auto& [length, old] : common_lengths(e))
        if (length.name == name) return write_length(to, e, length, old, v);
    auto pose = e.pose(to.text);
    if (name == "x") pose.x = v;
    if (name == "y") pose.y = v;
    if (name == "z") pose.z = v;
    if (name == "heading") pose.yaw = v * degree;
    write_pose(to, e, pose);
}

}  // namespace forage::bug
