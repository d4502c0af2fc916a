// A thread that runs a session. Other threads give it jobs.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>
#include <utility>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include "tools/studio/server/session.h"

namespace forage::studio {

/// Owns the session: nothing else touches it after the constructor. Jobs are done in order, between cycles.
class EngineThread {
  public:
    using Job = std::function<void(Session&)>;

    explicit EngineThread(Session& session) : session_(session), thread_([this] { work(); }) {}
    ~EngineThread() {
        io_.stop();
        thread_.join();
    }
    void post(Job job) {
        boost::asio::post(io_, [this, job = std::move(job)] { job(session_); });
    }

  private:
    void work() {
        double wait = 0;
        while (!io_.stopped()) {
            if (wait > 0)
                io_.run_one_for(std::chrono::microseconds(std::llround(1e6 * std::min(wait, 3600.))));
            io_.poll();
            wait = session_.work(clock_now());
        }
    }

    Session& session_;
    boost::asio::io_context io_{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> stays_{io_.get_executor()};
    std::thread thread_;
};

}  // namespace forage::studio
