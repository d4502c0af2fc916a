#include "tools/api/edit/forms.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/sequence.h"
#include "core/run/input_error.h"
#include "core/xml/system_elements.h"

namespace forage::editing {
namespace {

using namespace model;

json population_of(const Population& population) {
    if (const auto* r = std::get_if<Region>(&population))
        return {{"form", "region"}, {"x", r->x}, {"y", r->y}, {"width", r->width}, {"height", r->height}};
    if (const auto* l = std::get_if<List>(&population))
        return {{"form", "list"}, {"points", points_of(l->points)}};
    return {{"form", "all"}};
}

[[noreturn]] void no_form(const char* what, const std::string& form) {
    throw InputError(fmt::format("'{}' is not a form of {}", form, what));
}

Population population_from(const json& pattern, const char* side) {
    const auto it = pattern.find(side);
    if (it == pattern.end() || it->is_null()) return All{};
    const auto form = it->at("form").get<std::string>();
    if (form == "all") return All{};
    if (form == "list") return List{points_from(it->at("points")), {}};
    if (form == "region")
        return Region{whole_from(it->at("x"), model::max_extent),
                      whole_from(it->at("y"), model::max_extent),
                      whole_from(it->at("width"), model::max_extent),
                      whole_from(it->at("height"), model::max_extent),
                      {}};
    no_form("a population", form);
}

/// The values of the attributes of `s`, by their names in a file.
template <class Struct>
json values_of(const Struct& s) {
    json out = json::object();
    for (const auto& a : xml::element_of<Struct>().attributes)
        std::visit([&](const auto& value) { out[a.rule.name] = value; }, xml::value_of(a, s));
    return out;
}

/// The alternative that a variant holds, with its values.
template <class... Structs>
json form_of(const std::variant<Structs...>& variant) {
    return std::visit(
        []<class Struct>(const Struct& s) -> json {
            return {{"type", xml::element_of<Struct>().rule.name}, {"values", values_of(s)}};
        },
        variant);
}

/// Sets the members for which there are values.
template <class Struct>
void read_values(const json& values, Struct& s) {
    for (const auto& a : xml::element_of<Struct>().attributes) {
        const auto it = values.find(a.rule.name);
        if (it == values.end()) continue;
        const auto& choices = a.rule.value.choices;
        std::visit(
            [&]<class T>(T* to) {
                if constexpr (std::is_same_v<T, int>)
                    *to = whole_from(*it, model::max_extent);
                else if constexpr (std::is_enum_v<T>) {
                    if (const auto c = std::ranges::find(choices, it->template get<std::string>());
                        c != choices.end())
                        *to = static_cast<T>(c - choices.begin());
                } else if constexpr (requires { it->get_to(*to); })
                    it->get_to(*to);
            },
            a.member.in(&s));
    }
}

/// The values of a form; an object without members when it has none.
json values_in(const json& form) {
    json values = form.value("values", json::object());
    if (!values.is_object()) throw InputError(fmt::format("the values {} are not an object", values.dump()));
    return values;
}

/// Reads the alternative of which a form has the values.
void read_form(const json& form, auto& variant, const char* what) {
    const auto type = form.at("type").get<std::string>();
    const json values = values_in(form);
    if (!xml::read_alternative(type, variant, [&](const auto&, auto& s) { read_values(values, s); }))
        no_form(what, type);
}

}  // namespace

json points_of(const std::vector<Point>& points) {
    return collected(points, [](const Point& p) { return json{p.x, p.y}; });
}

std::vector<Point> points_from(const json& points) {
    return collected(points, [](const json& p) {
        return Point{whole_from(p.at(0)), whole_from(p.at(1)), {}};
    });
}

int whole_from(const json& number, double most) {
    const double value = number.get<double>();
    if (!(std::abs(value) <= most))
        throw InputError(fmt::format("{} is not a number from {} to {}", number.dump(), -most, most));
    return static_cast<int>(std::lround(value));
}

json json_of(const Pattern& pattern) {
    if (const auto* mapped = std::get_if<MappedPattern>(&pattern))
        return {{"form", "mapped"},
                {"mapping", mapped->all ? "all" : "center"},
                {"source", population_of(mapped->source)},
                {"target", population_of(mapped->target)}};
    if (const auto* each = std::get_if<ForeachPattern>(&pattern))
        return {{"form", "foreach"},
                {"source", population_of(each->source)},
                {"target", population_of(each->target)}};
    if (const auto* weights = std::get_if<Weights>(&pattern))
        return {{"form", "weights"},
                {"file", weights->file},
                {"list", weights->is_list},
                {"text", weights->text}};
    const auto tuple = [](const auto& t) {
        return json{{"source", points_of(t.sources)}, {"target", points_of(t.targets)}};
    };
    return {{"form", "tuples"}, {"tuples", collected(std::get<TuplesPattern>(pattern).tuples, tuple)}};
}

Pattern pattern_from(const json& pattern) {
    if (pattern.is_null()) return MappedPattern{};
    const auto name = pattern.at("form").get<std::string>();
    if (name == "mapped")
        return MappedPattern{pattern.value("mapping", "center") == "all", population_from(pattern, "source"),
                             population_from(pattern, "target"), pattern.contains("mapping")};
    if (name == "foreach")
        return ForeachPattern{population_from(pattern, "source"), population_from(pattern, "target")};
    if (name == "weights")
        return Weights{pattern.value("file", ""), pattern.value("list", false), pattern.value("text", "")};
    if (name != "tuples") no_form("a pattern", name);
    TuplesPattern out;
    for (const auto& t : pattern.at("tuples"))
        out.tuples.push_back({points_from(t.at("source")), points_from(t.at("target"))});
    return out;
}

json json_of(const Arborization& a) {
    json out = form_of(a.shape);
    out["values"].update(values_of(a));
    return out;
}

Arborization arborization_from(const json& arborization) {
    Arborization out;
    if (arborization.is_null()) return out;
    read_values(values_in(arborization), out);
    read_form(arborization, out.shape, "an arborization");
    return out;
}

json json_of(const DistanceFunction& function) { return form_of(function.form); }

DistanceFunction function_from(const json& function) {
    DistanceFunction out;
    if (!function.is_null()) read_form(function, out.form, "a function of the distance");
    return out;
}

json json_of(const Topology& topology) {
    const GroupShape all = shape(topology);
    json out = {{"width", all.width}, {"height", all.height}, {"wrap_x", false}, {"wrap_y", false}};
    if (const auto* rect = std::get_if<RectTopology>(&topology)) {
        out["form"] = "rect", out["points"] = json::array();
        out["wrap_x"] = rect->wrap_x, out["wrap_y"] = rect->wrap_y;
    } else {
        out["form"] = "sparse", out["points"] = points_of(std::get<SparseTopology>(topology).points);
    }
    return out;
}

Topology topology_from(const json& form) {
    const auto points = form.find("points");
    if (points != form.end() && !points->empty()) return SparseTopology{points_from(*points)};
    if (!form.contains("width") || !form.contains("height"))
        throw InputError("a topology has 'width' and 'height', or 'points'");
    return RectTopology{whole_from(form.at("width"), model::max_extent),
                        whole_from(form.at("height"), model::max_extent), form.value("wrap_x", false),
                        form.value("wrap_y", false)};
}

}  // namespace forage::editing
