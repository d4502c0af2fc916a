#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/output_files.h"
#include "tools/forage/commands.h"
#include "tools/forage/installation.h"

namespace forage::tool {
namespace {

namespace fs = std::filesystem;

/// Runs a command and waits for it. Returns its exit status, or -1 when it cannot be run.
int run_command(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (auto& w : words) arguments.push_back(w.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    int status = 0;
    if (posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return -1;
    if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
    return WEXITSTATUS(status);
}

int refuse(const std::string& what, const std::string& hint) {
    fmt::print(stderr, "error: {}\n  hint: {}\n", what, hint);
    return bad_input;
}

}  // namespace

int build_plugin(const BuildPluginOptions& o) {
    if (!fs::is_regular_file(o.source))
        return refuse(fmt::format("there is no file '{}'", o.source),
                      "forage new neuron NAME writes an example");
    const fs::path headers = installation() / FORAGE_INCLUDE_DIR,
                   library = installation() / FORAGE_LIBRARY_DIR / "forage/libforage_random.a";
    if (!fs::exists(headers / "forage/plugin.h") || !fs::exists(library))
        return refuse(fmt::format("there are no headers of Forage in '{}'", headers.string()),
                      "install them: apt install forage-dev, or build Forage and run cmake --install");
    const fs::path source = o.source;
    const std::string output =
        o.output.empty() ? (source.parent_path() / "plugins" / source.stem()).string() + ".so" : o.output;
    const auto folder = fs::path(output).parent_path();
    const bool new_folder = !folder.empty() && !fs::exists(folder);
    if (!folder.empty()) make_directory(folder.string());
    const auto clear = [&] {
        std::error_code ignored;
        fs::remove(partial(output), ignored);
        if (new_folder) fs::remove(folder, ignored);
    };

    const char* named = std::getenv("CXX");
    const std::string compiler = named && *named ? named : "c++";
    std::vector<std::string> words = {compiler};
    const char* flags = std::getenv("CXXFLAGS");
    std::istringstream more(flags ? flags : "");
    for (std::string word; more >> word;) words.push_back(word);
    words.insert(words.end(), {"-std=c++20", "-fPIC", "-shared", "-Wall", "-Wextra", "-ffp-contract=off",
                               "-fno-math-errno", "-fno-trapping-math", "-fvisibility=hidden",
                               "-fvisibility-inlines-hidden", "-include",
                               (headers / "forage/core/types/size_checks.h").string(),
                               "-I" + headers.string(), "-I" + (headers / "forage").string()});
    if (o.debug)
        words.insert(words.end(), {"-O0", "-g"});  // without NDEBUG, Eigen checks each index
    else
        words.insert(words.end(), {"-O3", "-DNDEBUG"});
    for (const std::string eigen : {FORAGE_EIGEN_DIR, "/usr/include/eigen3", "/usr/local/include/eigen3"})
        if (fs::exists(eigen)) words.insert(words.end(), {"-isystem", eigen});
    words.insert(words.end(), {o.source, library.string(), "-o", partial(output)});
    const int status = run_command(words);
    if (status == -1 || status == 127)
        return refuse(fmt::format("the compiler '{}' cannot be run", compiler),
                      "install g++ (Debian: apt install g++ libeigen3-dev), or name another one in CXX");
    if (status != 0) {
        clear();
        fmt::print(stderr, "error: '{}' does not compile; the compiler says why above\n", o.source);
        return bad_input;
    }
    Diagnostics diagnostics;
    plugin::load({partial(output)}, shipped_types(), diagnostics);  // reports all further mistakes
    if (diagnostics.failed()) {
        std::string said = format(diagnostics);
        for (auto at = said.find(partial(output)); at != said.npos; at = said.find(partial(output), at))
            said.replace(at, partial(output).size(), output);
        fmt::print(stderr, "{}", said);
        clear();
        return bad_input;
    }
    finish(output);
    fmt::print("{}: use it with --plugin {}{}\n", output, output,
               o.output.empty() ? fmt::format(", or from systems in '{}' as it is",
                                              source.has_parent_path() ? source.parent_path().string() : ".")
                                : "");
    return fine;
}

}  // namespace forage::tool
