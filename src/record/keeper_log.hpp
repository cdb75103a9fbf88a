// What the keepers of the fleets of a run have decided, in their order: so that one who got
// something can be told who gave it.
//
//     log.add({.bus = 1, .question = 7, .at = now}, request, reply);
//     const auto giver = log.giver_of(2, 3);                      // who gave the same thing back
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "keeper/records.hpp"

namespace vagus::record {

// A question of the plan on that bus, and when the keeper decided on it.
struct DecidedQuestion {
    size_t bus = 0;
    uint64_t question = 0;
    Time at{};
    std::string thing = {};  // what it was about: thing_of()
    bool is(size_t of_bus, uint64_t number) const { return bus == of_bus && question == number; }
};

class KeeperLog {
public:
    // A decision that is told again says nothing new.
    void add(const DecidedQuestion& asked, const keeper::Request& request,
             const keeper::Reply& reply);
    // Who had the task or the name that this question got, and gave it: for the fleet, or back.
    // Nothing: nobody did; a lease that ended by itself was given by nobody.
    std::optional<DecidedQuestion> giver_of(size_t bus, uint64_t question) const;
    // Who wrote that version of a shared value.
    std::optional<DecidedQuestion> writer_of(const keeper::Shared& value) const;

private:
    struct Step {
        DecidedQuestion asked;
        bool gives = false;  // else it got it
    };
    std::map<std::pair<size_t, uint64_t>, std::string> got_;  // what, by who asked
    std::map<std::string, std::vector<Step>> steps_;          // of a task or a name
    std::map<std::pair<std::string, keeper::Term>, DecidedQuestion> written_;
};

// "the name hall", "the task task-3 of fetch", "the shared value meeting".
std::string thing_of(const keeper::Record& record);

}  // namespace vagus::record
