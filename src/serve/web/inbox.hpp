// What the thread of connections hands to the thread that takes events.
#pragma once

#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "serve/web/server.hpp"

namespace vagus::serve {

class Inbox {
public:
    explicit Inbox(std::function<void()> wake) : wake_(std::move(wake)) {}

    void put(WebEvent event) {
        {
            const std::lock_guard lock(mutex_);
            events_.push_back(std::move(event));
        }
        wake_();
    }
    void put_first(WebEvent event) {
        {
            const std::lock_guard lock(mutex_);
            events_.insert(events_.begin(), std::move(event));
        }
        wake_();
    }
    std::vector<WebEvent> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(events_, {});
    }

private:
    std::function<void()> wake_;
    std::mutex mutex_;
    std::vector<WebEvent> events_;
};

}  // namespace vagus::serve
