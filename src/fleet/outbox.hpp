// Events on their way to the broker: bounded, aged, in order. What was sent and not acknowledged
// when the link broke is sent again; who hears it twice knows its number.
//
//     outbox.add(post, now);
//     for (const Post& post : outbox.take_due(now)) link.publish(post);
//     outbox.acknowledged(number);
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "base/time.hpp"
#include "fleet/link.hpp"

namespace vagus::fleet {

class Outbox {
public:
    // The oldest is dropped for it if too many wait.
    void add(Post post, Time now);
    // What is to be sent now, with numbers; too old ones are dropped.
    std::vector<Post> take_due(Time now);
    void acknowledged(uint64_t number);
    // Whatever is not acknowledged waits again.
    void link_lost();

    uint64_t dropped() const { return dropped_; }
    bool has_waiting() const { return sent_ < waiting_.size(); }
    size_t size() const { return waiting_.size(); }

private:
    struct Waiting {
        Post post;
        Time since{};
    };
    void drop_old(Time now);

    std::deque<Waiting> waiting_;  // those that were sent are in front
    size_t sent_ = 0;
    uint64_t numbers_ = 0;
    uint64_t dropped_ = 0;
};

}  // namespace vagus::fleet
