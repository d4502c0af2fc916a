// A thread that runs a session. Other threads give it jobs.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "tools/studio/server/session.h"

namespace forage::studio {

/// Owns the session: nothing else touches it after the constructor. Jobs are done in order, between cycles.
class EngineThread {
  public:
    using Job = std::function<void(Session&)>;

    explicit EngineThread(Session& session) : session_(session), thread_([this] { work(); }) {}
    ~EngineThread() {
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }
    void post(Job job) {
        {
            const std::lock_guard lock(mutex_);
            jobs_.push_back(std::move(job));
        }
        wake_.notify_one();
    }

  private:
    void work() {
        double wait = 0;
        while (true) {
            std::vector<Job> jobs;
            {
                std::unique_lock lock(mutex_);
                const auto called = [&] { return ends_ || !jobs_.empty(); };
                if (wait > 3600)
                    wake_.wait(lock, called);
                else if (wait > 0)
                    wake_.wait_for(lock, std::chrono::duration<double>(wait), called);
                if (ends_) return;
                jobs.swap(jobs_);
            }
            for (const Job& job : jobs) job(session_);
            wait = session_.work(
                std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count());
        }
    }

    Session& session_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::vector<Job> jobs_;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace forage::studio
