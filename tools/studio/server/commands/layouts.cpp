#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "tools/api/edit/json_text.h"
#include "tools/studio/server/commands/shared.h"
#include "tools/studio/server/page_paths.h"
#include "tools/studio/server/plot_layout.h"

namespace forage::studio {
namespace {

constexpr std::string_view layout_ending = ".layout.json";

bool is_plot_config(const std::string& name) { return name.ends_with(".conf") && name == file_name(name); }

std::string layout_path(const Session& s, const std::string& name) {
    if (name.empty() || name != file_name(name) || name.starts_with("."))
        throw InputError(fmt::format("'{}' is not a name of a layout", name),
                         "letters, digits, '.', '-' and '_'");
    return (system_folder(s) / (name + std::string(layout_ending))).string();
}

json list_layouts(Session& s, const Request&) {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(system_folder(s))) {
        const std::string name = entry.path().filename().string();
        if (name.ends_with(layout_ending))
            out.push_back(name.substr(0, name.size() - layout_ending.size()));
        else if (is_plot_config(name))
            out.push_back(name);
    }
    std::ranges::sort(out);
    return {{"layouts", out}};
}

json read_saved_layout(Session& s, const Request& r) {
    const auto& name = r.text("name");
    if (is_plot_config(name)) {
        const auto path = (system_folder(s) / name).string();
        check_readable(path, {FileKind::plots});
        return {{"content", plot_layout(s.run(), path, read_file(path))}};
    }
    const auto path = layout_path(s, name);
    check_readable(path, {FileKind::layout});
    return {{"content", parse_json(read_file(path), path)}};
}

json convert_layout(Session& s, const Request& r) {
    if (!is_of_kind(r.text("text"), FileKind::plots))
        throw InputError("the text is no configuration of plots",
                         "it begins with <iqrDataManagerConfiguration>");
    return {{"content", plot_layout(s.run(), r.text("file"), r.text("text"))}};
}

json write_layout(Session& s, const Request& r) {
    const auto path = layout_path(s, r.text("name"));
    const auto text = r["content"].dump(1) + "\n";
    if (!is_of_kind(text, FileKind::layout))
        throw InputError("the content is not that of a layout", "an object with 'dock' or 'plots'");
    check_writable(s, path, FileKind::layout, r.flag("overwrite"));
    write_file(path, text);
    return {{"file", path}};
}

json keep_panels(Session& s, const Request& r) {
    s.pages.panels = r["content"];
    s.recovery.version.reset();
    return json::object();
}

}  // namespace

std::filesystem::path system_folder(const Session& s) {
    const auto parent = std::filesystem::path(s.edited.input.system).parent_path();
    return parent.empty() ? "." : parent;
}

std::vector<Command> layout_commands() {
    const Member content{"content", record({}), "any object"};
    const std::string found = "{ content: LayoutContent }";
    return {
        {.name = "layouts",
         .doc = "Lists the layouts beside the system: `NAME.layout.json`, and `NAME.conf` of the original.",
         .result = "{ layouts: string[] }",
         .apply = list_layouts},
        {.name = "layout_read",
         .doc = "Reads a layout beside the system.",
         .arguments = {{"name", path(), "of a `.conf` with its ending"}},
         .result = found,
         .apply = read_saved_layout},
        {.name = "layout_convert",
         .doc = "Converts the text of a `.conf` of the original.",
         .arguments = {{"text", text()}, optional("file", path(), "plots.conf", "a name for messages")},
         .result = found,
         .apply = convert_layout},
        {.name = "layout_write",
         .doc = "Writes a layout beside the system.",
         .arguments = {{"name", path()}, content, optional("overwrite", boolean(), false)},
         .result = "{ file: string }",
         .apply = write_layout},
        {.name = "panels_keep",
         .doc = "Keeps the arrangement of the panels, which outlives the page and a crash of the program.",
         .arguments = {content},
         .apply = keep_panels},
    };
}

}  // namespace forage::studio
