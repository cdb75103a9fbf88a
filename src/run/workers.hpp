// Threads that do jobs, as many as there are jobs at once, kept for the next ones. A job may block:
// no other waits for it.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace vagus::run {

class Workers {
public:
    Workers() = default;
    // Waits for the jobs that still run.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    // Starts the job on a thread that is free, or a new one. Called from one thread only.
    void start(std::function<void()> job);

private:
    struct Worker {
        std::function<void()> job;
        std::condition_variable wake;
        std::thread thread;
    };

    void loop(Worker& worker);

    std::mutex mutex_;
    bool quit_ = false;
    std::vector<Worker*> idle_;
    std::vector<std::unique_ptr<Worker>> all_;
};

}  // namespace vagus::run
