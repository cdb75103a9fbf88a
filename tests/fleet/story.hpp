// Random stories of a fleet: who is in it, who comes, goes and is cut off, and what is emitted; and
// who must hear what of it, counted by the rules of docs/fleet.md alone.
//
//     const Story story = random_story(seed);
//     const Heard expected = expected_of(story);
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "base/time.hpp"
#include "fleet/modelled_broker.hpp"
#include "fleet/project_part.hpp"

namespace vagus::fleet_tests {

using namespace std::chrono_literals;

constexpr size_t kRobotsMax = 6;
constexpr Duration kPhase = 30s;  // nothing that waits, or is counted, lasts from one to the next
constexpr size_t kASecond = 20;   // events of a name that one robot sends
constexpr const char* kFence = "fence";  // all send and hear it: what was sent before has come

struct Emission {
    size_t robot = 0;
    std::string event = {};
    int16_t number = 0;
    Duration before_next{};
};
// Robots come, and are there; others say that they go, or are cut off; then all that are left
// emit; then who was cut off comes back.
struct Phase {
    std::vector<size_t> come = {}, go = {}, cut = {};
    std::vector<Emission> emissions = {};
};
struct Story {
    fleet::WayModel model = {};
    std::vector<fleet::ProjectPart> robots = {};
    std::vector<Phase> phases = {};
};

struct FromRobot {
    size_t robot = 0;
    std::string event = {};
    int16_t number = 0;
    friend bool operator==(const FromRobot&, const FromRobot&) = default;
};
using Heard = std::vector<std::vector<FromRobot>>;  // by robot

inline std::string name_of(size_t robot) {
    return "r" + std::to_string(robot);
}
inline size_t number_of(const std::string& name) {
    return std::stoul(name.substr(1));
}
inline std::vector<FromRobot> only_of(size_t sender, const std::vector<FromRobot>& heard) {
    std::vector<FromRobot> list;
    std::ranges::copy_if(heard, std::back_inserter(list),
                         [sender](const FromRobot& one) { return one.robot == sender; });
    return list;
}

// ---- how stories are made ----

class StoryTeller {
public:
    explicit StoryTeller(uint64_t seed) : random_(seed) {}

    Story tell() {
        Story story;
        story.model = {.latency = Duration(1000 * random_.below(30)),
                       .jitter = Duration(1000 * random_.below(40)),
                       .loss = 0.3 * random_.unit(),
                       .twice = 0.3 * random_.unit()};
        for (size_t i = 0; i < kRobotsMax; ++i) story.robots.push_back(part());
        const size_t phases = 2 + random_.below(3);
        for (size_t i = 0; i < phases; ++i) story.phases.push_back(phase(i == 0));
        return story;
    }

private:
    static constexpr const char* kGroups[] = {"red", "blue", "green"};
    static constexpr const char* kEvents[] = {"alarm", "hello", "ping"};

    bool one_in(uint64_t several) { return random_.below(several) == 0; }

    fleet::ProjectPart part() {
        fleet::ProjectPart part{.send = {kFence}, .hear = {{.event = kFence}}};
        for (const char* group : kGroups) {
            if (one_in(2)) part.groups.emplace_back(group);
        }
        for (const char* event : kEvents) {
            if (!one_in(3)) part.send.emplace_back(event);
            if (one_in(2)) part.hear.push_back({.event = event});
            if (one_in(2)) part.hear.push_back({event, kGroups[random_.below(3)]});
        }
        return part;
    }

    Phase phase(bool first) {
        Phase phase;
        for (size_t robot = 0; robot < kRobotsMax; ++robot) {
            const bool there = there_.contains(robot);
            if (!there && (robot < 2 ? first : one_in(2)) && !gone_.contains(robot)) {
                phase.come.push_back(robot);
                there_.insert(robot);
            } else if (there && robot >= 2 && one_in(8)) {
                phase.go.push_back(robot);
                there_.erase(robot);
                gone_.insert(robot);
            } else if (there && one_in(6)) {
                phase.cut.push_back(robot);
            }
        }
        const size_t emissions = random_.below(50);
        const bool floods = one_in(4);  // one says more than it may
        const size_t who = any_that_is_there();
        for (size_t i = 0; i < emissions; ++i) {
            phase.emissions.push_back({.robot = floods ? who : any_that_is_there(),
                                       .event = kEvents[floods ? 0 : random_.below(3)],
                                       .number = number_++,
                                       .before_next = Duration(1000 * random_.below(10))});
        }
        return phase;
    }
    size_t any_that_is_there() {
        return *std::next(there_.begin(),
                          static_cast<std::ptrdiff_t>(random_.below(there_.size())));
    }

    SplitMix64 random_;
    std::set<size_t> there_, gone_;
    int16_t number_ = 0;
};

inline Story random_story(uint64_t seed) {
    return StoryTeller(seed).tell();
}

// ---- what the rules say ----

inline bool must_hear(const fleet::ProjectPart& by, const fleet::ProjectPart& from,
                      const std::string& event) {
    return std::ranges::any_of(by.hear, [&](const fleet::Hears& one) {
        return one.event == event &&
               (one.from.empty() || std::ranges::count(from.groups, one.from) > 0);
    });
}

// A cut loses nothing: it is over before anything is too old.
inline Heard expected_of(const Story& story) {
    Heard heard(kRobotsMax);
    std::set<size_t> there;
    for (const Phase& phase : story.phases) {
        there.insert(phase.come.begin(), phase.come.end());
        for (const size_t robot : phase.go) there.erase(robot);
        std::map<std::pair<size_t, std::string>, size_t> sent;
        for (const Emission& one : phase.emissions) {
            const fleet::ProjectPart& from = story.robots[one.robot];
            if (std::ranges::count(from.send, one.event) == 0) continue;
            if (++sent[{one.robot, one.event}] > kASecond) continue;
            for (const size_t by : there) {
                if (by == one.robot || !must_hear(story.robots[by], from, one.event)) continue;
                heard[by].push_back({one.robot, one.event, one.number});
            }
        }
    }
    return heard;
}

}  // namespace vagus::fleet_tests
