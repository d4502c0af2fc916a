// Shapes and materials.
#include <filesystem>

#include <fmt/format.h>

#include "bug_interface/world/material.h"
#include "bug_interface/world/png.h"
#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {
namespace {

namespace fs = std::filesystem;

std::string texture_of(SdfSource& in, const xml::Element& script, const std::string& uri,
                       const std::string& name) {
    const std::string folder = in.folders.find(uri);
    if (folder.empty()) {
        in.diagnostics.error(script.where, fmt::format("there is no folder '{}'", uri),
                             "it holds the .material script and its texture");
        return {};
    }
    std::vector<fs::path> places = {folder, fs::path(folder) / "scripts", fs::path(folder) / "textures",
                                    fs::path(folder).parent_path() / "textures"};
    std::string image;
    for (const auto& place : places) {
        std::error_code ignored;
        for (fs::directory_iterator entry(place, ignored), end; !ignored && entry != end;
             entry.increment(ignored))
            if (entry->path().extension() == ".material" && image.empty())
                image = texture_in_script(read_text(entry->path()).value_or(""), name);
    }
    if (image.empty()) {
        in.diagnostics.error(script.where,
                             fmt::format("no script in '{}' gives material '{}' a texture", folder, name));
        return {};
    }
    for (const auto& place : places) {
        const std::string file = (place / image).string();
        if (!fs::exists(file)) continue;
        if (const std::string problem = png_problem(file); !problem.empty())
            in.diagnostics.error(script.where,
                                 fmt::format("the texture '{}' is no PNG picture: {}", file, problem));
        return file;
    }
    in.diagnostics.error(script.where, fmt::format("the texture '{}' of material '{}' is missing in '{}'",
                                                   image, name, folder));
    return {};
}

/// Contacts are found in single precision: what is very large or very small cannot be right in it.
void check_size(SdfSource& in, const Shape& shape, const Location& where) {
    constexpr double smallest = 1e-6, largest = 1e4;  // m
    const auto size = shape.size.array();
    if ((size < 0).any()) in.diagnostics.error(where, "a size is negative", "sizes are in m");
    const auto zeros = (size == 0).count();  // a box may be flat, and is then no obstacle
    if (shape.kind != ShapeKind::plane && zeros > (shape.kind == ShapeKind::box ? 1 : 0))
        in.diagnostics.error(where, "a size is 0", "sizes are in m");
    if (!(size <= largest).all())
        in.diagnostics.error(where,
                             fmt::format("a size of {:g} m is more than {:g} m", size.maxCoeff(), largest),
                             "sizes are in m");
    if (((size > 0) && (size < smallest)).any())
        in.diagnostics.error(where, fmt::format("a size is less than {:g} m", smallest), "sizes are in m");
}

}  // namespace

Shape read_shape(SdfSource& in, const xml::Element& parent) {
    Shape shape;
    const auto* geometry = parent.child("geometry");
    if (!geometry || geometry->children.empty() || geometry->children.front().name == "empty") {
        in.diagnostics.error(parent.where, fmt::format("<{}> has no shape that is known here", parent.name),
                             "the shapes are <plane>, <box>, <cylinder> and <sphere>");
        return shape;
    }
    if (geometry->children.size() > 1)
        in.diagnostics.error(geometry->children[1].where, "a <geometry> holds one shape; this is another one",
                             fmt::format("give it a <{}> of its own", parent.name));
    const xml::Element& kind = geometry->children.front();
    if (kind.name == "box") {
        shape = {ShapeKind::box, in.value(kind, "size", Eigen::Vector3d(1, 1, 1))};
    } else if (kind.name == "cylinder") {
        const double d = 2 * in.value(kind, "radius", 1.0);
        shape = {ShapeKind::cylinder, {d, d, in.value(kind, "length", 1.0)}};
    } else if (kind.name == "sphere") {
        shape = {ShapeKind::sphere, Eigen::Vector3d::Constant(2 * in.value(kind, "radius", 1.0))};
    } else if (kind.name == "plane") {
        const Eigen::Vector2d s = in.value(kind, "size", Eigen::Vector2d(1, 1));
        shape = {ShapeKind::plane, {s.x(), s.y(), 0}};
    } else {
        in.diagnostics.error(kind.where, fmt::format("shape <{}> is not supported", kind.name),
                             "the shapes are <plane>, <box>, <cylinder> and <sphere>");
        return shape;
    }
    check_size(in, shape, kind.where);
    return shape;
}

Material read_material(SdfSource& in, const xml::Element& visual) {
    Material material;
    const auto* e = visual.child("material");
    if (!e) return material;
    if (const auto* script = e->child("script")) {
        const std::string name = text_of(*script, "name");
        std::string uri;
        each(*script, "uri", [&](const xml::Element& u) {
            if (u.text.starts_with("model://")) uri = u.text;
        });
        if (!uri.empty()) {
            material.ambient = material.diffuse = Colour::Ones();
            material.texture = texture_of(in, *script, uri, name);
        } else if (const auto known = named_material(name)) {
            material = *known;
        } else {
            in.diagnostics.error(script->where, fmt::format("there is no material '{}'", name),
                                 suggest(name, material_names()));
        }
    }
    material.ambient = in.value(*e, "ambient", material.ambient);
    material.diffuse = in.value(*e, "diffuse", material.diffuse);
    return material;
}

}  // namespace forage::bug
