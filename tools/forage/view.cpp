#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "tools/api/results.h"
#include "tools/forage/commands.h"

namespace forage::tool {

int view(const std::string& directory) {
    if (!std::filesystem::is_directory(directory)) {
        fmt::print(
            stderr,
            "error: '{}' is not a directory\n  hint: name a directory of results, such as forage-out\n",
            directory);
        return bad_input;
    }
    const std::string file = (std::filesystem::path(directory) / "index.html").string();
    write_file(file, results_page(directory));
    fmt::print("{}\nOpen it with a browser: xdg-open '{}'\n", file, file);
    return fine;
}

}  // namespace forage::tool
