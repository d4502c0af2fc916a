#include "tools/api/open/build_plugin.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/base/installation.h"
#include "core/base/print.h"
#include "core/run/input_error.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct BuildPluginOptions {
    std::string source;
    std::string output;  ///< empty: the folder plugins beside the source
    bool debug = false;
};

int build_plugin(const BuildPluginOptions& o) {
    std::string output;
    try {
        output = forage::build_plugin({.source = o.source,
                                       .output = o.output,
                                       .debug = o.debug,
                                       .installation = installation().string()});
    } catch (const InputError& e) {
        print(stderr, "{}", e.what());
        return bad_input;
    }
    const auto folder = std::filesystem::path(o.source).parent_path();
    print("{}: use it with --plugin {}{}\n", output, output,
          o.output.empty()
              ? fmt::format(", or from systems in '{}' as it is", folder.empty() ? "." : folder.string())
              : "");
    const auto plugins = plugin::folder_of(output);
    if (plugin::is_trusted(plugins)) return fine;
    Diagnostics diagnostics;
    plugin::trust(plugins, diagnostics);
    print(stderr, "{}", format(diagnostics));
    if (!diagnostics.failed())
        print("'{}' is trusted from now on; forage trust --remove ends this\n", plugins);
    return fine;
}

}  // namespace

void add_build_plugin(Program& program) {
    const auto [command, o] = program.add(
        "build-plugin", "Compile a source file with types of your own", build_plugin,
        "The compiler is the one in CXX, or c++; CXXFLAGS are added.\nExample:\n  forage build-plugin "
        "adaptive.cpp");
    add_value(command, "FILE", o.source, " ", "Source file (.cpp)")->required();
    add_value(command, "-o,--output", o.output, "FILE", "Plugin to write [plugins/NAME.so beside FILE]")
        ->check(named("file"));
    command.add_flag("--debug", o.debug, "For a debugger; the plugin checks each index, and is slower");
}

}  // namespace forage::tool
