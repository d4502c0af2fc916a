#include <cerrno>
#include <cstring>

#include <unistd.h>

#include "core/base/installation.h"
#include "core/base/print.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

/// Becomes the program forage-studio. `arguments` are those of `forage`, with a null pointer at the end.
int studio(char** arguments) {
    const std::string server = installation() / "bin/forage-studio";
    execv(server.c_str(), arguments);
    print(stderr, "error: cannot start '{}': {}\n  hint: ./tools/open-studio builds the studio\n", server,
          std::strerror(errno));
    return run_failed;
}

}  // namespace

void add_studio(Program& program) {
    program.on(declare_studio(program.app(), program.options<StudioCommand>()),
               [&program] { return studio(program.arguments()); });
}

}  // namespace forage::tool
