// forage-studio: the studio's server. `forage studio` starts it with the same arguments.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <fmt/format.h>

#include "core/run/input_error.h"
#include "tools/forage/installation.h"
#include "tools/forage/options.h"
#include "tools/forage/stop.h"
#include "tools/studio/server/studio.h"

namespace {

using namespace forage;
using namespace forage::tool;

void print_address(const StudioCommand& command, const studio::Ready& ready) {
    fmt::print(stderr, "{}", format(ready.mistakes));
    if (ready.mistakes.failed())
        fmt::print(stderr, "note: the system runs when this is corrected, in the studio or in the file\n");
    if (!ready.note.empty()) fmt::print(stderr, "note: {}\n", ready.note);
    fmt::print("The studio is at\n\n  {}\n\nOpen it with a browser on this machine; Ctrl-C ends it.\n",
               ready.address);
    std::fflush(stdout);
    // The address holds no character that a shell reads.
    if (command.open && std::system(("xdg-open '" + ready.address + "' >/dev/null 2>&1 &").c_str()) != 0)
        fmt::print(stderr, "warning: no browser could be opened\n");
}

int serve(const StudioCommand& command) {
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
            options, [&](const studio::Ready& ready) { print_address(command, ready); },
            [] { return noted_signal() != 0; });
    } catch (const InputError& e) {
        fmt::print(stderr, "{}", e.what());
        return bad_input;
    }
    return fine;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Runs iqr brain models headless, in a closed loop with a simulated robot.", "forage");
    app.require_subcommand(1);
    StudioCommand command;
    add_studio(app, command);
    try {
        auto words = current_names({argv + 1, argv + argc});
        std::reverse(words.begin(), words.end());  // as CLI11 takes them
        app.parse(words);
        return serve(command);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? fine : bad_input;
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return run_failed;
    }
}
