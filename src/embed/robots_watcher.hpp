// Is told what the plans of several robots do, and what reaches these robots over their fleet:
// `vagus why`, log points and turning points listen.
//
//     class Log final : public embed::RobotsWatcher { … };
//     run.watch(&log);                                   // a RobotsRun, before its start()
//
// A robot is its place in buses().robots().
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "plan/trace.hpp"
#include "run/options.hpp"
#include "session/fleet_news.hpp"

namespace vagus::embed {

// An event of another robot that the fleet has brought: it goes out on the bus of the robot that
// hears it, and its plan hears it, too.
struct FleetEvent {
    uint32_t number = 0;  // FrameNumbers::other(), whose cause is the frame on the sender's bus
    std::string name;
    std::vector<int16_t> arguments;
    std::string from;  // the robot that sent it
};
// Its plan asks the keeper of its fleet.
struct KeeperAsked {
    uint64_t question = 0;  // of that robot, counted
    keeper::Request request;
};
// The keeper has decided on that question; the answer is on its way to the robot.
struct KeeperDecided {
    uint64_t question = 0;
    keeper::Reply reply;
};
// Its plan hears that there is something new.
struct FleetTold {
    uint32_t number = 0;  // FrameNumbers::other()
    std::vector<session::FleetNews> news;
};
using FromFleet = std::variant<FleetEvent, KeeperAsked, KeeperDecided, FleetTold>;

class RobotsWatcher {
public:
    RobotsWatcher() = default;
    RobotsWatcher(const RobotsWatcher&) = delete;
    RobotsWatcher& operator=(const RobotsWatcher&) = delete;
    virtual ~RobotsWatcher() = default;

    // A watcher overrides what it needs.

    // A line of the trace of its plan.
    virtual void line(size_t /*robot*/, const plan::TraceEvent&) {}
    // What a supervisor of its plan raises, before it is taken. True: it is passed over.
    virtual bool passes_over(size_t /*robot*/, const run::Raising&) { return false; }
    // Its plan has sent an event to its bus.
    virtual void sent(size_t /*robot*/, const run::BusEvent&) {}
    virtual void of_fleet(size_t /*robot*/, const FromFleet&) {}
    // It stops by itself: the fleet is gone, and its project says so.
    virtual void stopped(size_t /*robot*/, const std::string& /*why*/) {}
};

}  // namespace vagus::embed
