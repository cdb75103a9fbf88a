// The version that a fleet wants of this robot (docs/fleet.md, "Another version for many"):
// fetched, checked against its hash, put in force as one that `vagus deploy` sends, and told. Each
// roll-out has a number, and is done once, also if the robot was started again meanwhile: what came
// of the last one is in PROJECT/.vagus/want/ROBOT.json, and that going back was begun. It is a file
// for each robot: two may be served from one folder, and each is told something else. A project
// with a condition of its own is watched from its start until that was true for long enough, and
// each change of what it lacks is told.
//
//     Wanted wanted(deployments, {.file = …, .fetch = …, .work = worker.poster(), .tell = …});
//     wanted.want(want);   // as often as it comes
//     wanted.tick(now);    // when something may have changed
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/result.hpp"
#include "fleet/message.hpp"
#include "serve/field/deployments.hpp"
#include "serve/field/health_watch.hpp"
#include "serve/workbench/pack.hpp"
#include "serve/worker.hpp"

namespace vagus::serve {

class Wanted {
public:
    struct Callbacks {
        std::string file = {};  // where it is remembered
        // What is at that address; called on the other thread.
        std::function<Result<std::string>(const std::string& address)> fetch;
        Worker::Post work = Worker::at_once;
        std::function<void(const fleet::Version& version)> tell;
        std::function<void(const std::string& kind, const std::string& text)> log;
        // Of the project that is in force: its condition, if it has one, and the values in it.
        std::function<std::optional<fleet::Healthy>()> healthy = [] {
            return std::optional<fleet::Healthy>();
        };
        HealthWatch::Read read = [](auto&) { return Error{Code::Unavailable, "nothing is read"}; };
    };
    // `deployments` is borrowed.
    Wanted(Deployments& deployments, Callbacks calls);

    // What an earlier version has remembered in that file, for whichever robot: it is that of this
    // one now, unless it has one of its own.
    void adopt(const std::string& file);
    void want(const fleet::Want& want);
    void tick(Time now);
    Time next_tick() const;
    // It has started, and its condition was not true for long enough yet.
    bool lacks_health() const;
    // What came of the last one.
    const std::optional<fleet::Version>& last() const { return last_; }

private:
    void begin();
    void go_back();
    bool was_interrupted(const fleet::Want& want) const;
    void fetched(const vagus::Result<Packed>& packed);
    void send(const std::shared_ptr<const Packed>& packed, size_t file);
    void over(const DeployOutcome& outcome);
    void told(const std::string& result, const std::string& why);
    Status keep() const;
    void keep_or_warn() const;
    void watch_health();

    Deployments& deployments_;
    Callbacks call_;
    std::optional<fleet::Want> next_;  // it waits for its turn
    std::optional<fleet::Want> under_way_;
    std::optional<fleet::Version> last_;
    std::optional<HealthWatch> health_;
    uint64_t stops_before_ = 0;  // of the one that is under way
    Time now_{}, tell_at_{};
};

}  // namespace vagus::serve
