#include "run/workers.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace vagus::run {

struct Workers::Shared {
    std::mutex mutex;  // guards all of this, and all of each worker but its thread
    bool quit = false;
    std::vector<std::shared_ptr<Worker>> idle;
};

struct Workers::Worker {
    std::function<void()> job;
    uint64_t number = 0;  // of its job, the last one if it is idle
    bool busy = false;
    bool left = false;
    std::condition_variable wake;
    std::thread thread;
};

Workers::Workers() : shared_(std::make_shared<Shared>()) {}

Workers::~Workers() {
    {
        const std::lock_guard lock(shared_->mutex);
        shared_->quit = true;
        shared_->idle.clear();
        for (const auto& worker : all_) worker->wake.notify_one();
    }
    for (const auto& worker : all_) worker->thread.join();
}

Workers::Job Workers::start(std::function<void()> job) {
    const std::lock_guard lock(shared_->mutex);
    const bool fresh = shared_->idle.empty();
    std::shared_ptr<Worker> worker = fresh ? std::make_shared<Worker>() : shared_->idle.back();
    if (!fresh) shared_->idle.pop_back();
    worker->job = std::move(job);
    worker->busy = true;
    ++worker->number;
    if (fresh) {
        worker->thread = std::thread([shared = shared_, worker] { loop(shared, worker); });
        all_.push_back(worker);
    }
    worker->wake.notify_one();
    return {worker, worker->number};
}

void Workers::leave(const Job& job) {
    const std::lock_guard lock(shared_->mutex);
    Worker& worker = *job.worker;
    if (!worker.busy || worker.number != job.number) return;
    worker.left = true;
    // Nobody can end a thread that does not return; what it uses is its own.
    worker.thread.detach();
    std::erase(all_, job.worker);
}

void Workers::loop(const std::shared_ptr<Shared>& shared, const std::shared_ptr<Worker>& worker) {
    std::unique_lock lock(shared->mutex);
    for (;;) {
        worker->wake.wait(lock, [&] { return shared->quit || worker->job; });
        if (!worker->job) return;  // quit, and nothing left to do
        std::function<void()> job = std::exchange(worker->job, nullptr);
        lock.unlock();
        job();
        job = nullptr;  // what it owns is let go of without the lock
        lock.lock();
        if (worker->left) return;
        worker->busy = false;
        if (!shared->quit) shared->idle.push_back(worker);
    }
}

}  // namespace vagus::run
