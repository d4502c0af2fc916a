// forage-studio: the studio's server. `forage studio` starts it with the same arguments.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "core/base/installation.h"
#include "core/base/print.h"
#include "core/base/program.h"
#include "core/run/input_error.h"
#include "tools/forage/options.h"
#include "tools/forage/stop.h"
#include "tools/studio/server/recovery.h"
#include "tools/studio/server/studio.h"

namespace {

using namespace forage;
using namespace forage::tool;

/// Writes a file that only this user can read, and that leads a browser to an address. Returns its path;
/// empty when there is no folder for it.
std::string redirect_file(const std::string& address) try {
    const std::string path = fmt::format("{}/open-{}.html", studio::state_folder(), getpid());
    std::remove(path.c_str());
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    const auto page = fmt::format(
        "<!doctype html><meta charset=\"utf-8\"><title>Forage</title>"
        "<meta http-equiv=\"refresh\" content=\"0; url={0}\"><a href=\"{0}\">Open the studio</a>\n",
        address);
    const bool written = file >= 0 && ::write(file, page.data(), page.size()) == std::ssize(page);
    if (file >= 0) ::close(file);
    return written ? path : "";
} catch (const std::exception&) {
    return "";
}

/// Opens a file with the user's browser. Everybody can read the arguments of programs, so no address is one.
bool open_browser(const std::string& file) {
    int id = 0;
    const Streams silent{.out = Streams::nothing, .error = Streams::nothing};
    return !file.empty() && start_program(id, {"xdg-open", file}, silent, true) == 0;
}

void print_address(const studio::Ready& ready) {
    print(stderr, "{}", format(ready.mistakes));
    if (ready.mistakes.failed())
        print(stderr, "note: the system runs when this is corrected, in the studio or in the file\n");
    if (!ready.note.empty()) print(stderr, "note: {}\n", ready.note);
    print("The studio is at\n\n  {}\n\nOpen it with a browser on this machine; Ctrl-C ends it.\n",
          ready.address);
    std::fflush(stdout);
}

int serve(const StudioCommand& command) {
    studio::StudioOptions options;
    options.input = command.input;
    options.plot_config = command.plot_config;
    options.recover = command.recover;
    options.running = command.running;
    options.ticket = command.open;
    options.port = static_cast<std::uint16_t>(command.port);
    options.shipped = installation() / "share/forage/systems";
    if (options.input.system.empty()) {
        options.input.system = options.shipped + "/dac_foraging.iqr";
        if (options.input.world.empty()) options.input.world = options.shipped + "/worlds/basic_arena.world";
    }
    ask_for_trust(options.input);
    note_signals("the studio");
    std::string redirect;
    const auto ready = [&](const studio::Ready& studio) {
        print_address(studio);
        if (!command.open) return;
        redirect = redirect_file(studio.once);
        if (!open_browser(redirect)) print(stderr, "warning: no browser could be opened\n");
    };
    try {
        studio::serve(options, ready, [] { return noted_signal() != 0; });
        std::remove(redirect.c_str());
    } catch (const InputError& e) {
        print(stderr, "{}", e.what());
        return bad_input;
    }
    return fine;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Runs iqr brain models headless, in a closed loop with a simulated robot.", "forage");
    app.require_subcommand(1);
    StudioCommand command;
    declare_studio(app, command);
    try {
        auto words = current_names({argv + 1, argv + argc});
        std::reverse(words.begin(), words.end());  // as CLI11 takes them
        app.parse(words);
        return serve(command);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);
        print(stderr, "error: {}\n  hint: 'forage studio --help' lists the options\n", e.what());
        return bad_input;
    } catch (const std::exception& e) {
        print(stderr, "error: {}\n", e.what());
        return run_failed;
    }
}
