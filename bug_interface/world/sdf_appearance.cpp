// Shapes and materials.
#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>

#include "bug_interface/world/material.h"
#include "bug_interface/world/png.h"
#include "bug_interface/world/sdf_elements.h"

namespace forage::bug {
namespace {

namespace fs = std::filesystem;

std::string texture_of(SdfSource& in, const xml::Element& script, const std::string& uri,
                       const std::string& folder, const std::string& name) {
    if (folder.empty()) {
        in.diagnostics.error(script.where(), fmt::format("there is no folder '{}'", uri),
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
            if (entry->path().extension() == ".material" && image.empty()) {
                image = texture_in_script(read_text(entry->path()).value_or(""), name);
                if (!image.empty()) in.included.insert(entry->path().string());
            }
    }
    if (image.empty()) {
        in.diagnostics.error(script.where(),
                             fmt::format("no script in '{}' gives material '{}' a texture", folder, name));
        return {};
    }
    for (const auto& place : places) {
        const std::string file = (place / image).string();
        if (!fs::exists(file)) continue;
        if (const std::string problem = png_problem(file); !problem.empty())
            in.diagnostics.error(script.where(),
                                 fmt::format("the texture '{}' is not a PNG picture: {}", file, problem));
        in.included.insert(file);
        return file;
    }
    in.diagnostics.error(script.where(), fmt::format("the texture '{}' of material '{}' is missing in '{}'",
                                                     image, name, folder));
    return {};
}

/// Reports very small shapes, for which the single precision of contacts does not suffice.
void check_size(SdfSource& in, const Shape& shape, const Location& where) {
    constexpr double smallest = 1e-6;  // m
    const auto size = shape.size.array();
    const auto zeros = (size == 0).count(), may_be_zero = shape.kind == ShapeKind::plane ? zeros
                                                          : shape.kind == ShapeKind::box ? 1
                                                                                         : 0;
    if (zeros > may_be_zero || ((size > 0) && (size < smallest)).any())
        in.diagnostics.error(where, fmt::format("a size is less than {:g} m", smallest),
                             shape.kind == ShapeKind::box
                                 ? "one size of a box may be 0: it is flat then, and no obstacle"
                                 : "sizes are in m");
}

}  // namespace

bool is_simple_shape(const xml::Element& parent) {
    constexpr std::array known = {"box", "cylinder", "sphere", "plane"};
    return std::ranges::any_of(
        known, [&](const char* shape) { return bool(parent.child("geometry").child(shape)); });
}

Shape read_shape(SdfSource& in, const xml::Element& parent) {
    Shape shape;
    const xml::Element geometry = parent.child("geometry");
    const auto length = [&](const char* path) { return geometry.value(path).number(1); };
    if (geometry.child("box")) {
        shape = {ShapeKind::box, read_vector(geometry.value("box/size"), Eigen::Vector3d::Ones())};
    } else if (geometry.child("cylinder")) {
        const double width = 2 * length("cylinder/radius");
        shape = {ShapeKind::cylinder, {width, width, length("cylinder/length")}};
    } else if (geometry.child("sphere")) {
        shape = {ShapeKind::sphere, Eigen::Vector3d::Constant(2 * length("sphere/radius"))};
    } else {
        const auto size = geometry.value("plane/size").numbers();
        shape = {ShapeKind::plane, {size.empty() ? 1 : size[0], size.empty() ? 1 : size[1], 0}};
    }
    check_size(in, shape, geometry.children().front().where());
    return shape;
}

Material read_material(SdfSource& in, const xml::Element& visual) {
    Material material;
    const xml::Element e = visual.child("material");
    if (!e) return material;
    if (const xml::Element script = e.child("script")) {
        const std::string name = script.value("name").text();
        std::string uri, folder;
        for (const xml::Element& u : script.children("uri"))
            if (const auto text = u.value().text(), found = in.found(u);
                text.starts_with("model://") || fs::is_directory(found))
                uri = text, folder = found;
        if (!uri.empty()) {
            material.ambient = material.diffuse = Colour::Ones();
            material.texture = texture_of(in, script, uri, folder, name);
        } else if (const auto known = named_material(name)) {
            material = *known;
        } else {
            in.diagnostics.error(script.where(), fmt::format("there is no material '{}'", name),
                                 suggest(name, material_names()));
        }
    }
    material.ambient = read_colour(e.value("ambient"), material.ambient);
    material.diffuse = read_colour(e.value("diffuse"), material.diffuse);
    return material;
}

}  // namespace forage::bug
