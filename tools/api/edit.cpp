#include <filesystem>

#include <fmt/format.h>
#include <forage/system.h>

#include "bug_interface/world/sdf_edit.h"
#include "core/base/output_files.h"
#include "core/model/refused.h"
#include "tools/api/document.h"
#include "tools/api/operations.h"
#include "tools/api/sources.h"
#include "tools/api/world_operations.h"

namespace forage {
namespace {

using nlohmann::json;

/// What `carry_out` returns for each operation. Throws InputError for all that it refuses.
template <class CarryOut>
json carry_out_all(const std::string& operations, CarryOut carry_out) {
    json all = json::parse(operations, nullptr, false);
    if (all.is_object()) all = json::array({std::move(all)});
    if (!all.is_array()) throw InputError("the operations are not a list in JSON");
    json made = json::array();
    try {
        for (const auto& o : all) made.push_back(carry_out(o));
    } catch (const model::Refused& e) {
        throw InputError(e.what(), e.hint());
    } catch (const std::invalid_argument& e) {
        throw InputError(e.what());
    } catch (const json::exception& e) {
        throw InputError(e.what(), "docs/design/studio-protocol.md lists the members of each operation");
    }
    return made;
}

json edit_world(const std::string& path, const std::string& operations, const std::string& save_as) {
    std::string text = read_input_file(path);
    bug::ModelTexts models(path);
    json made = carry_out_all(operations,
                              [&](const json& o) { return editing::carry_out_in_world(o, text, models); });
    Diagnostics diagnostics;
    bug::check_world_text(save_as, text, diagnostics);
    throw_errors(diagnostics);
    write_file(save_as, text);
    return made;
}

json edit_system(const std::string& path, const std::string& operations, const std::string& save_as,
                 const std::vector<std::string>& plugins) {
    auto document = Document::open(path);
    Diagnostics diagnostics;
    const auto types = known_types(load_plugins(plugins, path, diagnostics));
    throw_errors(diagnostics);
    json made;
    document.edit(
        [&](model::System& system) {
            made = carry_out_all(operations,
                                 [&](const json& o) { return editing::carry_out(o, system, types, path); });
        },
        "edit");
    document.save(save_as == path ? std::string() : save_as, types, true);
    return made;
}

}  // namespace

std::string edit(SystemFile& file, const std::string& operations) {
    model::System edited = file.model;
    const json made = carry_out_all(
        operations, [&](const json& o) { return editing::carry_out(o, edited, *file.types, file.path); });
    file.model = std::move(edited);
    return made.dump();
}

std::string edit_file(const std::string& path, const std::string& operations, const std::string& save_as,
                      const std::vector<std::string>& plugins) {
    const auto kind = std::filesystem::path(path).extension();
    const std::string& to = save_as.empty() ? path : save_as;
    if (std::filesystem::path(to).extension() != kind)
        throw InputError(fmt::format("'{}' does not end with {}, as '{}' does", to, kind.string(), path));
    if (kind == ".world") return edit_world(path, operations, to).dump();
    if (kind == ".iqr") return edit_system(path, operations, to, plugins).dump();
    throw InputError(fmt::format("'{}' is neither a system nor a world", path), ".iqr or .world");
}

}  // namespace forage
