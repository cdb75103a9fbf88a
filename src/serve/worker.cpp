#include "serve/worker.hpp"

namespace vagus::serve {

Worker::~Worker() {
    thread_.request_stop();  // before the members that it uses are gone
    if (thread_.joinable()) thread_.join();
}

void Worker::post(Work work) {
    {
        const std::lock_guard lock(mutex_);
        due_.push_back(std::move(work));
    }
    if (!thread_.joinable()) {
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
    posted_.notify_one();
}

void Worker::tick() {
    std::vector<Then> back;
    {
        const std::lock_guard lock(mutex_);
        back.swap(back_);
    }
    for (const Then& then : back) then();
}

void Worker::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (posted_.wait(lock, stop, [this] { return !due_.empty(); }) && !stop.stop_requested()) {
        Work work = std::move(due_.front());
        due_.pop_front();
        lock.unlock();
        Then then = work();
        work = nullptr;  // what it held goes on this thread
        lock.lock();
        back_.push_back(std::move(then));
        lock.unlock();
        wake_();
        lock.lock();
    }
}

}  // namespace vagus::serve
