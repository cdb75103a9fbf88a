// Who is there? When a host may stop waiting for answers: not after a fixed short time, for a board
// may be slow, but when as much time has passed without an answer as answers have taken so far.
//
//     RollCall call(network, now, {.quiet = 300ms, .wanted = {3}});
//     while (!call.over(network, now)) call.hear(wait_until(call.next()));
#pragma once

#include <set>
#include <vector>

#include "debug/network.hpp"

namespace vagus::debug {

constexpr Duration kQuiet = std::chrono::milliseconds(300);  // after the last answer: all are known
constexpr Duration kFirstAnswerWithin = std::chrono::milliseconds(2000);
// One that is asked for by its number, after the last that was heard of it while it cannot be
// worked with yet.
constexpr Duration kWantedWithin = std::chrono::milliseconds(5000);
// Nodes that have not described themselves are waited for as long as others still do.
constexpr Duration kNodesWithin = std::chrono::milliseconds(3000);
constexpr Duration kRollCallMax = std::chrono::seconds(30);  // however many go on answering

struct RollCallOptions {
    Duration quiet = kQuiet;
    Duration first_within = kFirstAnswerWithin;
    std::vector<NodeId> wanted = {};  // asked for by number: each is asked itself, too
    bool only_wanted = false;         // then nobody else is waited for
};

class RollCall {
public:
    // Asks who is there.
    RollCall(Network& network, Time now, RollCallOptions options);
    void hear(const Event& event);
    // Asks again what has to be asked.
    bool over(Network& network, Time now);
    // When over() may say something else, if nobody answers until then.
    Time next() const { return next_; }

private:
    bool has(const Network& network, NodeId id) const;
    bool has_wanted(const Network& network) const;
    Time last_sign(const Network& network, NodeId id) const;
    Time end(const Network& network) const;

    RollCallOptions options_;
    Time start_{};
    Time last_answer_{};
    Duration slowest_{};  // of those that said that they are there
    bool answered_ = false;
    bool settled_ids_ = false;  // whether two nodes share one was asked
    Time next_{};
    Time call_again_{};
    std::set<NodeId> silent_;  // would not describe themselves
};

}  // namespace vagus::debug
