// How another version of the project comes into force (docs/field.md): received beside the one that
// runs, checked, put in force when the robot stands, started, and taken back if it does not start.
// Told the time; the robot is handed in, so that all of it runs in a test with a scripted clock.
//
//     Deployments deployments(versions, starter, {.check = …, .stop = …, .open = …, …});
//     deployments.boot(now);
//     deployments.begin(bundle);                      // deploy.begin, deploy.part, deploy.commit
//     deployments.part("a.aesl", 0, bytes);
//     deployments.commit([](DeployOutcome outcome) { … });
//     deployments.tick(now);
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "serve/edit/finding.hpp"
#include "serve/field/starter.hpp"
#include "serve/field/versions.hpp"

namespace vagus::serve {

constexpr Duration kStartWithin = 10s;  // of a new version; then the one before is in force again
constexpr uint32_t kTrialBootsMax = 3;  // that begin with a version which never started

struct DeployOutcome {
    enum class Result { Started, Stopped, Refused, RolledBack, Waiting };
    Result result = Result::Refused;
    uint32_t version = 0;  // that is in force now
    std::vector<Finding> findings = {};
    std::string why = {};  // a sentence, of all but Started
};

struct DeployCounts {
    uint64_t started = 0, refused = 0, rolled_back = 0;
};

class Deployments {
public:
    struct Robot {
        // What is wrong with the project in a folder.
        std::function<std::vector<Finding>(const std::filesystem::path&)> check;
        // The robot stands when `done` is called.
        std::function<void(std::function<void()> done)> stop;
        std::function<Status(const std::filesystem::path&)> open;
        std::function<void(const std::string& kind, const std::string& text)> log;
        std::function<double()> wall_ms;
    };
    using Done = std::function<void(DeployOutcome)>;

    // The first two are borrowed.
    Deployments(Versions& versions, Starter& starter, Robot robot)
        : versions_(versions), starter_(starter), robot_(std::move(robot)) {}

    // Decides what is in force, opens it, and starts it if the robot is to run by itself.
    Status boot(bool start, Time now);

    Status begin(Bundle bundle);
    // The files of the bundle in their order, each from its first byte to its last.
    Status part(const std::string& path, size_t from, std::string_view bytes);
    void commit(Done done);
    // Back to the version before.
    void back(Done done);
    // Somebody has pressed Stop: what is in force stays so, and stands.
    void stopped();

    bool busy() const { return done_ != nullptr; }
    const DeployCounts& counts() const { return counts_; }

    void tick(Time now);
    Time next_tick() const { return stands_ ? now_ : trying_ ? trying_->until : Time::max(); }

private:
    enum class IfNot { GoBack, Wait };  // if it does not start
    struct Trying {
        uint32_t version = 0, back = 0;
        Time until{};
        IfNot if_not = IfNot::GoBack;
    };

    Status receive(size_t from, std::string_view bytes);
    void refuse(const std::string& why, std::vector<Finding> findings = {});
    void stop_for(Trying next);
    void put_in_force(Trying next);
    void give_up(const std::string& why);
    void tried();
    void roll_back(const std::string& why);
    void finish(DeployOutcome outcome);

    Versions& versions_;
    Starter& starter_;
    Robot robot_;
    std::optional<Bundle> bundle_;  // on its way here
    size_t file_ = 0;               // of it, that is being received
    std::string content_;           // of that file, so far
    std::optional<Trying> trying_;
    std::optional<Trying> next_;  // in force as soon as the robot stands
    bool stands_ = false;         // it does
    bool stop_pressed_ = false;   // since the commit
    Done done_;
    DeployCounts counts_;
    Time now_{};
};

}  // namespace vagus::serve
