#include <cerrno>
#include <cstring>

#include <unistd.h>

#include "core/base/installation.h"
#include "core/base/print.h"
#include "tools/forage/commands.h"

namespace forage::tool {

int studio(char** arguments) {
    const std::string server = installation() / "bin/forage-studio";
    execv(server.c_str(), arguments);
    print(stderr, "error: cannot start '{}': {}\n  hint: ./tools/open-studio builds the studio\n", server,
          std::strerror(errno));
    return run_failed;
}

}  // namespace forage::tool
