#include <filesystem>
#include <iostream>
#include <string>

#include <unistd.h>

#include "core/base/print.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

struct TrustOptions {
    std::string folder;  ///< empty: list the trusted ones
    bool remove = false;
};

int trust(const TrustOptions& o) {
    if (o.folder.empty()) {
        for (const auto& folder : plugin::trusted_folders()) print("{}\n", folder);
        return fine;
    }
    // A project holds its plugins in a folder of its own.
    const auto inner = std::filesystem::path(o.folder) / "plugins";
    std::error_code none;
    const std::string folder = std::filesystem::is_directory(inner, none) ? inner.string() : o.folder;
    Diagnostics diagnostics;
    if (o.remove)
        plugin::distrust(folder, diagnostics);
    else
        plugin::trust(folder, diagnostics);
    print(stderr, "{}", format(diagnostics));
    return diagnostics.failed() ? bad_input : fine;
}

}  // namespace

void ask_for_trust(const RunInput& input) {
    if (!isatty(STDIN_FILENO) || !isatty(STDERR_FILENO)) return;
    for (const auto& folder : untrusted_folders(input)) {
        print(stderr, "'{}' has plugins, which are programs. Load them, now and in future? [y/N] ", folder);
        std::string answer;
        if (!std::getline(std::cin, answer) || (answer != "y" && answer != "Y" && answer != "yes")) continue;
        Diagnostics diagnostics;
        plugin::trust(folder, diagnostics);
        print(stderr, "{}", format(diagnostics));
    }
}

void add_trust(Program& program) {
    const auto [command, o] = program.add(
        "trust", "List the folders whose plugins are loaded, or add one", trust,
        "Plugins are programs. A run loads those in the folder plugins beside its system only if this folder "
        "is trusted;\n--plugin PATH and FORAGE_PLUGIN_PATH need no trust.\nExample:\n  forage trust plugins");
    add_value(command, "FOLDER", o.folder, " ", "Folder with plugins (.so), or with a folder plugins");
    command.add_flag("--remove", o.remove, "Trust it no longer");
}

}  // namespace forage::tool
