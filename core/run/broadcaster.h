// Data broadcasting: averages of groups, sent as datagrams while a run lasts.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/observe/source.h"
#include "core/run/udp_socket.h"

namespace forage {

/// Sends the averages of sources in the original's form, "groupID:average;groupID:average;", six significant
/// digits each. Texts of more than 60,000 bytes become several datagrams. What it sends has no effect on the
/// run, and that nothing receives it has none either.
class Broadcaster final : public Observer {
  public:
    /// Throws std::runtime_error when the host is not known.
    Broadcaster(const Endpoint& there, std::vector<observe::Source> sources,
                std::chrono::milliseconds interval)
        : socket_(UdpSocket::connect(there)), sources_(std::move(sources)), interval_(interval) {}

    void declare(engine::Demand& demand) const override {
        for (const auto& s : sources_) s.declare(demand);
    }
    /// Sends when the interval has passed since the last time.
    void after_cycle(RunView& run) override;
    /// Sends the averages of the last cycle.
    void finish(RunView& run, ResultFiles&) override;

  private:
    void send(const engine::Simulation& simulation);

    UdpSocket socket_;
    std::vector<observe::Source> sources_;
    std::chrono::milliseconds interval_;
    std::chrono::steady_clock::time_point next_{};
    std::vector<double> numbers_;
};

}  // namespace forage
