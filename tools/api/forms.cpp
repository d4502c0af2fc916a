#include "tools/api/forms.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/run/input_error.h"

namespace forage::editing {
namespace {

using namespace model;

json points_of(const std::vector<Point>& points) {
    json out = json::array();
    for (const Point& p : points) out.push_back({p.x, p.y});
    return out;
}

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
        return Region{whole_from(it->at("x"), model::most_cells),
                      whole_from(it->at("y"), model::most_cells),
                      whole_from(it->at("width"), model::most_cells),
                      whole_from(it->at("height"), model::most_cells),
                      {}};
    no_form("a population", form);
}

json form(const char* type, json values) { return {{"type", type}, {"values", std::move(values)}}; }

/// The values of a form; what is absent has the default of a member.
struct Values {
    const json& all;
    int whole(const char* name, int otherwise) const {
        const auto it = all.find(name);
        return it == all.end() ? otherwise : whole_from(*it, model::most_cells);
    }
    double number(const char* name, double otherwise) const { return all.value(name, otherwise); }
};

}  // namespace

std::vector<Point> points_from(const json& points) {
    std::vector<Point> out;
    for (const auto& p : points) out.push_back({whole_from(p.at(0)), whole_from(p.at(1)), {}});
    return out;
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
    json tuples = json::array();
    for (const auto& t : std::get<TuplesPattern>(pattern).tuples)
        tuples.push_back({{"source", points_of(t.sources)}, {"target", points_of(t.targets)}});
    return {{"form", "tuples"}, {"tuples", std::move(tuples)}};
}

Pattern pattern_from(const json& pattern) {
    if (pattern.is_null()) return MappedPattern{};
    const auto name = pattern.at("form").get<std::string>();
    if (name == "mapped")
        return MappedPattern{pattern.value("mapping", "center") == "all", population_from(pattern, "source"),
                             population_from(pattern, "target")};
    if (name == "foreach")
        return ForeachPattern{population_from(pattern, "source"), population_from(pattern, "target")};
    if (name != "tuples") no_form("a pattern", name);
    TuplesPattern out;
    for (const auto& t : pattern.at("tuples"))
        out.tuples.push_back({points_from(t.at("source")), points_from(t.at("target"))});
    return out;
}

json json_of(const Arborization& a) {
    const auto window = [](const char* type, const auto& w) {
        return form(type, {{"innerwidth", w.inner_width},
                           {"innerheight", w.inner_height},
                           {"outerwidth", w.outer_width},
                           {"outerheight", w.outer_height}});
    };
    json out;
    if (const auto* rect = std::get_if<RectArbor>(&a.shape))
        out = form("ArbRect", {{"width", rect->width}, {"height", rect->height}});
    else if (const auto* ellipse = std::get_if<EllipseArbor>(&a.shape))
        out = form("ArbEllipse", {{"width", ellipse->width}, {"height", ellipse->height}});
    else if (const auto* frame = std::get_if<RectWindowArbor>(&a.shape))
        out = window("ArbRectWindow", *frame);
    else if (const auto* ring = std::get_if<EllipseWindowArbor>(&a.shape))
        out = window("ArbEllipseWindow", *ring);
    else if (const auto* random = std::get_if<RandomArbor>(&a.shape))
        out = form("ArbRandom", {{"count", random->count}});
    else
        out = form("ArbAll", json::object());
    out["values"]["direction"] = a.direction == Direction::projective ? "PF" : "RF";
    out["values"]["initialization_probability"] = a.probability;
    return out;
}

Arborization arborization_from(const json& arborization) {
    Arborization out;
    if (arborization.is_null()) return out;
    const auto type = arborization.at("type").get<std::string>();
    const json none = json::object();
    const auto it = arborization.find("values");
    const Values v{it == arborization.end() ? none : *it};
    out.direction = v.all.value("direction", "RF") == "PF" ? Direction::projective : Direction::receptive;
    out.probability = v.number("initialization_probability", 1);
    const auto window = [&](auto w) {
        w.inner_width = v.whole("innerwidth", 0), w.inner_height = v.whole("innerheight", 0);
        w.outer_width = v.whole("outerwidth", 1), w.outer_height = v.whole("outerheight", 1);
        return w;
    };
    if (type == "ArbRect")
        out.shape = RectArbor{v.whole("width", 1), v.whole("height", 1)};
    else if (type == "ArbEllipse")
        out.shape = EllipseArbor{v.whole("width", 1), v.whole("height", 1)};
    else if (type == "ArbRectWindow")
        out.shape = window(RectWindowArbor());
    else if (type == "ArbEllipseWindow")
        out.shape = window(EllipseWindowArbor());
    else if (type == "ArbRandom")
        out.shape = RandomArbor{v.whole("count", 1)};
    else if (type == "ArbAll")
        out.shape = AllArbor{};
    else
        no_form("an arborization", type);
    return out;
}

json json_of(const DistanceFunction& function) {
    if (const auto* uniform = std::get_if<UniformFunction>(&function.form))
        return form("FunUniform", {{"value", uniform->value}});
    if (const auto* linear = std::get_if<LinearFunction>(&function.form))
        return form("FunLinear", {{"min", linear->min}, {"max", linear->max}});
    if (const auto* gaussian = std::get_if<GaussianFunction>(&function.form))
        return form("FunGaussian",
                    {{"min", gaussian->min}, {"max", gaussian->max}, {"sigma", gaussian->sigma}});
    if (const auto* block = std::get_if<BlockFunction>(&function.form))
        return form(
            "FunBlock",
            {{"min", block->min}, {"max", block->max}, {"width", block->width}, {"height", block->height}});
    return form("FunRandom", {{"max", std::get<RandomFunction>(function.form).max}});
}

DistanceFunction function_from(const json& function) {
    DistanceFunction out;
    if (function.is_null()) return out;
    const auto type = function.at("type").get<std::string>();
    const json none = json::object();
    const auto it = function.find("values");
    const Values v{it == function.end() ? none : *it};
    const double min = v.number("min", 0), max = v.number("max", 1);
    if (type == "FunUniform")
        out.form = UniformFunction{v.number("value", 0)};
    else if (type == "FunLinear")
        out.form = LinearFunction{min, max};
    else if (type == "FunGaussian")
        out.form = GaussianFunction{min, max, v.number("sigma", 1)};
    else if (type == "FunBlock")
        out.form = BlockFunction{min, max, v.whole("width", 0), v.whole("height", 0)};
    else if (type == "FunRandom")
        out.form = RandomFunction{max};
    else
        no_form("a function of the distance", type);
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
    return RectTopology{whole_from(form.at("width"), model::most_cells),
                        whole_from(form.at("height"), model::most_cells), form.value("wrap_x", false),
                        form.value("wrap_y", false)};
}

}  // namespace forage::editing
