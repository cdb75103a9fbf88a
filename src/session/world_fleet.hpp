// The fleet of a simulated world: its robots with a project are members as real ones are
// (fleet/member.hpp), and between them is a broker in virtual time (fleet/modelled_broker.hpp). The
// world's file says how messages travel, and its timeline whose way is cut.
//
//     WorldFleet fleet(world.definition(), seed);
//     TRY(fleet.join(robot, ears));                      // a RobotBus whose project names a fleet
//     fleet.emitted(robot.id, event, now);                // a node of that robot said it
//     fleet.pass(now);                                    // calls the ears
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "fleet/keeping.hpp"
#include "fleet/member.hpp"
#include "fleet/modelled_broker.hpp"
#include "fleet/tell_list.hpp"
#include "session/member_fleet.hpp"
#include "session/sent_to_fleet.hpp"
#include "session/world_buses.hpp"
#include "sim/world.hpp"

namespace vagus::session {

constexpr Duration kShowEvery = std::chrono::milliseconds(100);  // to a real broker

class WorldFleet {
public:
    // Of a command: once, then or later, but not after this fleet is gone.
    using Answered = std::function<void(fleet::Answer)>;
    // What a robot does for the fleet. Called within pass().
    struct Ears {
        // `frame`: of the sender's bus, by its number; 0: not known.
        std::function<void(const fleet::EmitOnBus&, uint32_t frame)> hear;
        std::function<void(const std::string& why)> stop;
        std::function<void(const std::string& text)> say;
        // There is something new for templates that ask the fleet: what, with watch().
        std::function<void(const std::vector<FleetNews>&)> news = {};
        // With watch(): its plan asks the keeper, and the keeper has decided.
        MemberFleet::Asked asked = {};
        std::function<void(uint64_t number, const keeper::Reply& reply)> replied = {};
        // Of members at a real broker: what is shown of the robot, the values of a variable (the
        // Error says why it has none), a command, another version that is wanted.
        std::function<fleet::Shown()> shown = {};
        std::function<Result<std::vector<int16_t>>(const fleet::Tells& variable)> values = {};
        std::function<void(const fleet::Command&, Answered)> obey = {};
        std::function<void(const fleet::Want&)> want = {};
    };
    // To a real broker, in real time: a way for each robot instead of the modelled ones.
    struct Door {
        std::string fleet = {};  // instead of those that the projects name; empty: those
        // Unlike what any other member has, so that nobody takes it for that one.
        std::function<std::pair<std::string, int64_t>()> instance_and_epoch = {};
        std::function<Result<std::unique_ptr<fleet::Link>>(const fleet::MemberOptions& member,
                                                           fleet::Post will)>
            connect = {};
        // Of the wall: leases end also while a world is paused.
        std::function<Time()> now = {};
    };

    // The definition is borrowed.
    WorldFleet(const sim::WorldDefinition& world, uint64_t seed, std::optional<Door> door = {});
    // As leave().
    ~WorldFleet();
    // Members at a real broker say that they go, and nothing passes there any more.
    void leave();

    // A robot whose project names no fleet is in none. The Error says why it cannot be a member.
    // With `asks`, its plan asks the fleet: asked_by().
    Status join(const RobotBus& robot, const Ears& ears, bool asks = false);
    struct Emission {
        std::string name;
        std::vector<int16_t> arguments;
        uint32_t frame = 0;  // its number, where frames have one
    };
    void emitted(sim::RobotId robot, const Emission& event, Time now);
    // At a real broker: its project says something else, and it joins again as another instance, in
    // the fleet where it was.
    Status join_again(const RobotBus& robot, bool asks);
    // What became of the version that was wanted of it.
    void deployed(sim::RobotId robot, const fleet::Version& version);
    // What the plan of a robot asks; nullptr: it is in no fleet, or was not to ask.
    toolbox::Fleet* asked_by(sim::RobotId robot);
    // Before join(): ears are also told what `vagus why` needs.
    void watch() { watched_ = true; }
    // From now on the chance of the ways is drawn from that seed.
    void reseed(uint64_t seed) { broker_.reseed(seed); }
    // What is due by `now`, at each instant: the broker, then the timeline, then the members in the
    // order in which they joined.
    void pass(Time now);

private:
    // The way to the broker, which is modelled or real.
    struct Way {
        fleet::ModelledBroker::Way* modelled = nullptr;
        std::unique_ptr<fleet::Link> real = {};

        fleet::Link& link() { return modelled ? static_cast<fleet::Link&>(*modelled) : *real; }
        bool may_have_news() const { return modelled == nullptr || modelled->has_news(); }
    };
    struct Robot {
        sim::RobotId id;
        fleet::Member member;
        Way way = {};
        std::string name = {}, fleet = {};
        Ears ears = {};
        fleet::TellList tell;
        SentToFleet sent = {};
        Time show_at = {};
        std::unique_ptr<MemberFleet> asks = {};  // with a way of its own
        Way asks_way = {};
    };
    // Of one fleet, as a process of its own would be.
    struct Keeper {
        std::string fleet;
        std::unique_ptr<fleet::Keeping> keeping = {};  // nullptr: it was killed
        fleet::ModelledBroker::Way* way = nullptr;
        Time tick_at = {};
    };
    fleet::MemberOptions member_of(const RobotBus& robot) const;
    Result<std::unique_ptr<Robot>> made(const RobotBus& robot, const fleet::MemberOptions& options,
                                        const Ears& ears, bool asks);
    void leave(Robot& robot);
    void run_timeline(Time now);
    void act(const sim::CutFleet& action);
    void act(const sim::RunKeeper& action);
    Result<Way> connected(const fleet::MemberOptions& options, fleet::Post will);
    Status let_ask(Robot& robot, fleet::MemberOptions options);
    void add_keeper(const std::string& fleet);
    void start(Keeper& keeper);
    void turn(Keeper& keeper, Time now);
    void tell_reply(const Keeper& keeper, const fleet::Post& post) const;
    void ask(Robot& robot, Time at);
    void turn(Robot& robot, Time now);
    void show(Robot& robot, Time now);
    void obey(Robot& robot, const fleet::Command& command);
    fleet::Answer tell_for_a_minute(Robot& robot, const fleet::Tells& variable);
    void perform(Robot& robot);
    uint32_t frame_of(const fleet::EmitOnBus& event) const;

    const sim::WorldDefinition& world_;
    fleet::ModelledBroker broker_;
    const std::optional<Door> door_;
    std::vector<std::unique_ptr<Robot>> robots_;
    std::vector<Keeper> keepers_;  // in the order in which their fleets were named
    uint64_t keepers_started_ = 0;
    bool watched_ = false;
    bool left_ = false;
    std::vector<Robot*> by_id_;  // by robot of the world; nullptr: in no fleet
    size_t timeline_next_ = 0;
    Time now_{};
};

}  // namespace vagus::session
