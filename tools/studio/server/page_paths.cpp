#include "tools/studio/server/page_paths.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/number.h"
#include "core/base/output_files.h"
#include "core/base/text_file.h"
#include "core/model/arrays.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "modules/devices/gamepad/evdev.h"
#include "tools/api/edit/json_text.h"
#include "tools/api/edit/operations.h"
#include "tools/studio/server/commands/shared.h"

namespace forage::studio {
namespace {

namespace fs = std::filesystem;

/// The name of the first element of a text; empty when something else comes before it.
std::string_view first_element(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const auto skip_past = [&](std::string_view end) {
        const auto at = text.find(end);
        text.remove_prefix(at == text.npos ? text.size() : at + end.size());
    };
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        if (text.starts_with("<?"))
            skip_past("?>");
        else if (text.starts_with("<!--"))
            skip_past("-->");
        else if (text.starts_with("<!DOCTYPE"))
            skip_past(text.substr(0, text.find('>')).find('[') == text.npos ? ">" : "]>");
        else
            break;
    }
    if (!text.starts_with('<')) return {};
    text.remove_prefix(1);
    return text.substr(0, text.find_first_of(" \t\r\n/>"));
}

/// The parts of a text between separators.
std::vector<std::string_view> split_at(std::string_view separators, std::string_view text) {
    std::vector<std::string_view> out;
    while (!text.empty()) {
        const auto end = std::min(text.find_first_of(separators), text.size());
        out.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

/// The lines of a text that are no comments.
std::vector<std::string_view> rows_of(std::string_view text) {
    auto out = split_at("\n", text);
    std::erase_if(out, [](auto line) { return line.starts_with('#') || model::trim(line).empty(); });
    return out;
}

bool is_number(std::string_view field) { return parse_number<double>(model::trim(field)).has_value(); }
bool is_number_or_blank(std::string_view field) { return is_number(field) || model::trim(field).empty(); }

bool holds_patterns(std::string_view text) {
    const auto rows = rows_of(text);
    return !rows.empty() && std::ranges::all_of(rows, [](auto row) {
        return std::ranges::all_of(split_at(" \t\r,;", row), is_number_or_blank);
    });
}

bool holds_table(std::string_view text) {
    const auto rows = rows_of(text);
    return !rows.empty() && std::ranges::all_of(rows, [](auto row) {
        if (row.starts_with("cycle,")) return true;
        const auto fields = split_at(",\r", row);
        return std::ranges::count(row, ',') >= 3 && is_number(fields[0]) &&
               std::all_of(fields.begin() + 3, fields.end(), is_number_or_blank);
    });
}

constexpr std::string_view numpy = "\x93NUMPY";

bool holds_numbers(std::string_view text) {
    if (text.starts_with(numpy)) return true;
    return std::ranges::any_of(rows_of(text), [](auto row) {  // a column beside the numbers may have names
        return std::ranges::any_of(split_at(",", row), is_number);
    });
}

bool holds_recording(std::string_view text) {
    using namespace std::string_view_literals;
    if (text.starts_with(numpy) || text.starts_with("\x89HDF\r\n\x1a\n"sv)) return true;
    const auto rows = rows_of(text);
    return !rows.empty() && (rows[0].starts_with("cycle,") || rows[0].starts_with("cycle;") ||
                             model::trim(rows[0]) == "cycle");
}

bool holds_layout(std::string_view text) {
    if (size_of_json(text).depth > 100) return false;
    const auto content = nlohmann::json::parse(text, nullptr, false);
    return content.is_object() && (content.contains("dock") || content.contains("plots"));
}

struct KindOfFile {
    FileKind kind;
    const char* name;
    std::vector<std::string> endings;
    std::vector<std::string_view> roots;  ///< the names of its first element; none when it is not XML
    const char* begins;
    bool (*holds)(std::string_view text) = nullptr;  ///< of what is not XML
};

const KindOfFile& about(FileKind kind) {
    static const std::vector<KindOfFile> all = {
        {FileKind::system, "a system", {".iqr"}, {"System"}, "it begins with <System>"},
        {FileKind::process, "a process", {".iqrProcess"}, {"iqrEntity"}, "it begins with <iqrEntity>"},
        {FileKind::world, "a world", {".world"}, {"sdf", "gazebo"}, "it begins with <sdf>"},
        {FileKind::plots,
         "a configuration of plots",
         {".conf"},
         {"iqrDataManagerConfiguration"},
         "it begins with <iqrDataManagerConfiguration>"},
        {FileKind::panel, "a panel", {".hconf"}, {"HarborConfig"}, "it begins with <HarborConfig>"},
        {FileKind::parameters, "a set of parameters", {".pconf"}, {"ParamSet"}, "it begins with <ParamSet>"},
        {FileKind::layout,
         "a layout",
         {".layout.json"},
         {},
         "it is JSON with 'dock' or 'plots'",
         holds_layout},
        {FileKind::patterns, "a file of patterns", {".txt"}, {}, "it holds numbers only", holds_patterns},
        {FileKind::table, "a table", {".csv"}, {}, "a row is cycle,process,target,v0,v1,...", holds_table},
        {FileKind::numbers,
         "a file of numbers",
         {".npy", ".csv"},
         {},
         "it is of NumPy, or its rows have numbers with commas between them",
         holds_numbers},
        {FileKind::recording,
         "a recording",
         {".csv", ".dat", ".npy", ".h5"},
         {},
         "its first column is 'cycle', or it is of NumPy or HDF5",
         holds_recording},
        {FileKind::camera, "a camera", {}, {}, "a page may name a device /dev/video*"},
        {FileKind::gamepad,
         "a gamepad",
         {},
         {},
         "a page may name a device of /dev/input, or a file with its records",
         gamepad::are_records}};
    return *std::ranges::find(all, kind, &KindOfFile::kind);
}

constexpr std::size_t max_beginning = std::size_t{4} << 20;

/// The beginning of a regular file; empty when it cannot be opened. Throws InputError for something else.
std::optional<std::string> beginning_of(const std::string& path) {
    if (path.find('\0') != path.npos) throw InputError("a path has a NUL character");
    const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return std::nullopt;
    struct stat about = {};
    const bool regular = fstat(file, &about) == 0 && S_ISREG(about.st_mode);
    std::string out;
    std::array<char, std::size_t{1} << 16> block;
    while (regular && out.size() < max_beginning) {
        const auto count = ::read(file, block.data(), block.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        out.append(block.data(), static_cast<std::size_t>(count));
    }
    ::close(file);
    if (!regular) throw InputError(fmt::format("'{}' is not a file", path), "a page reads and writes files");
    if (out.size() >= max_beginning && out.find('\n') != out.npos)
        out.resize(out.rfind('\n') + 1);  // its last line may be cut
    return out;
}

/// Modules that read or write a file or device. The films of moduleVideo are checked by ffmpeg, which gets
/// a list of formats.
struct ModuleFile {
    std::string_view type, parameter;
    FileKind kind;
    std::string_view device = {};  ///< how the names of its devices begin
};
constexpr ModuleFile module_files[] = {{"moduleReplay", "file", FileKind::table},
                                       {"moduleAL", "File Name", FileKind::patterns},
                                       {"moduleVideo", "DeviceName", FileKind::camera, "/dev/video"},
                                       {"moduleJoystick", "DeviceName", FileKind::gamepad, "/dev/input/"}};

/// The file or device that a parameter of a type of modules names; null when it is not known.
const ModuleFile* module_file(std::string_view type, std::string_view parameter) {
    const auto* const found = std::ranges::find_if(
        module_files, [&](const auto& f) { return f.type == type && f.parameter == parameter; });
    return found == std::end(module_files) ? nullptr : found;
}

/// Whether a path leads to a device whose name begins so.
bool is_device(const std::string& path, std::string_view beginning) {
    std::error_code none;
    return !beginning.empty() && fs::canonical(path, none).string().starts_with(beginning) &&
           fs::is_character_file(path, none);
}

}  // namespace

bool is_of_kind(std::string_view text, FileKind kind) {
    if (model::trim(text).empty()) return true;
    const auto& file = about(kind);
    return file.holds ? file.holds(text) : std::ranges::count(file.roots, first_element(text)) > 0;
}

void check_readable(const std::string& path, std::initializer_list<FileKind> kinds) {
    if (const auto text = beginning_of(path);
        text && std::ranges::none_of(kinds, [&](auto kind) { return is_of_kind(*text, kind); }))
        throw InputError(fmt::format("'{}' is not {}", path, about(*kinds.begin()).name),
                         about(*kinds.begin()).begins);
}

void check_replaceable(const Session& session, const std::string& path, FileKind kind) {
    if (kind != FileKind::layout) refuse_shipped(session, path);  // layouts are beside their system
    std::error_code none;
    if (fs::is_symlink(path, none) && !fs::exists(path, none))
        throw InputError(fmt::format("'{}' is a link to a file that does not exist", path),
                         "choose another name");
    if (const auto part = fs::symlink_status(partial(path), none);
        fs::exists(part) && part.type() != fs::file_type::regular)
        throw InputError(fmt::format("'{}' is not a file", partial(path)), "choose another name");
    if (!fs::exists(path, none)) return;
    check_readable(path, {kind});
    if (access(path.c_str(), R_OK) != 0)
        throw InputError(fmt::format("'{}' cannot be read, so it is not replaced", path),
                         "choose another name");
}

void check_writable(const Session& session, const std::string& path, FileKind kind, bool overwrite) {
    const auto& file = about(kind);
    if (std::ranges::none_of(file.endings, [&](const auto& e) { return path.ends_with(e); }))
        throw InputError(fmt::format("'{}' is not a name of {}", path, file.name),
                         fmt::format("it ends with {}", fmt::join(file.endings, ", ")));
    const auto folder = fs::path(path).parent_path();
    std::error_code none;
    if (!folder.empty() && !fs::is_directory(folder, none))
        throw InputError(fmt::format("there is no folder '{}'", folder.string()),
                         "choose a folder that exists");
    check_replaceable(session, path, kind);
    if (!overwrite && fs::exists(path, none))
        throw FileExists(fmt::format("'{}' exists", path), "overwrite it, or choose another name");
}

std::string shipped_path(const Session& session, const std::string& name) {
    const fs::path path = name;
    if (path.is_absolute() || std::ranges::find(path, "..") != path.end())
        throw InputError(fmt::format("'{}' is not a name of a file that comes with Forage", name),
                         "such as tutorial/reflex.iqr");
    return (fs::path(session.shipped()) / path).string();
}

void check_parameter_file(const std::string& type, const Parameter& parameter, const std::string& path) {
    const auto* file = module_file(type, parameter.name);
    if (path.empty() || (!file && !parameter.is_path)) return;
    if (!file) return static_cast<void>(beginning_of(path));  // plugins are trusted with files, not devices
    if (!is_device(path, file->device)) check_readable(path, {file->kind});
}

bool check_system_files(const model::System& system, const Registry& registry, Diagnostics& diagnostics) {
    const int errors = diagnostics.errors();
    const auto report = [&](const Location& at, const auto& check) {
        try {
            check();
        } catch (const InputError& e) {
            const auto& found = e.diagnostics().all().front();
            diagnostics.error(at, found.message, found.hint);
        }
    };
    model::each_item(system, [&](auto owner, const auto&, const model::TypeUse* use) {
        const auto* parameters = use ? model::parameters_of(registry, owner, use->type) : nullptr;
        if (!parameters) return;
        for (const auto& s : use->settings)
            if (const auto* p = find_by(*parameters, s.name, &Parameter::name))
                report(s.value_at, [&] {
                    check_parameter_file(use->type, *p,
                                         p->is_path ? model::resolved(s.value, s.value_at) : s.value);
                });
    });
    model::each_array(system.processes, system.connections, [&](const auto& item) {
        if (!item.file.empty())
            report(item.file_at,
                   [&] { check_readable(model::resolved(item.file, item.file_at), {FileKind::numbers}); });
    });
    return diagnostics.errors() == errors;
}

void check_operation_files(const Session& session, const nlohmann::json& operations) {
    for (const auto& o : operations) {
        const auto name = o.find("do");
        const auto* declared = name != o.end() && name->is_string()
                                   ? find_by(editing::system_operations(), name->get<std::string>(),
                                             &editing::Operation<editing::SystemEdit>::name)
                                   : nullptr;
        if (!declared) continue;  // it is rejected when it is carried out
        const bool writes = contains(declared->members, "overwrite", &schema::Member::name);
        for (const auto& m : declared->members) {
            const auto given = o.find(m.name);
            if (m.type.kind != schema::ValueType::Kind::path || given == o.end() || !given->is_string())
                continue;
            const auto path = given->get<std::string>();
            if (writes)
                check_writable(session, path, FileKind::process, o.value("overwrite", json()) == true);
            else
                check_readable(path, {FileKind::process});
        }
    }
}

bool may_quote(const SourceFile& file) {
    const auto has_root = [&](auto... names) {
        const auto root = first_element(file.text);
        return ((root == names) || ...);
    };
    if (has_root("System", "iqrEntity", "sdf", "gazebo", "model", "iqrDataManagerConfiguration",
                 "HarborConfig", "ParamSet") ||
        is_of_kind(file.text, FileKind::patterns) || is_of_kind(file.text, FileKind::table))
        return true;
    try {
        return !read_file(file.path).starts_with(file.text);  // else a page has written the text
    } catch (const FileError&) {
        return true;
    }
}

}  // namespace forage::studio
