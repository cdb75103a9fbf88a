#include "sim/crew.hpp"

#include <algorithm>

namespace vagus::sim {

namespace {

// A share is taken in so many pieces: few enough that taking costs nothing, enough that nobody is
// left with a large one at the end.
constexpr size_t kPiecesOfAShare = 16;
// How often a thread looks for what comes before it sleeps: for some 50 microseconds, as long as it
// would take to wake it. The next round is often nearer than that.
constexpr int kLooks = 2000;

// A moment between two looks, which leaves a core to the other thread that it may have.
#if defined(__x86_64__)
void wait_a_moment() {
    __builtin_ia32_pause();
}
#elif defined(__aarch64__)
void wait_a_moment() {
    __asm__ volatile("yield");
}
#else
void wait_a_moment() {}
#endif

}  // namespace

// With more threads than processors, looking would keep others from what is looked for.
Crew::Crew(unsigned threads)
    : shares_(threads),
      looks_(threads > 1 && threads <= std::thread::hardware_concurrency() ? kLooks : 0) {
    for (unsigned who = 1; who < threads; ++who)
        others_.emplace_back([this, who] { wait_for_work(who); });
}

Crew::~Crew() {
    {
        const std::lock_guard guard(lock_);
        over_ = true;
    }
    begun_.notify_all();
    for (std::thread& other : others_) other.join();
}

void Crew::each(size_t count, const std::function<void(size_t)>& part) {
    beside([] {}, count, part);
}

void Crew::beside(const std::function<void()>& own, size_t count,
                  const std::function<void(size_t)>& part) {
    if (alone_ || others_.empty() || count < kPartsForTwo) {
        own();
        for (size_t i = 0; i < count; ++i) part(i);
        return;
    }
    begin(count, part);
    own();
    work(0);
    end();
}

void Crew::begin(size_t count, const std::function<void(size_t)>& part) {
    part_ = &part;
    at_once_ = std::max<size_t>(1, count / (size() * kPiecesOfAShare));
    for (size_t who = 0; who < shares_.size(); ++who) {
        shares_[who].next = count * who / size();
        shares_[who].end = count * (who + 1) / size();
    }
    {
        const std::lock_guard guard(lock_);
        open_ = true;
        ++round_;
    }
    begun_.notify_all();
}

// Its own share, then what is left of those of the others.
void Crew::work(unsigned who) {
    for (size_t k = 0; k < shares_.size(); ++k) {
        Share& share = shares_[(who + k) % shares_.size()];
        for (;;) {
            const size_t first = share.next.fetch_add(at_once_);
            if (first >= share.end) break;
            const size_t end = std::min(first + at_once_, share.end);
            for (size_t i = first; i < end; ++i) (*part_)(i);
        }
    }
}

// All parts are taken: only who is inside is waited for.
void Crew::end() {
    {
        const std::lock_guard guard(lock_);
        open_ = false;
    }
    const auto all_are_out = [this] { return inside_ == 0; };
    look_for(all_are_out);
    std::unique_lock guard(lock_);
    done_.wait(guard, all_are_out);
}

template <typename Come>
void Crew::look_for(const Come& come) const {
    for (int look = 0; look < looks_ && !come(); ++look) wait_a_moment();
}

void Crew::wait_for_work(unsigned who) {
    size_t seen = 0;
    const auto begins = [&] { return over_ || round_ != seen; };
    for (;;) {
        look_for(begins);
        std::unique_lock guard(lock_);
        begun_.wait(guard, begins);
        if (over_) return;
        seen = round_;
        if (!open_) continue;
        ++inside_;
        guard.unlock();
        work(who);
        guard.lock();
        if (--inside_ == 0) done_.notify_one();
    }
}

}  // namespace vagus::sim
