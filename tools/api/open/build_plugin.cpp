#include "tools/api/open/build_plugin.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/program.h"
#include "core/plugin/declarations.h"
#include "core/plugin/plugin.h"
#include "core/run/input_error.h"
#include "tools/api/open/sources.h"

namespace forage {
namespace {

namespace fs = std::filesystem;

constexpr const char* random_library = FORAGE_LIBRARY_DIR "/forage/libforage_random.a";

/// Whether a folder holds the headers and libraries for plugins.
bool is_installation(const fs::path& folder) {
    return fs::exists(folder / FORAGE_INCLUDE_DIR / "forage/plugin.h") && fs::exists(folder / random_library);
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

std::string content(std::FILE* file) {
    std::rewind(file);
    std::string out;
    char buffer[4096];
    while (const auto n = std::fread(buffer, 1, sizeof buffer, file)) out.append(buffer, n);
    return out;
}

struct CompilerError {
    std::string file;
    int line = 0, column = 0;
    std::string message;
};

/// What a line "file:line:column: error: message", of gcc or clang, says. Nothing for other lines.
std::optional<CompilerError> error_in(const std::string& line) {
    std::array<std::size_t, 3> colons;
    colons[0] = line.find(':');
    if (colons[0] == 0 || colons[0] == line.npos) return std::nullopt;
    for (std::size_t k = 1; k < colons.size(); ++k) {
        const auto number = colons[k - 1] + 1;
        colons[k] = line.find_first_not_of("0123456789", number);
        if (colons[k] == number || colons[k] == line.npos || line[colons[k]] != ':') return std::nullopt;
    }
    const std::string_view rest = std::string_view(line).substr(colons[2] + 1);
    for (const std::string_view kind : {" error: ", " fatal error: "})
        if (rest.starts_with(kind) && rest.find('\r') == rest.npos)
            return CompilerError{line.substr(0, colons[0]), std::stoi(line.substr(colons[0] + 1)),
                                 std::stoi(line.substr(colons[1] + 1)),
                                 std::string(rest.substr(kind.size()))};
    return std::nullopt;
}

/// The errors in the messages of gcc and clang. Those of other programs, such as the linker, become one error
/// with all of the text.
void report_compiler(const std::string& said, const std::string& source, Diagnostics& diagnostics) {
    std::ostringstream text;
    if (const File in(std::fopen(source.c_str(), "r"), &std::fclose); in) text << content(in.get());
    const auto own = std::make_shared<const SourceFile>(SourceFile{source, text.str()});
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);) {
        const auto found = error_in(line);
        if (!found) continue;
        const auto file =
            found->file == source ? own : std::make_shared<const SourceFile>(SourceFile{found->file, {}});
        diagnostics.error({file, found->line, found->column}, found->message);
    }
    if (!diagnostics.failed()) diagnostics.error({own, 0, 0}, "it does not compile: " + said.substr(0, 4000));
}

std::vector<std::string> command(const PluginBuild& build, const std::string& compiler,
                                 const std::string& output) {
    const fs::path headers = fs::path(build.installation) / FORAGE_INCLUDE_DIR;
    std::vector<std::string> words = {compiler};
    const char* flags = std::getenv("CXXFLAGS");
    std::istringstream more(flags ? flags : "");
    for (std::string word; more >> word;) words.push_back(word);
    words.insert(words.end(), {"-std=c++20", "-fPIC", "-shared", "-Wall", "-Wextra", "-ffp-contract=off",
                               "-fno-math-errno", "-fno-trapping-math", "-fvisibility=hidden",
                               "-fvisibility-inlines-hidden", "-include",
                               (headers / "forage/core/types/size_checks.h").string(),
                               "-I" + headers.string(), "-I" + (headers / "forage").string()});
    if (build.debug)
        words.insert(words.end(), {"-O0", "-g"});  // without NDEBUG, Eigen checks each index
    else
        words.insert(words.end(), {"-O3", "-DNDEBUG"});
    for (const std::string eigen : {FORAGE_EIGEN_DIR, "/usr/include/eigen3", "/usr/local/include/eigen3"})
        if (fs::exists(eigen)) words.insert(words.end(), {"-isystem", eigen});
    words.insert(words.end(), {build.source, (fs::path(build.installation) / random_library).string(), "-o",
                               partial(output)});
    return words;
}

/// Keeps others from writing a file or a folder: Forage loads no plugin that they may change.
void make_private(const fs::path& path) {
    std::error_code ignored;
    fs::permissions(path, fs::perms::group_write | fs::perms::others_write, fs::perm_options::remove,
                    ignored);
}

/// Compiles to partial(output), loads the result once, and writes its declarations.
void compile_and_check(const PluginBuild& build, const std::string& output, Diagnostics& diagnostics) {
    const char* named = std::getenv("CXX");
    const std::string compiler = named && *named ? named : "c++";
    const File said(build.collect ? std::tmpfile() : nullptr, &std::fclose);
    const int to = said ? fileno(said.get()) : Streams::inherited;
    int id = 0;
    const int error = start_program(id, command(build, compiler, output), {.out = to, .error = to}, false);
    const int status = error ? -1 : exit_status(id);
    if (status == -1 || status == 127)
        return diagnostics.error(
            {}, fmt::format("the compiler '{}' cannot be run", compiler),
            "install g++ (Debian: apt install g++ libeigen3-dev), or name another one in CXX");
    if (status != 0 && said) return report_compiler(content(said.get()), build.source, diagnostics);
    if (status != 0)
        return diagnostics.error(
            {}, fmt::format("'{}' does not compile; the compiler says why above", build.source));
    Diagnostics found;
    make_private(partial(output));
    const auto built = plugin::load({{partial(output)}}, plugin::Use::run, shipped_types(), found);
    if (!found.failed() && !built.empty())
        write_file(plugin::declarations_path(output),
                   plugin::declarations(built.front().types, partial(output)));
    for (Diagnostic d : found.all()) {
        for (auto at = d.message.find(partial(output)); at != d.message.npos;
             at = d.message.find(partial(output), at))
            d.message.replace(at, partial(output).size(), output);
        diagnostics.add(std::move(d));
    }
}

}  // namespace

std::string build_plugin(const PluginBuild& build) {
    Diagnostics diagnostics;
    const fs::path headers = fs::path(build.installation) / FORAGE_INCLUDE_DIR;
    if (!fs::is_regular_file(build.source))
        diagnostics.error({}, fmt::format("there is no file '{}'", build.source),
                          "forage new neuron NAME writes an example");
    else if (!is_installation(build.installation))
        diagnostics.error({}, fmt::format("there are no headers of Forage in '{}'", headers.string()),
                          "install them: apt install forage-dev, or build Forage and run cmake --install");
    throw_errors(diagnostics);
    const fs::path source = build.source;
    const std::string output = build.output.empty()
                                   ? (source.parent_path() / "plugins" / source.stem()).string() + ".so"
                                   : build.output;
    const auto folder = fs::path(output).parent_path();
    const bool new_folder = !folder.empty() && !fs::exists(folder);
    if (!folder.empty()) make_directory(folder.string());
    if (new_folder) make_private(folder);
    compile_and_check(build, output, diagnostics);
    if (diagnostics.failed()) {
        std::error_code ignored;
        fs::remove(partial(output), ignored);
        if (new_folder) fs::remove(folder, ignored);
    }
    throw_errors(diagnostics);
    finish(output);
    return output;
}

std::string installation_above(const std::string& path) {
    for (fs::path folder = path; !folder.empty(); folder = folder.parent_path()) {
        if (is_installation(folder)) return folder.string();
        if (folder == folder.root_path()) break;
    }
    return {};
}

}  // namespace forage
