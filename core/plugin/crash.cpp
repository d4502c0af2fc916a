#include <csignal>
#include <cstring>
#include <filesystem>

#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include "core/plugin/plugin.h"

namespace forage::plugin {
namespace {

constexpr int max_frames = 64;

struct Watched {
    std::string path;      ///< as given
    std::string absolute;  ///< as the loader knows it
};
const std::vector<Watched>* watched = nullptr;
alignas(16) char stack[64 * 1024];  // a stack that has overflowed cannot be used

/// The plugin in whose code the program is; null when it is in none.
const Watched* plugin_in_use() {
    void* frames[max_frames];
    const int count = backtrace(frames, max_frames);
    for (int i = 0; i < count; ++i) {
        Dl_info where{};
        if (!dladdr(frames[i], &where) || !where.dli_fname) continue;
        for (const auto& w : *watched)
            if (w.absolute == where.dli_fname) return &w;
    }
    return nullptr;
}

void say(const char* text) { [[maybe_unused]] const auto n = write(STDERR_FILENO, text, std::strlen(text)); }

// Allocates nothing, because the heap may be what is broken.
extern "C" void tell_crash(int signal) {
    const char* what = signal == SIGFPE   ? "division by zero"
                       : signal == SIGILL ? "illegal instruction"
                                          : "segmentation fault";
    if (const Watched* in = plugin_in_use()) {
        say("\nerror: the program crashes in plugin '"), say(in->path.c_str()), say("': "), say(what);
        say("\n  hint: 'forage build-plugin --debug' finds most such mistakes, gdb the line\n");
    } else {
        say("\nerror: the program crashes: "), say(what);
        say("; one of its plugins may have written where it should not\n"
            "  hint: 'forage build-plugin --debug' finds most such mistakes\n");
    }
    raise(signal);  // with the default action, which SA_RESETHAND has restored
}

}  // namespace

void tell_crashes(const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    auto* all = new std::vector<Watched>;  // is needed until the program has ended
    for (const auto& path : paths) all->push_back({path, std::filesystem::absolute(path).string()});
    watched = all;
    void* frame = nullptr;
    backtrace(&frame, 1);  // loads the library that it needs
    stack_t alternative{};
    alternative.ss_sp = stack;
    alternative.ss_size = sizeof stack;
    sigaltstack(&alternative, nullptr);
    struct sigaction action {};
    action.sa_handler = tell_crash;
    action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler == SIG_DFL) sigaction(signal, &action, nullptr);  // not that of a sanitizer
    }
}

}  // namespace forage::plugin
