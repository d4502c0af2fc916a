#include "tools/api/edit/part_operations.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/capitalized.h"
#include "core/base/text_file.h"
#include "core/model/build.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "core/model/names.h"
#include "core/model/parts.h"
#include "core/run/input_error.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"

namespace forage::editing {
namespace {

namespace fs = std::filesystem;

constexpr const char* ending = ".iqrProcess";

/// The path of a file as the system writes it: relative to its own file, or absolute before the first save
/// and for a file with which it has no folder in common, such as those that are installed.
std::string path_in(const std::string& system, const std::string& file) {
    const auto there = fs::absolute(file).lexically_normal();
    if (system.empty()) return there.string();
    const auto here = fs::absolute(system).lexically_normal().parent_path();
    const bool apart =
        here.relative_path().empty() || *here.relative_path().begin() != *there.relative_path().begin();
    return apart ? there.string() : fs::relative(there, here).generic_string();
}

/// Reads the content of the files that the system uses, as if its own file had been read. Throws InputError.
void read_uses(model::System& system, const std::string& path) {
    Diagnostics diagnostics;
    auto read =
        xml::parse_system(path.empty() ? "untitled.iqr" : path, xml::write_system(system), diagnostics);
    throw_errors(diagnostics);
    system = *std::move(read);
}

/// The ids in a file without ports are kept, so they must be free.
void refuse_taken_ids(const model::System& system, const model::ProcessFile& file, const std::string& path) {
    const auto refuse_taken = [&](const std::string& id) {
        const auto has_it = [&](const auto& item) { return item.id == id; };
        const auto in_process = [&](const auto& p) {
            return has_it(p) || std::ranges::any_of(p.groups, has_it);
        };
        if (std::ranges::any_of(system.processes, in_process) ||
            std::ranges::any_of(system.connections, has_it))
            throw InputError(fmt::format("'{}' has the id '{}', which the system has, too", path, id),
                             "import the process instead: it gets ids of its own");
    };
    for (const auto& g : file.process.groups) refuse_taken(g.id);
    for (const auto& connection : file.connections) refuse_taken(connection.id);
}

/// A text up to the first point, or to the colon after which a comment has its source, in one line.
std::string first_sentence(const std::string& text) {
    std::string out;
    for (const char c : std::string(model::trim(text)) + " ") {
        const bool blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
        if (blank && (out.ends_with('.') || out.ends_with(':'))) break;
        if (!blank || !out.ends_with(' ')) out += blank ? ' ' : c;
    }
    while (out.ends_with(' ') || out.ends_with('.') || out.ends_with(':')) out.pop_back();
    return out.empty() ? out : out + '.';
}

}  // namespace

std::string use_part(model::System& system, const std::string& file, const std::string& name,
                     const std::string& id, const EditFiles& files) {
    Diagnostics diagnostics;
    const auto part = checked(diagnostics, xml::read_process(file, diagnostics));
    if (part->process.ports.empty()) refuse_taken_ids(system, *part, file);
    auto made = model::use_part(system, *part, path_in(files.system(), file), name, id);
    read_uses(system, files.system());
    return made;
}

std::vector<std::string> make_part(model::System& system, const Registry& registry, const std::string& id,
                                   const std::string& file, bool overwrite, EditFiles& files) {
    if (fs::path(file).extension() != ending)
        throw InputError(fmt::format("'{}' is not a name of a process file", file),
                         fmt::format("it ends with {}", ending));
    auto made = model::make_part(system, id, path_in(files.system(), file));
    // Names of files in the process lead to the same files from its new place.
    auto part = model::system_of(std::move(made.file));
    const std::string name(model::trim(part.processes.front().name));
    model::move_files(part, files.system().empty() ? "untitled.iqr" : files.system(), file, registry);
    model::ProcessFile content{
        part.processes.front(), part.connections, part.neuron_types, part.synapse_types, {}};
    files.write(file, xml::write_process(content), overwrite);
    read_uses(system, files.system());
    if (!made.renamed.empty())
        files.warnings.warning(
            {},
            fmt::format("'{}' has {} groups and connections whose ids begin with '{}.' now: runs draw other "
                        "random numbers than before",
                        name, made.renamed.size(), id),
            "numbers stay for ids that begin with that of their process");
    return made.renamed;
}

std::vector<PartSummary> parts_in(const std::string& folder) {
    std::vector<PartSummary> out;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed)) {
        std::error_code ignored;
        if (entry.path().extension() != ending || !entry.is_regular_file(ignored)) continue;
        const std::string path = entry.path().string();
        Diagnostics diagnostics;
        const auto file = xml::read_process(path, diagnostics);
        if (!file || diagnostics.failed() || file->process.ports.empty()) continue;
        PartSummary part;
        part.file = path, part.name = model::trim(file->process.name);
        const auto& comments = file->process.comments;
        part.about = first_sentence(comments.empty() ? file->process.note.value_or("") : comments.front());
        for (const auto& port : file->process.ports) part.ports.push_back(port.name);
        for (const auto& c : file->process.constants) part.constants.push_back(c.name);
        out.push_back(std::move(part));
    }
    std::ranges::sort(out, {}, &PartSummary::name);
    return out;
}

std::vector<ShippedSystem> shipped_systems(const std::string& folder) {
    std::vector<ShippedSystem> out;
    const fs::path root = folder;
    std::error_code none;
    if (!fs::exists(root / "examples.json", none)) return out;
    for (const auto& entry : nlohmann::json::parse(read_file((root / "examples.json").string()))) {
        ShippedSystem shipped{entry.at("file"), {}, {}, entry.at("kind"), {}};
        const std::string path = (root / shipped.file).string();
        if (!fs::exists(path, none)) continue;
        const std::string text = read_file(path);
        Diagnostics diagnostics;
        const auto system = xml::parse_system(path, text, diagnostics);
        if (!system || diagnostics.failed()) continue;
        shipped.name = model::trim(system->name);
        if (const auto begin = text.find("<!--"), end = text.find("-->"); end != text.npos && begin < end) {
            std::string_view comment = model::trim(std::string_view(text).substr(begin + 4, end - begin - 4));
            if (const auto colon = comment.find(':');
                colon < 40 && comment.substr(0, colon).find(shipped.name) != comment.npos)
                comment.remove_prefix(colon + 1);  // "Oscillator: a cell that ..."
            shipped.about = capitalized(first_sentence(std::string(comment)));
        }
        if (const auto world = entry.find("world"); world != entry.end())
            shipped.world = (root / "worlds" / (world->get<std::string>() + ".world")).string();
        out.push_back(std::move(shipped));
    }
    return out;
}

}  // namespace forage::editing
