// How another version of the project comes into force (docs/field.md): received beside the one that
// runs, checked, put in force when the robot is at rest, started, and taken back if it does not
// start. Told the time; the robot is handed in, so that all of it runs in a test with a scripted
// clock. The disk and the checks are the work of another thread.
//
//     Deployments deployments(versions, starter, {.check = …, .stop = …, .open = …, .log = …});
//     deployments.boot(start, now);
//     deployments.begin(bundle);                      // deploy.begin, deploy.part, deploy.commit
//     deployments.part("a.aesl", 0, bytes, [](const Status& taken) { … });
//     deployments.commit([](DeployOutcome outcome) { … });
//     deployments.tick(now);
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "serve/edit/doc_finding.hpp"
#include "serve/field/starter.hpp"
#include "serve/field/versions.hpp"
#include "serve/worker.hpp"

namespace vagus::serve {

constexpr Duration kStartWithin = 10s;  // of a new version; then the one before is in force again
constexpr Duration kProvesWithin = 3s;  // that its plan does not fail at once
constexpr uint32_t kTrialBootsMax = 3;  // that begin with a version which never started

struct DeployOutcome {
    enum class Result { Started, Stopped, Refused, RolledBack, Waiting };
    Result result = Result::Refused;
    uint32_t version = 0;  // that is in force now
    std::vector<DocFinding> findings = {};
    std::string why = {};  // a sentence; of Started, how its plan is by then
};

// "started", as the protocol and fleets have it.
const char* word_of(DeployOutcome::Result result);

struct DeployCounts {
    uint64_t started = 0, refused = 0, rolled_back = 0;
};

class Deployments {
public:
    struct Callbacks {
        // What finds, on another thread, what is wrong with the project in a folder.
        using Check = std::function<std::vector<DocFinding>(const std::filesystem::path&)>;
        std::function<Check()> check;
        // The robot is at rest when `done` is called.
        std::function<void(std::function<void()> done)> stop;
        std::function<Status(const std::filesystem::path&)> open;
        std::function<void(const std::string& kind, const std::string& text)> log;
        std::function<double()> wall_ms;
        // How the plan is: "its plan runs"; empty: there is none.
        std::function<std::string()> plan = [] { return std::string(); };
        Worker::Post work = Worker::at_once;
    };
    using Done = std::function<void(DeployOutcome)>;
    using Taken = std::function<void(const Status&)>;

    // The first two are borrowed.
    Deployments(Versions& versions, Starter& starter, Callbacks calls)
        : versions_(versions), starter_(starter), call_(std::move(calls)) {}

    // Decides what is in force, opens it, and starts it if the robot is to run by itself.
    Status boot(bool start, Time now);

    Status begin(Bundle bundle);
    // The files of the bundle in their order, each from its first byte to its last.
    void part(const std::string& path, size_t from, std::string_view bytes, Taken taken);
    void commit(Done done);
    // Back to the version before.
    void back(Done done);
    // Stop was pressed: what is in force stays so, and is stopped. A version that was begun before
    // comes in force, but does not start.
    void stopped();
    // How often it was.
    uint64_t stops() const { return stops_; }

    // Nothing is under way that another version would wait for.
    bool may_begin() const { return !busy() && !trying_; }
    bool busy() const { return done_ != nullptr || working_ > 0; }
    const DeployCounts& counts() const { return counts_; }

    void tick(Time now);
    Time next_tick() const;

private:
    enum class IfNot { GoBack, Wait };  // if it does not start
    struct Trying {
        uint32_t version = 0, back = 0;
        Time until{};
        IfNot if_not = IfNot::GoBack;
        std::optional<Time> started = {};
    };

    // Another thread does the first, this one the second with its outcome.
    template <typename Outcome>
    void work(std::function<Outcome()> act, std::function<void(Outcome)> then);
    Status check_part(const std::string& path, size_t from, size_t size) const;
    void add_file(Taken taken);
    void checked(const vagus::Result<std::vector<DocFinding>>& found);
    void received(const vagus::Result<uint32_t>& number);
    void refuse(const std::string& why, std::vector<DocFinding> findings = {});
    void stop_for(Trying next);
    void put_in_force(Trying next);
    void in_force(Trying next, const Status& switched);
    void give_up(const std::string& why);
    void tried();
    void roll_back(const std::string& why);
    void rolled_back(const Status& back, const std::string& why);
    void finish(DeployOutcome outcome);

    Versions& versions_;
    Starter& starter_;
    Callbacks call_;
    std::optional<Bundle> bundle_;  // on its way here
    size_t file_ = 0;               // of it, that is being received
    std::string content_;           // of that file, so far
    std::optional<Trying> trying_;
    std::optional<Trying> next_;  // in force as soon as the robot is at rest
    bool stands_ = false;         // it does
    bool stop_pressed_ = false;   // since it was begun
    uint64_t stops_ = 0;
    Done done_;
    size_t working_ = 0;  // pieces of work under way
    DeployCounts counts_;
    Time now_{};
};

}  // namespace vagus::serve
