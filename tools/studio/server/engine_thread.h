// A thread that runs a session. Other threads give it jobs.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

#include "tools/studio/server/session.h"

namespace forage::studio {

/// Owns the session: nothing else touches it after the constructor. Jobs are done in order, between cycles.
class EngineThread {
  public:
    using Job = std::function<void(Session&)>;

    explicit EngineThread(Session& session)
        : session_(session), thread_([this] { work_after(0), io_.run(); }) {}
    ~EngineThread() {
        io_.stop();
        thread_.join();
    }
    void post(Job job) {
        boost::asio::post(io_, [this, job = std::move(job)] {
            job(session_);
            work_after(0);
        });
    }

  private:
    void work_after(double seconds) {
        const std::chrono::duration<double> wait(std::min(seconds, 3600.));
        timer_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(wait));
        timer_.async_wait([this](boost::system::error_code stopped) {
            if (!stopped) work_after(session_.work(clock_now()));
        });
    }

    Session& session_;
    boost::asio::io_context io_{1};
    boost::asio::steady_timer timer_{io_};
    std::thread thread_;
};

}  // namespace forage::studio
