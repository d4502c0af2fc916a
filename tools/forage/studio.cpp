#include "tools/studio/server/studio.h"

#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "core/run/input_error.h"
#include "tools/forage/commands.h"
#include "tools/forage/installation.h"
#include "tools/forage/stop.h"

namespace forage::tool {

int studio(const StudioCommand& command) {
    studio::StudioOptions options;
    options.input = command.input;
    options.plot_config = command.plot_config;
    options.recover = command.recover;
    options.running = command.running;
    options.port = static_cast<std::uint16_t>(command.port);
    options.shipped = installation() / "share/forage/systems";
    note_signals("the studio");
    try {
        studio::serve(
            options,
            [&](const studio::Ready& studio) {
                const std::string& address = studio.address;
                fmt::print(stderr, "{}", format(studio.mistakes));
                if (studio.mistakes.failed())
                    fmt::print(
                        stderr,
                        "note: the system runs when this is corrected, in the studio or in the file\n");
                if (!studio.note.empty()) fmt::print(stderr, "note: {}\n", studio.note);
                fmt::print(
                    "The studio is at\n\n  {}\n\nOpen it with a browser on this machine; Ctrl-C ends it.\n",
                    address);
                std::fflush(stdout);
                // The address holds no character that a shell reads.
                if (command.open &&
                    std::system(("xdg-open '" + address + "' >/dev/null 2>&1 &").c_str()) != 0)
                    fmt::print(stderr, "warning: no browser could be opened\n");
            },
            [] { return noted_signal() != 0; });
    } catch (const InputError& e) {
        fmt::print(stderr, "{}", e.what());
        return bad_input;
    }
    return fine;
}

}  // namespace forage::tool
