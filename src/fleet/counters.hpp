// Two small memories of a member: which numbers came already, and how many events of a name there
// were in this second. Both are bounded, and forget what was used the longest ago.
#pragma once

#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/time.hpp"
#include "fleet/limits.hpp"

namespace vagus::fleet {

// The last kNumbersRemembered numbers of each robot and epoch.
class Numbers {
public:
    // False: it came before.
    bool is_new(const std::string& robot, int64_t epoch, int64_t number);
    size_t senders() const { return seen_.size(); }

private:
    using Sender = std::pair<std::string, int64_t>;
    struct Seen {
        std::deque<int64_t> order;
        std::set<int64_t> numbers;
        std::list<Sender>::iterator place;
    };
    Seen& seen_of(const Sender& sender);

    std::map<Sender, Seen> seen_;
    std::list<Sender> used_;  // the last to be used is in front
};

// At most kEventsASecond of each name, counted over `window`s that begin with one of them: within a
// second 20, within ten seconds 200.
class Rates {
public:
    explicit Rates(Duration window) : window_(window) {}
    bool allows(const std::string& name, Time now);
    size_t names() const { return counts_.size(); }

private:
    struct Count {
        Time since{};
        int64_t events = 0;
    };
    const Duration window_;
    std::map<std::string, Count> counts_;
};

}  // namespace vagus::fleet
