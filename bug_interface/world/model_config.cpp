#include "bug_interface/world/model_config.h"

#include <fmt/format.h>

#include "bug_interface/world/sdf_values.h"
#include "core/base/named_file.h"
#include "core/xml/element.h"

namespace forage::bug {
namespace {

namespace fs = std::filesystem;
constexpr const char* what_to_write = "<sdf version=\"1.4\">model.sdf</sdf>";

/// The <sdf> of the newest version; null when there is none. Those without a version are the oldest.
const xml::Element* newest(const xml::Element& model) {
    const xml::Element* out = nullptr;
    int newest = -1;
    for (const auto& e : model.children) {
        if (e.name != "sdf") continue;
        const auto* version = e.attribute("version");
        const int minor = version ? sdf_version(version->value).value_or(0) : 0;
        if (minor > newest) newest = minor, out = &e;
    }
    return out;
}

}  // namespace

std::optional<std::string> file_of_model(const fs::path& folder, const Location& where,
                                         Diagnostics& diagnostics) {
    fs::path config = folder / "model.config";
    if (!fs::exists(config)) config = folder / "manifest.xml";
    if (!fs::exists(config)) {
        diagnostics.error(where,
                          fmt::format("the folder '{}' of this model has no model.config", folder.string()),
                          "it says which file holds the model; copy it from another model");
        return {};
    }
    constexpr std::size_t most_nodes = 1000, largest_file = std::size_t{1} << 20;
    auto text = read_file(config.string(), largest_file, diagnostics);
    if (!text) return {};
    const auto model = xml::parse_element(config, std::move(*text), "<model>", most_nodes, diagnostics);
    if (!model) return {};
    const xml::Element* sdf = newest(*model);
    if (!sdf || sdf->text.empty()) {
        diagnostics.error(sdf ? sdf->where : model->where, "this does not say which file holds the model",
                          what_to_write);
        return {};
    }
    const fs::path file = folder / sdf->text;
    if (!fs::is_regular_file(file)) {
        diagnostics.error(sdf->text_where, fmt::format("there is no file '{}'", file.string()),
                          what_to_write);
        return {};
    }
    return file.string();
}

}  // namespace forage::bug
