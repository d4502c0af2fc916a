#include "core/run/broadcaster.h"

#include <numeric>

#include <fmt/format.h>

namespace forage {
namespace {

constexpr std::size_t longest = 60000;  // bytes; a UDP datagram of IPv4 holds 65,507

}  // namespace

void Broadcaster::send(const engine::Simulation& simulation) {
    std::string text;
    for (const auto& s : sources_) {
        numbers_.resize(s.what().size());
        s.read(simulation, numbers_);
        const double mean =
            std::accumulate(numbers_.begin(), numbers_.end(), 0.0) / static_cast<double>(numbers_.size());
        text += fmt::format("{}:{:.6g};", s.what().group_id, mean);
        if (text.size() > longest) socket_.send(text), text.clear();
    }
    if (!text.empty()) socket_.send(text);
}

void Broadcaster::after_cycle(RunView& run) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + interval_;
    send(run.simulation);
}

void Broadcaster::finish(RunView& run, ResultFiles&) { send(run.simulation); }

}  // namespace forage
