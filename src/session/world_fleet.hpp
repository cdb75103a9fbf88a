// The fleet of a simulated world: its robots with a project are members as real ones are
// (fleet/member.hpp), and between them is a broker in virtual time (fleet/modelled_broker.hpp). The
// world's file says how messages travel, and its timeline whose way is cut.
//
//     WorldFleet fleet(world.definition(), seed);
//     TRY(fleet.join(robot, ears));                      // a RobotBus whose project names a fleet
//     fleet.emitted(robot.id, "alarm", {}, now);          // a node of that robot said it
//     fleet.pass(now);                                    // calls the ears
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "fleet/member.hpp"
#include "fleet/modelled_broker.hpp"
#include "session/world_buses.hpp"
#include "sim/world.hpp"

namespace vagus::session {

class WorldFleet {
public:
    // What a robot does for the fleet. Called within pass().
    struct Ears {
        std::function<void(const fleet::EmitOnBus&)> hear;
        std::function<void(const std::string& why)> stop;
        std::function<void(const std::string& text)> say;
    };

    // The definition is borrowed.
    WorldFleet(const sim::WorldDefinition& world, uint64_t seed);

    // A robot whose project names no fleet is in none. The Error says why it cannot be a member.
    Status join(const RobotBus& robot, Ears ears);
    void emitted(sim::RobotId robot, const std::string& event, const std::vector<int16_t>& args,
                 Time now);
    // What is due by `now`, at each instant: the broker, then the timeline, then the members in the
    // order in which they joined.
    void pass(Time now);

private:
    struct Robot {
        fleet::Member member;
        fleet::ModelledBroker::Way* way = nullptr;
        std::string name;
        Ears ears;
    };
    void run_timeline(Time now);
    void act(const sim::CutFleet& action);
    void turn(Robot& robot, Time now);

    const sim::WorldDefinition& world_;
    fleet::ModelledBroker broker_;
    std::vector<std::unique_ptr<Robot>> robots_;
    std::vector<Robot*> by_id_;  // by robot of the world; nullptr: in no fleet
    size_t timeline_next_ = 0;
};

}  // namespace vagus::session
