#include "sim/crew.hpp"

namespace vagus::sim {

Crew::Crew(unsigned threads) {
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

// What it reads was written before the round began, and is not written until all are done.
void Crew::do_share(unsigned who) const {
    const size_t end = count_ * (who + 1) / size();
    for (size_t i = count_ * who / size(); i < end; ++i) (*part_)(i);
}

void Crew::wait_for_work(unsigned who) {
    size_t seen = 0;
    std::unique_lock guard(lock_);
    for (;;) {
        begun_.wait(guard, [&] { return over_ || round_ != seen; });
        if (over_) return;
        seen = round_;
        guard.unlock();
        do_share(who);
        guard.lock();
        if (--working_ == 0) done_.notify_one();
    }
}

void Crew::each(size_t count, const std::function<void(size_t)>& part) {
    if (others_.empty() || count < kPartsForTwo) {
        for (size_t i = 0; i < count; ++i) part(i);
        return;
    }
    {
        const std::lock_guard guard(lock_);
        part_ = &part;
        count_ = count;
        working_ = static_cast<unsigned>(others_.size());
        ++round_;
    }
    begun_.notify_all();
    do_share(0);
    std::unique_lock guard(lock_);
    done_.wait(guard, [this] { return working_ == 0; });
}

}  // namespace vagus::sim
