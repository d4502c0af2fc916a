#include "tools/api/open/build_plugin.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/base/installation.h"
#include "core/base/print.h"
#include "core/run/input_error.h"
#include "tools/forage/commands.h"

namespace forage::tool {

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

}  // namespace forage::tool
