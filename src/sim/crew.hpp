// Several threads for one piece of work that falls into parts which do not touch each other. The
// result never depends on who did which part, nor on how many there are.
//
//     Crew crew(2);                                      // this thread and one more
//     crew.each(robots.size(), [&](size_t i) { sense(robots[i]); });   // returns when all is done
//
// A small piece of work is done on the calling thread alone: waking another one costs more.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace vagus::sim {

constexpr unsigned kThreadsMax = 64;
constexpr size_t kPartsForTwo = 64;  // fewer parts are for one thread

class Crew {
public:
    // `threads` counts the calling one: 1 to kThreadsMax.
    explicit Crew(unsigned threads);
    ~Crew();
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    unsigned size() const { return static_cast<unsigned>(others_.size()) + 1; }
    // Calls `part` for 0 to count - 1, each once; `part` must not throw, nor use the crew.
    void each(size_t count, const std::function<void(size_t)>& part);

private:
    // The share of one thread: neighbouring parts, as many as of any other.
    void do_share(unsigned who) const;
    void wait_for_work(unsigned who);

    std::vector<std::thread> others_;
    std::mutex lock_;  // for all below
    std::condition_variable begun_;
    std::condition_variable done_;
    const std::function<void(size_t)>* part_ = nullptr;
    size_t count_ = 0;
    size_t round_ = 0;      // of work, counted
    unsigned working_ = 0;  // others that have not finished this round
    bool over_ = false;
};

}  // namespace vagus::sim
