#include <algorithm>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "core/xml/panel.h"
#include "tools/api/describe/describe_json.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"

namespace forage::studio {
namespace {

std::vector<xml::PanelRow> read_panel(const std::string& path, FileKind kind) {
    check_readable(path, {kind});
    Diagnostics diagnostics;
    auto rows = checked(diagnostics, xml::parse_panel(path, read_file(path), diagnostics));
    return rows;
}

/// The parameter of an item, as `parameters` describes it. Throws InputError.
json one_parameter(Session& s, const std::string& item, const std::string& name) {
    json found = describe_parameters(s.run(), item);
    std::vector<std::string> names;
    for (auto& p : found["parameters"]) {
        if (p["name"] == name || p["assignment"] == name) {
            p["item"] = found["item"], p["id"] = found["id"], p["owner"] = found["kind"];
            return p;
        }
        names.push_back(p["name"]);
    }
    throw InputError(fmt::format("'{}' has no parameter '{}'", item, name), suggest(name, names));
}

xml::PanelRow row_of(const json& p) {
    auto type = p["owner"].get<std::string>();
    std::ranges::transform(type, type.begin(), [](char l) { return static_cast<char>(l - 'a' + 'A'); });
    const auto value = p["value"].is_string() ? p["value"].get<std::string>() : p["value"].dump();
    return {type, p["id"], p["name"], p["label"], value, {}};
}

std::vector<xml::PanelRow> rows_in(Session& s, const Request& r) {
    return collected(r["rows"], [&](const json& row) {
        return row_of(one_parameter(s, row["item"].get<std::string>(), row["parameter"].get<std::string>()));
    });
}

json read_panel_file(Session& s, const Request& r) {
    const auto parameter = [&](const auto& row) { return one_parameter(s, row.id, row.parameter); };
    return {{"rows", collected(read_panel(r.text("file"), FileKind::panel), parameter)}};
}

json write_panel_file(Session& s, const Request& r) {
    const auto& path = r.text("file");
    const auto rows = rows_in(s, r);
    check_writable(s, path, FileKind::panel, r.flag("overwrite"));
    write_file(path, xml::panel_text(rows, false));
    return {{"file", path}};
}

json read_parameter_file(Session& s, const Request& r) {
    const auto& file = r.text("file");
    std::vector<std::string> assignments, missing;
    for (const auto& row : read_panel(file, FileKind::parameters)) {
        try {
            assignments.push_back(one_parameter(s, row.id, row.parameter)["assignment"].get<std::string>() +
                                  "=" + row.value);
        } catch (const InputError& e) {  // the file may be of a larger system
            missing.emplace_back(e.diagnostics().all().front().message);
        }
    }
    if (assignments.empty())
        throw InputError(fmt::format("'{}' has no parameter of this system", file),
                         missing.empty() ? "it is empty" : missing.front());
    json out = set_parameters(s, assignments, "parameters of " + file);
    out["set"] = assignments.size(), out["missing"] = std::move(missing);
    return out;
}

/// All groups, modules and connections.
std::vector<std::string> all_items(const model::System& system) {
    std::vector<std::string> out;
    for (const auto& p : system.processes) {
        if (p.module) out.push_back(p.id);
        for (const auto& g : p.groups) out.push_back(g.id);
    }
    for (const auto& connection : system.connections) out.push_back(connection.id);
    return out;
}

json write_parameter_file(Session& s, const Request& r) {
    const auto& path = r.text("file");
    check_writable(s, path, FileKind::parameters, r.flag("overwrite"));
    std::vector<xml::PanelRow> rows;
    if (r.has("rows")) {
        rows = rows_in(s, r);
    } else {
        for (const auto& item : r.has("items") ? r.texts("items") : all_items(s.run().system())) {
            const json found = describe_parameters(s.run(), item);
            for (json p : found["parameters"]) {
                p["id"] = found["id"], p["owner"] = found["kind"];
                rows.push_back(row_of(p));
            }
        }
    }
    write_file(path, xml::panel_text(rows, true));
    return {{"file", path}, {"rows", rows.size()}};
}

}  // namespace

std::vector<Command> panel_commands() {
    const auto rows = list(record({{"item", text()}, {"parameter", text()}}));
    const auto overwrite = optional("overwrite", boolean(), false);
    const Member panel{"file", path(), "`.hconf`"}, values{"file", path(), "`.pconf`"};
    return {
        {.name = "panel_read",
         .doc = "Reads which parameters a panel of the original shows.",
         .arguments = {panel},
         .result = "{ rows: PanelRow[] }",
         .apply = read_panel_file},
        {.name = "panel_write",
         .doc = "Writes a panel of these parameters.",
         .arguments = {panel, {"rows", rows}, overwrite},
         .result = "{ file: string }",
         .apply = write_panel_file},
        {.name = "parameters_read",
         .doc = "Sets what a file holds and the system has. Rejected when that is nothing.",
         .arguments = {values},
         .result = "{ set: number; missing: string[]; generation: number }",
         .changes_run = true,
         .apply = read_parameter_file},
        {.name = "parameters_write",
         .doc = "Writes the values of parameters.",
         .arguments = {values, optional("rows", rows), optional("items", texts(), nullptr, "by default all"),
                       overwrite},
         .result = "{ file: string; rows: number }",
         .apply = write_parameter_file},
    };
}

}  // namespace forage::studio
