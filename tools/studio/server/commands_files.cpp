#include <algorithm>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "tools/api/describe_json.h"
#include "tools/studio/server/command_functions.h"
#include "tools/studio/server/plot_layout.h"

namespace forage::studio {

std::filesystem::path Commands::folder() {
    const auto parent = std::filesystem::path(s.input_.system).parent_path();
    return parent.empty() ? "." : parent;
}

std::string Commands::layout_path(const std::string& name) {
    if (name.empty() || name != file_name(name) || name.starts_with("."))
        throw InputError(fmt::format("'{}' is not a name of a layout", name),
                         "letters, digits, '.', '-' and '_'");
    return (folder() / (name + ".layout.json")).string();
}

json Commands::layouts() {
    json out = json::array();
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
        const std::string name = entry.path().filename().string();
        if (constexpr std::string_view end = ".layout.json"; name.ends_with(end))
            out.push_back(name.substr(0, name.size() - end.size()));
        else if (name.ends_with(".conf") && name == file_name(name))
            out.push_back(name);
    }
    std::sort(out.begin(), out.end());
    return {{"layouts", std::move(out)}};
}

json Commands::layout_read() {
    const auto name = c.at("name").get<std::string>();
    if (name.ends_with(".conf") && name == file_name(name)) {
        const auto path = (folder() / name).string();
        return {{"content", plot_layout(run(), path, read_file(path))}};
    }
    const auto path = layout_path(name);
    const json content = json::parse(read_file(path), nullptr, false);
    if (content.is_discarded()) throw InputError(fmt::format("'{}' is not a layout", path));
    return {{"content", content}};
}

json Commands::layout_convert() {
    return {{"content", plot_layout(run(), c.value("file", "plots.conf"), c.at("text").get<std::string>())}};
}

json Commands::layout_write() {
    const auto path = layout_path(c.at("name").get<std::string>());
    check_new(path);
    write_file(path, c.at("content").dump(1) + "\n");
    return {{"file", path}};
}

json Commands::panels_keep() {
    s.panels_ = c.at("content");
    s.saved_version_.reset();
    return json::object();
}

std::string Commands::panel_path(const char* ending) {
    auto path = c.at("file").get<std::string>();
    if (!path.ends_with(ending)) throw InputError(fmt::format("the name of the file ends with {}", ending));
    return path;
}

void Commands::check_free(const std::string& path) const {
    refuse_shipped(path);
    check_new(path);
}

void Commands::check_new(const std::string& path) const {
    if (!c.value("overwrite", false) && std::filesystem::exists(path))
        throw FileExists(fmt::format("'{}' exists", path), "overwrite it, or choose another name");
}

std::vector<xml::PanelRow> Commands::panel_rows(const char* ending) {
    const auto path = panel_path(ending);
    Diagnostics diagnostics;
    auto rows = xml::parse_panel(path, read_file(path), diagnostics);
    throw_errors(diagnostics);
    return rows;
}

json Commands::one_parameter(const std::string& item, const std::string& name) {
    json found = describe_parameters(run(), item);
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

xml::PanelRow Commands::row_of(const json& p) {
    auto type = p["owner"].get<std::string>();
    std::transform(type.begin(), type.end(), type.begin(),
                   [](char l) { return static_cast<char>(l - 'a' + 'A'); });
    return {type,
            p["id"],
            p["name"],
            p["label"],
            p["value"].is_string() ? p["value"].get<std::string>() : p["value"].dump(),
            {}};
}

json Commands::panel_read() {
    json rows = json::array();
    for (const auto& r : panel_rows(".hconf")) rows.push_back(one_parameter(r.id, r.parameter));
    return {{"rows", std::move(rows)}};
}

std::vector<xml::PanelRow> Commands::wanted_rows() {
    std::vector<xml::PanelRow> rows;
    for (const auto& r : c.at("rows"))
        rows.push_back(
            row_of(one_parameter(r.at("item").get<std::string>(), r.at("parameter").get<std::string>())));
    return rows;
}

json Commands::panel_write() {
    const auto path = panel_path(".hconf");
    const auto rows = wanted_rows();
    check_free(path);
    write_file(path, xml::panel_text(rows, false));
    return {{"file", path}};
}

json Commands::parameters_read() {
    std::vector<std::string> assignments, missing;
    for (const auto& r : panel_rows(".pconf")) {
        try {
            assignments.push_back(one_parameter(r.id, r.parameter)["assignment"].get<std::string>() + "=" +
                                  r.value);
        } catch (const InputError& e) {  // the file may be of a larger system
            missing.emplace_back(e.diagnostics().all().front().message);
        }
    }
    const auto file = c.at("file").get<std::string>();
    if (assignments.empty())
        throw InputError(fmt::format("'{}' has no parameter of this system", file),
                         missing.empty() ? "it is empty" : missing.front());
    json out = set(assignments, "parameters of " + file, true);
    out["set"] = assignments.size(), out["missing"] = std::move(missing);
    return out;
}

json Commands::parameters_write() {
    const auto path = panel_path(".pconf");
    check_free(path);
    if (c.contains("rows")) {
        const auto chosen = wanted_rows();
        write_file(path, xml::panel_text(chosen, true));
        return {{"file", path}, {"rows", chosen.size()}};
    }
    std::vector<std::string> items = c.value("items", std::vector<std::string>());
    if (items.empty())
        for (const auto& p : run().system().processes) {
            if (p.module) items.push_back(p.id);
            for (const auto& g : p.groups) items.push_back(g.id);
        }
    if (!c.contains("items"))
        for (const auto& connection : run().system().connections) items.push_back(connection.id);
    std::vector<xml::PanelRow> rows;
    for (const auto& item : items) {
        const json found = describe_parameters(run(), item);
        for (json p : found["parameters"]) {
            p["id"] = found["id"], p["owner"] = found["kind"];
            rows.push_back(row_of(p));
        }
    }
    write_file(path, xml::panel_text(rows, true));
    return {{"file", path}, {"rows", rows.size()}};
}

}  // namespace forage::studio
