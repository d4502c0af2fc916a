#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <forage/system.h>
#include <nlohmann/json.hpp>

#include "core/base/output_files.h"
#include "core/model/refused.h"
#include "tools/api/edit/document.h"
#include "tools/api/edit/edit_files.h"
#include "tools/api/edit/json_text.h"
#include "tools/api/edit/operations.h"
#include "tools/api/edit/world_operations.h"
#include "tools/api/open/sources.h"

namespace forage {
namespace {

using nlohmann::json;

/// One operation as a list of one.
json list_of(const std::string& operations) {
    json all = parse_json(operations);
    if (all.is_object()) return json::array({std::move(all)});
    if (!all.is_array()) throw InputError("the operations are not a list");
    return all;
}

/// The result of `carry_out`, which carries out the operation with this number, from 0. Throws InputError for
/// all that it refuses.
template <class CarryOut>
json attempt(const json& all, std::size_t number, CarryOut carry_out) {
    const auto which = all.size() > 1 ? fmt::format("operation {}: ", number + 1) : std::string();
    if (!all[number].is_object())
        throw InputError(which + "an operation is an object", R"({"do": "rename", "id": "a", "name": "B"})");
    try {
        return carry_out(all[number]);
    } catch (const InputError& e) {
        Diagnostics found;
        for (auto d : e.diagnostics().all())
            d.message = (found.all().empty() ? which : "") + d.message, found.add(std::move(d));
        throw InputError(std::move(found));
    } catch (const model::Refused& e) {
        throw InputError(which + e.what(), e.hint());
    } catch (const std::invalid_argument& e) {
        throw InputError(which + e.what());
    } catch (const json::exception& e) {
        std::string text = e.what();  // "[json.exception.out_of_range.403] key 'do' not found"
        if (const auto end = text.find("] "); end != text.npos) text.erase(0, end + 2);
        throw InputError(which + text, "docs/design/studio-protocol.md lists the members of each operation");
    }
}

/// The mistakes that an edit has made, as warnings.
void add_new_problems(const std::vector<Document::Problem>& before,
                      const std::vector<Document::Problem>& after, Diagnostics& warnings) {
    std::set<std::string> known;
    for (const auto& p : before) known.insert(p.diagnostic.message);
    for (auto p : after) {
        if (known.contains(p.diagnostic.message)) continue;
        p.diagnostic.severity = Severity::warning;
        warnings.add(std::move(p.diagnostic));
    }
}

/// Makes the folder of a file that will be written. Throws InputError.
void prepare(const std::string& path) {
    Diagnostics diagnostics;
    check_output(path, "edited" + std::filesystem::path(path).extension().string(), diagnostics);
    throw_errors(diagnostics);
}

json edit_world(const std::string& path, const json& operations, const std::string& save_as) {
    std::string text = read_input_file(path);
    json made = json::array();
    bug::ModelTexts models(path);
    for (std::size_t i = 0; i < operations.size(); ++i)
        made.push_back(attempt(operations, i,
                               [&](const json& o) { return editing::carry_out_in_world(o, text, models); }));
    editing::check_world(save_as, text);
    prepare(save_as);
    write_file(save_as, text);
    return made;
}

json edit_system(const std::string& path, const json& operations, const std::string& save_as,
                 const std::vector<std::string>& plugins, Diagnostics& warnings) {
    auto document = Document::open(path);
    Diagnostics diagnostics;
    const auto types = checked(diagnostics, known_types(plugins_to_read(plugins, path, diagnostics)));
    const auto before = document.problems(types);
    json made = json::array();
    editing::EditFiles files(path);
    document.edit([&](model::System& system) {
        for (std::size_t i = 0; i < operations.size(); ++i)
            made.push_back(attempt(
                operations, i, [&](const json& o) { return editing::carry_out(o, system, types, files); }));
    });
    prepare(save_as);
    document.save(save_as == path ? std::string() : save_as, types, true);
    files.keep();
    append(&warnings, files.warnings);
    add_new_problems(before, document.problems(types), warnings);
    return made;
}

}  // namespace

std::string edit(SystemFile& file, const std::string& operations, Diagnostics* warnings) {
    const json all = list_of(operations);
    model::System edited = file.model;
    json made = json::array();
    editing::EditFiles files(file.path);
    for (std::size_t i = 0; i < all.size(); ++i)
        made.push_back(attempt(
            all, i, [&](const json& o) { return editing::carry_out(o, edited, *file.types, files); }));
    files.keep();
    file.model = std::move(edited);
    append(warnings, files.warnings);
    return made.dump();
}

std::string edit_file(const std::string& path, const std::string& operations, const std::string& save_as,
                      const std::vector<std::string>& plugins, Diagnostics* warnings) {
    const auto kind = std::filesystem::path(path).extension();
    const std::string& to = save_as.empty() ? path : save_as;
    if (kind != ".world" && kind != ".iqr" && kind != ".xml")
        throw InputError(fmt::format("'{}' is neither a system nor a world", path), ".iqr or .world");
    if (std::filesystem::path(to).extension() != kind)
        throw InputError(fmt::format("'{}' does not end with {}, as '{}' does", to, kind.string(), path));
    const json all = list_of(operations);
    if (kind == ".world") return edit_world(path, all, to).dump();
    Diagnostics found;
    auto made = edit_system(path, all, to, plugins, found).dump();
    append(warnings, found);
    return made;
}

}  // namespace forage
