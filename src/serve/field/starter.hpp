// Starts the robot without anybody: as soon as the nodes are there, again until it runs, and again
// when its run has died, but not for ever. Told the time; the rest is handed in, so that it runs in
// a test with a scripted clock.
//
//     Starter starter({.missing = …, .start = …, .log = …});
//     starter.begin(now);
//     starter.tick(now);
//     if (starter.state() == Starter::State::Started) …
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "base/time.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kLookForNodesEvery = 200ms;
constexpr Duration kStartAgainAfter = 1s;  // of a start that failed, or of a death
constexpr size_t kDeathsMax = 5;           // so many within kDeathsWithin, and it stays stopped
constexpr Duration kDeathsWithin = 60s;

class Starter {
public:
    struct Callbacks {
        // Names of nodes that must be there and are not yet.
        std::function<std::vector<std::string>()> missing;
        // Lets everything run; `done` gets why it does not, or nothing.
        std::function<void(std::function<void(const std::string& why)> done)> start;
        // A sentence for the log; each is told once.
        std::function<void(const std::string& kind, const std::string& text)> log;
    };
    enum class State { Idle, Waiting, Starting, Started, Failed };

    explicit Starter(Callbacks calls) : call_(std::move(calls)) {}

    void begin(Time now);
    // It is to stay stopped.
    void give_up();
    // Its run has died.
    void died(Time now);
    // Its plan ended in an error: another start would end so again.
    void failed(const std::string& why);

    State state() const { return state_; }
    // Why it does not run yet: a sentence.
    const std::string& why() const { return why_; }
    // The same of the start that was tried last, also while it is tried again; empty: it succeeded,
    // or none was tried.
    const std::string& refused() const { return refused_; }

    void tick(Time now);
    Time next_tick() const;

private:
    void wait(const std::string& kind, const std::string& why, Time until);

    Callbacks call_;
    State state_ = State::Idle;
    std::string why_;
    std::string refused_;
    std::string told_;
    std::deque<Time> deaths_;  // the last ones
    Time next_{};
    Time now_{};
    uint64_t attempt_ = 0;  // an answer to an earlier one says nothing any more
};

}  // namespace vagus::serve
