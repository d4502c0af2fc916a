#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/print.h"
#include "tools/api/experiment/results.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

int view(const std::string& directory) {
    if (!std::filesystem::is_directory(directory))
        return refused(fmt::format("'{}' is not a directory", directory),
                       "name a directory of results, such as forage-out");
    Diagnostics diagnostics;
    const std::string file = write_page(directory, diagnostics);
    print(stderr, "{}", format(diagnostics));
    print("{}\nOpen it with a browser: xdg-open '{}'\n", file, file);
    return diagnostics.failed() ? bad_input : fine;
}

}  // namespace

void add_view(Program& program) {
    const auto [command, directory] =
        program.add("view", "Write a page, index.html, with the pictures and tables of results", view,
                    "Example:\n  forage view forage-out");
    directory = "forage-out";
    add_value(command, "DIR", directory, " ", "Directory of results [forage-out]");
}

}  // namespace forage::tool
