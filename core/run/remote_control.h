// Remote control: commands that arrive as datagrams and act between two cycles.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/observe/observer.h"
#include "core/run/remote_command.h"
#include "core/run/udp_socket.h"

namespace forage {

/// Receives commands and carries them out between cycles. At most 100 commands a second are carried out;
/// others are dropped. A run without commands has the same numbers as one without remote control.
class RemoteControl final : public Observer {
  public:
    /// Throws std::runtime_error when it cannot listen there.
    explicit RemoteControl(const Endpoint& here) : socket_(UdpSocket::listen(here)), here_(here) {}

    /// Draws the group or connection that `id` names, as it is now, into a file of the results, and returns
    /// the file's name. Throws std::exception. Empty in a run without results.
    std::function<std::string(const RemoteCommand&, const std::string& id, Run&)> plot;
    /// Called with a line about each of the first thousand commands. Of the datagrams that are refused, and
    /// of those that are dropped, it gets the first ten, the 100th, the 1000th...: a sender cannot fill a
    /// disk. May be empty.
    std::function<void(const std::string&)> log;

    /// Where it listens, as HOST:PORT.
    std::string address() const { return Endpoint{here_.host, socket_.port()}.text(); }
    /// Carries out the commands that have arrived. Called between cycles, after the start.
    void execute_pending(Run& run);
    /// Waits until a command arrives, a tenth of a second has passed, or a signal comes.
    void wait();
    bool paused() const { return paused_; }    ///< after cmd:stop, until cmd:start
    bool quit() const { return quit_; }        ///< after cmd:quit
    double waited() const { return waited_; }  ///< time in wait(), s

    /// A command that was carried out before `cycle`.
    struct Executed {
        std::uint64_t cycle = 0;
        std::string text;
        void checkpoint(Archive& archive) { archive(cycle, text); }
    };
    /// The commands so far, the first thousand of them.
    const std::vector<Executed>& executed() const { return executed_; }

    /// Any parameter may be changed, and any group plotted.
    void declare(engine::Demand& demand) const override { demand.read_everything(); }
    /// Adds the pictures to the files of the run.
    void finish(RunView&, ResultFiles& files) override;
    void checkpoint(Archive& archive) override { archive(executed_, pictures_, paused_); }

  private:
    void carry_out(const RemoteCommand& command, Run& run, Diagnostics& diagnostics);
    void set_parameter(const RemoteCommand& command, Run& run, Diagnostics& diagnostics) const;
    bool may_act();
    void log_rejected(std::uint64_t& count, const std::string& line) const;

    UdpSocket socket_;
    Endpoint here_;
    bool paused_ = false, quit_ = false;
    double waited_ = 0;
    double tokens_ = 100;  ///< commands that may be carried out now
    std::chrono::steady_clock::time_point filled_ = std::chrono::steady_clock::now();
    std::uint64_t refused_ = 0, dropped_ = 0;  ///< datagrams so far
    std::vector<Executed> executed_;
    std::vector<std::string> pictures_;  ///< names of files
};

}  // namespace forage
