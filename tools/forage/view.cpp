#include <cstdio>
#include <filesystem>

#include "core/base/print.h"
#include "tools/api/experiment/results.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

int view(const std::string& directory) {
    if (!std::filesystem::is_directory(directory)) {
        print(stderr,
              "error: '{}' is not a directory\n  hint: name a directory of results, such as forage-out\n",
              directory);
        return bad_input;
    }
    Diagnostics diagnostics;
    const std::string file = write_page(directory, diagnostics);
    print(stderr, "{}", format(diagnostics));
    print("{}\nOpen it with a browser: xdg-open '{}'\n", file, file);
    return diagnostics.failed() ? bad_input : fine;
}

}  // namespace

void add_view(Program& program) {
    auto& directory = program.options<std::string>();
    directory = "forage-out";
    auto& command = program.add("view", "Write a page, index.html, with the pictures and tables of results",
                                [&directory] { return view(directory); });
    command.footer("Example:\n  forage view forage-out");
    add_value(command, "DIR", directory, " ", "Directory of results [forage-out]");
}

}  // namespace forage::tool
