// Several threads for one piece of work that falls into parts which do not touch each other. The
// result never depends on who did which part, nor on how many there are.
//
//     Crew crew(2);                                      // this thread and one more
//     crew.each(robots.size(), [&](size_t i) { sense(robots[i]); });   // returns when all is done
//     crew.beside([&] { solve(); }, robots.size(), glide);   // this thread solves, then helps
//
// Each thread begins with a share of its own, neighbouring parts, and then takes from those of the
// others. So one that comes late, because its processor is busy with something else, finds its work
// done, and nobody waits for it.
//
// A small piece of work is done on the calling thread alone: waking another one costs more.
#pragma once

#include <atomic>
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
    // From now on the calling thread does all of it, or the others help again.
    void work_alone(bool alone) { alone_ = alone; }
    // Calls `part` for 0 to count - 1, each once; `part` must not throw, nor use the crew.
    void each(size_t count, const std::function<void(size_t)>& part);
    // The same while the calling thread does something of its own first, which touches no part.
    void beside(const std::function<void()>& own, size_t count,
                const std::function<void(size_t)>& part);

private:
    // Parts of a round that begin as those of one thread; a thread that takes some moves `next` on.
    struct alignas(64) Share {
        std::atomic<size_t> next = 0;
        size_t end = 0;
    };

    void begin(size_t count, const std::function<void(size_t)>& part);
    void work(unsigned who);
    void end();
    void wait_for_work(unsigned who);
    template <typename Come>
    void look_for(const Come& come) const;

    std::vector<std::thread> others_;
    // Of this round: written before it begins, and not until nobody is inside any more.
    std::vector<Share> shares_;
    const int looks_;
    bool alone_ = false;
    const std::function<void(size_t)>* part_ = nullptr;
    size_t at_once_ = 1;  // parts that are taken together

    std::mutex lock_;  // for all below, which only its holder writes
    std::condition_variable begun_;
    std::condition_variable done_;
    std::atomic<size_t> round_ = 0;     // of work, counted
    std::atomic<unsigned> inside_ = 0;  // others that work on this round
    bool open_ = false;                 // others may join this round
    std::atomic<bool> over_ = false;
};

}  // namespace vagus::sim
