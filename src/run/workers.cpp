#include "run/workers.hpp"

#include <utility>

namespace vagus::run {

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
        for (const auto& worker : all_) worker->wake.notify_one();
    }
    for (const auto& worker : all_) worker->thread.join();
}

void Workers::start(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
        Worker& worker = *idle_.back();
        idle_.pop_back();
        worker.job = std::move(job);
        worker.wake.notify_one();
        return;
    }
    Worker& worker = *all_.emplace_back(std::make_unique<Worker>());
    worker.job = std::move(job);
    worker.thread = std::thread([this, &worker] { loop(worker); });
}

void Workers::loop(Worker& worker) {
    std::unique_lock lock(mutex_);
    for (;;) {
        worker.wake.wait(lock, [this, &worker] { return quit_ || worker.job; });
        if (!worker.job) return;  // quit, and nothing left to do
        const std::function<void()> job = std::exchange(worker.job, nullptr);
        lock.unlock();
        job();
        lock.lock();
        idle_.push_back(&worker);
    }
}

}  // namespace vagus::run
