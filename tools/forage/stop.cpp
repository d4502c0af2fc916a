#include "tools/forage/stop.h"

#include <csignal>

namespace forage::tool {
namespace {

volatile std::sig_atomic_t noted = 0;

extern "C" void note(int signal) {
    noted = signal;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void note_signals() {
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is then an error like a full disk
}

int noted_signal() { return noted; }

std::string stopped_by(int signal) { return signal == SIGINT ? "by Ctrl-C" : "by SIGTERM"; }

}  // namespace forage::tool
