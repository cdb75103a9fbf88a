// Runs an actor's code on a thread of its own, but only while the executor waits for it: the two
// take turns, so a run in virtual time is as deterministic as one thread. Threads are kept and used
// again.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace vagus::run {

// A thread that waits for its turn. The baton is either with the executor or with the code.
class CodeThread {
public:
    CodeThread();
    ~CodeThread();
    CodeThread(const CodeThread&) = delete;
    CodeThread& operator=(const CodeThread&) = delete;

    // For the executor: gives the baton to `code`, which runs until it calls give_back() or ends.
    void start(std::function<void()> code);
    // Lets the code go on from give_back(). Returns when it gives the baton back or has ended.
    void go_on();
    bool ended() const { return ended_; }

    // For the code: lets the executor go on; returns when it is the code's turn again.
    void give_back();

private:
    void loop();
    void hand_over(std::unique_lock<std::mutex>& lock, bool to_code);

    std::mutex mutex_;
    std::condition_variable turn_;
    bool code_has_turn_ = false;
    bool quit_ = false;
    bool ended_ = true;
    std::function<void()> code_;
    std::thread thread_;  // last: it uses all the rest
};

// Idle threads, so that each activation need not make one.
class CodeThreads {
public:
    std::unique_ptr<CodeThread> take();
    void give(std::unique_ptr<CodeThread> thread);

private:
    std::vector<std::unique_ptr<CodeThread>> idle_;
};

}  // namespace vagus::run
