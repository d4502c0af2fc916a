// What would a network gain that is divided between two processes? Each of two processes computes its half of
// a network, and after each cycle they exchange the activities of the cells at the border, the halo, over TCP
// on this machine.
//
//     bench_halo
//
// A longer line is imitated: a message counts only when it is as old as the latency. The halves do not
// use what they receive, as the engine has no such input. tests/bench/halo.py makes a model of the results.
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/tcp.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/engine/simulation.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/bench/random_lists.h"
#include "tests/bench/report.h"

using namespace forage;
using bench::wall_seconds;

namespace {

constexpr int blocks = 25;

/// One end of a connection between the two processes. It never sleeps, as MPI does not.
class Line {
  public:
    explicit Line(int socket) : socket_(socket) {
        const int on = 1;
        setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    }
    /// Sends and receives `bytes` bytes, and waits until what was received is `latency` seconds old.
    void exchange(std::size_t bytes, double latency) {
        out_.resize(sizeof(double) + bytes), in_.resize(out_.size());
        const double now = wall_seconds();
        std::memcpy(out_.data(), &now, sizeof now);
        for (std::size_t sent = 0, received = 0; sent < out_.size() || received < in_.size();) {
            if (sent < out_.size())
                sent += moved(send(socket_, out_.data() + sent, out_.size() - sent, MSG_DONTWAIT));
            if (received < in_.size())
                received += moved(recv(socket_, in_.data() + received, in_.size() - received, MSG_DONTWAIT));
        }
        double then = 0;  // processes of one machine have the same clock
        std::memcpy(&then, in_.data(), sizeof then);
        while (wall_seconds() < then + latency) {
        }
    }

  private:
    static std::size_t moved(ssize_t bytes) {
        if (bytes > 0) return static_cast<std::size_t>(bytes);
        if (bytes < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
        throw std::runtime_error("the other process has ended");
    }
    int socket_;
    std::vector<char> out_, in_;
};

engine::Simulation build(const model::System& system, const Registry& registry) {
    Diagnostics diagnostics;
    auto out = engine::Simulation::build(system, registry, engine::Demand::everything(), {}, diagnostics);
    if (!out) throw std::runtime_error(format(diagnostics));
    out->start();
    out->step();
    return std::move(*out);
}

/// A sheet of random spikes, and one of linear threshold cells with windows of 11 x 11 cells.
model::System windows(int width, int height) {
    model::System system;
    const auto process = model::add_process(system, "P");
    const auto from = model::add_group(system, process, "From", width, height, "neuronRandomSpike");
    const auto to = model::add_group(system, process, "To", width, height, "neuronLinearThreshold");
    model::set_parameter(model::find_group(system, from)->neuron, "probability", "0.3");
    const auto id = model::add_connection(system, from, to, InputKind::excitatory, "synapseFixedWeight");
    model::find_connection(system, id)->arborization.shape = model::RectArbor{11, 11};
    return system;
}

struct Case {
    std::string name;
    model::System whole, half;
    std::size_t halo;  ///< bytes that each process sends
    int cycles;        ///< of a block
};

/// The time per cycle of the best block, s.
template <class Cycle>
double best(int cycles, Cycle cycle) {
    double out = 1e9;
    for (int b = 0; b < blocks; ++b) {
        const double begin = wall_seconds();
        for (int i = 0; i < cycles; ++i) cycle();
        out = std::min(out, (wall_seconds() - begin) / cycles);
    }
    return out;
}

/// Both processes call this with their end of the line; the first one prints.
void measure(Line line, bool first) {
    const auto result = [&](const std::string& subject, const std::string& metric, double seconds) {
        if (!first) return;
        fmt::print("{:<72} {:10.2f} us\n", subject + ": " + metric, 1e6 * seconds);
        bench::result("halo/" + subject, metric, 1e6 * seconds, "us");
    };
    for (const std::size_t bytes : {8, 1'000, 10'000, 100'000, 1'000'000})
        for (const double latency : {0.0, 50e-6, 500e-6}) {
            const int cycles = latency > 1e-4 ? 10 : 50;
            const double time = best(cycles, [&] { line.exchange(bytes, latency); });
            result(fmt::format("exchange of {} bytes", bytes),
                   fmt::format("latency of {:g} us", 1e6 * latency), time);
        }
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    const Case cases[] = {
        {"100 x 100 cells, 11 x 11 windows", windows(100, 100), windows(100, 50), 5 * 100 * 8, 50},
        {"400 x 400 cells, 11 x 11 windows", windows(400, 400), windows(400, 200), 5 * 400 * 8, 10},
        {"2,000 cells, 100 random synapses each", bench::random_lists(2'000, 100),
         bench::random_lists(2'000, 100, 1'000), 8'000, 50},
        {"20,000 cells, 1,000 random synapses each", bench::random_lists(20'000, 1000),
         bench::random_lists(20'000, 1000, 10'000), 80'000, 2},
    };
    for (const auto& c : cases) {
        double whole = 0;
        if (first) {
            auto simulation = build(c.whole, registry);
            whole = best(c.cycles, [&] { simulation.step(); });
        }
        auto simulation = build(c.half, registry);
        line.exchange(8, 0);  // the other process waits until the whole network is measured
        const double half = best(c.cycles, [&] { simulation.step(); });
        result(c.name, "one process", whole);
        result(c.name, "half, beside the other half", half);
        for (const double latency : {0.0, 50e-6, 500e-6}) {
            const double time = best(c.cycles, [&] { simulation.step(), line.exchange(c.halo, latency); });
            result(c.name, fmt::format("two processes, latency of {:g} us", 1e6 * latency), time);
        }
    }
}

}  // namespace

int main() {
    const int door = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET, address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const name = reinterpret_cast<sockaddr*>(&address);
    if (bind(door, name, size) != 0 || listen(door, 1) != 0 || getsockname(door, name, &size) != 0)
        return fmt::print(stderr, "error: no TCP: {}\n", std::strerror(errno)), 1;
    const pid_t other = fork();
    try {
        if (other != 0) {
            measure(Line(accept(door, nullptr, nullptr)), true);
            return waitpid(other, nullptr, 0) == other ? 0 : 1;
        }
        const int socket_of_child = socket(AF_INET, SOCK_STREAM, 0);
        if (connect(socket_of_child, name, size) != 0) return 1;
        measure(Line(socket_of_child), false);
    } catch (const std::exception& e) {
        return fmt::print(stderr, "error: {}\n", e.what()), 1;
    }
    return 0;
}
