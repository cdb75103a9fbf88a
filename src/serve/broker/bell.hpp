// What the thread of a link rings when there is something to take: a loop waits for it, or for a
// time.
#pragma once

#include <condition_variable>
#include <mutex>

#include "base/time.hpp"

namespace vagus::serve {

class Bell {
public:
    void ring() {
        const std::lock_guard lock(guard_);
        rung_ = true;
        heard_.notify_one();
    }
    // Returns at once if it rang since the last call.
    void wait(Duration at_most) {
        std::unique_lock lock(guard_);
        heard_.wait_for(lock, at_most, [this] { return rung_; });
        rung_ = false;
    }

private:
    std::mutex guard_;
    std::condition_variable heard_;
    bool rung_ = false;
};

}  // namespace vagus::serve
