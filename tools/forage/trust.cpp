#include <filesystem>
#include <iostream>
#include <string>

#include <unistd.h>

#include "core/base/print.h"
#include "tools/forage/commands.h"

namespace forage::tool {

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

}  // namespace forage::tool
