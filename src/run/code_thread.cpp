#include "run/code_thread.hpp"

#include <cassert>

namespace vagus::run {

CodeThread::CodeThread() : thread_([this] { loop(); }) {}

CodeThread::~CodeThread() {
    {
        const std::lock_guard lock(mutex_);
        assert(ended_);
        quit_ = true;
        code_has_turn_ = true;
    }
    turn_.notify_all();
    thread_.join();
}

void CodeThread::start(std::function<void()> code) {
    std::unique_lock lock(mutex_);
    assert(ended_);
    code_ = std::move(code);
    ended_ = false;
    hand_over(lock, true);
}

void CodeThread::go_on() {
    std::unique_lock lock(mutex_);
    assert(!ended_);
    hand_over(lock, true);
}

void CodeThread::give_back() {
    std::unique_lock lock(mutex_);
    hand_over(lock, false);
}

// Gives the baton away and waits until it comes back.
void CodeThread::hand_over(std::unique_lock<std::mutex>& lock, bool to_code) {
    code_has_turn_ = to_code;
    turn_.notify_all();
    turn_.wait(lock, [this, to_code] { return code_has_turn_ != to_code; });
}

void CodeThread::loop() {
    std::unique_lock lock(mutex_);
    for (;;) {
        turn_.wait(lock, [this] { return code_has_turn_; });
        if (quit_) return;
        lock.unlock();
        code_();
        lock.lock();
        code_ = nullptr;
        ended_ = true;
        code_has_turn_ = false;
        turn_.notify_all();
    }
}

std::unique_ptr<CodeThread> CodeThreads::take() {
    if (idle_.empty()) return std::make_unique<CodeThread>();
    std::unique_ptr<CodeThread> thread = std::move(idle_.back());
    idle_.pop_back();
    return thread;
}

void CodeThreads::give(std::unique_ptr<CodeThread> thread) {
    idle_.push_back(std::move(thread));
}

}  // namespace vagus::run
