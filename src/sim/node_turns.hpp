// The nodes of a world on their buses, the common one and those of robots with a project: at each
// instant those that are due get what was sent to them, sense, run, and what they send goes on its
// way. A node that has nothing to do is not looked at.
//
//     NodeTurns turns(definition, bus, heard);
//     const Status joined = turns.join({});
//     turns.move_in(inhabitants);                       // new robots, at the start of a run
//     turns.accept(now);                                // an instant: what hosts said before it …
//     turns.run(surroundings, crew);                    // … and all nodes that are due
//     turns.drive(arena, now, crew);                    // before each step of the arena
//
// It does not know: happenings, timelines, bodies. `heard` is told what nodes send.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/result.hpp"
#include "hub/hub.hpp"
#include "sim/crew.hpp"
#include "sim/frame_numbers.hpp"
#include "sim/frames_for_others.hpp"
#include "sim/inhabitants.hpp"
#include "sim/node_bus.hpp"
#include "sim/node_chaos.hpp"
#include "sim/robot.hpp"
#include "sim/schedule.hpp"

namespace vagus::sim {

// How frames travel on the common bus, and on that of a robot with a project: as `model` says, or
// else over a Can if a Carbot is on it, for which it is made.
BusModel common_bus_model(const WorldDefinition& definition, std::optional<BusModel> model);
BusModel own_bus_model(const RobotDefinition& robot, std::optional<BusModel> model);

class NodeTurns {
public:
    using Heard = std::function<void(size_t robot, const wire::Frame& frame)>;

    // `definition` and `bus`, which is the common one, must outlive this.
    NodeTurns(const WorldDefinition& definition, hub::Hub& bus, Heard heard);

    // The places of all nodes on their buses, for good; the model as above.
    Status join(std::optional<BusModel> model);
    // These are the robots now; what was on its way is gone. `inhabitants` must outlive this, or
    // until the next ones move in.
    void move_in(Inhabitants& inhabitants);

    // What hosts have sent by `now` is on a modelled bus.
    void accept(Time now);
    // The nodes that are due at around.now: deliveries, sensors, scripts; what they send is
    // delivered at the next instant. Robots that share nothing may have their turns on several
    // threads; what they send leaves in the order of their ids.
    void run(const Surroundings& around, Crew& crew);
    // All nodes, while time is stopped.
    void hold();
    // Variables to wheels, each robot its own.
    void drive(Arena& arena, Time now, Crew& crew);
    // Something was done to the robot from outside: it is due.
    void call(size_t robot);

    void send_to(size_t robot, hub::LinkId host, const wire::Frame& frame);
    hub::Hub& bus_of(size_t robot) { return *buses_[bus_index_of(robot)].hub; }
    std::optional<BusLoad> load() const { return load(buses_.front()); }
    std::optional<BusLoad> load_of(size_t robot) const { return load(buses_[bus_index_of(robot)]); }
    hub::Hub* private_bus(size_t robot) { return private_buses_[robot].get(); }
    void host_left(size_t robot);
    // As they are at `now`; empty if there is no such node, on the common bus or of that robot.
    std::span<const int16_t> variables_of(uint16_t node, Time now);
    std::span<const int16_t> variables_of(size_t robot, uint16_t node, Time now);
    // From now on frames have numbers; they are counted on when the next robots move in.
    FrameNumbers& number_frames();
    FrameNumbers* frame_numbers() { return numbers_.get(); }
    // Of all nodes; nullptr: nobody any more.
    void watch(Witness* witness);
    // As variables_of(); nullptr if there is no such node.
    const Machine* machine_of(size_t robot, uint16_t node, Time now);
    // ---- faults (docs/testing.md, "Chaos") ----
    // The nodes with their names, by their places; the robots with a bus of their own.
    std::vector<ChaosNode> chaos_nodes();
    std::vector<std::string> own_bus_robots() const;
    // Borrowed from now on; its places are those of chaos_nodes().
    void suffer(NodeChaos* chaos) { chaos_ = chaos; }
    // A fault of a node begins or ends.
    void take_edge(const ChaosEdge& edge, Time now);
    // That the fault is done to; nobody: a main computer.
    RobotId robot_of(const ChaosFault& fault) const;

    // How often a robot had its turn since the first one moved in.
    uint64_t turns_taken() const { return turns_taken_; }

private:
    // One node's places on the bus.
    struct Berth {
        size_t robot = 0;          // index of the robot it belongs to
        size_t place = 0;          // among its machines
        size_t bus = 0;            // which bus it is on
        hub::LinkId link;          // on that bus, if it is ideal
        hub::LinkId private_link;  // on that behind the robot's own port, if it has one
        FramesForOthers for_others = {};
        bool sent_to = false;     // something may wait in its queues
        uint32_t last_frame = 0;  // that it took, by its number
    };
    // A robot, and which berths are those of its nodes.
    struct Unit {
        size_t robot = 0;
        size_t first = 0;
        size_t end = 0;
        Time next{};            // when it is due again, as it said at the end of its turn
        bool has_sent = false;  // in its last turn
    };
    // The nodes of a bus have neighbouring berths.
    struct Bus {
        hub::Hub* hub = nullptr;
        std::optional<NodeBus> node_bus = {};  // between the nodes and `hub`, if it is a Can
        size_t first = 0;
        size_t end = 0;
    };
    // How a frame leaves its node when the bus is modelled.
    enum class Crossing : uint8_t { Timed, AtOnce };

    Robot& robot(size_t index) { return *inhabitants_->robots()[index]; }
    Machine& machine(const Berth& berth) { return *robot(berth.robot).machines()[berth.place]; }
    // As FrameOnBus counts them.
    static uint32_t bus_number_of(const Berth& berth) {
        return berth.bus == 0 ? 0 : static_cast<uint32_t>(berth.robot + 1);
    }
    size_t bus_index_of(size_t robot) const { return berths_[first_berth(robot)].bus; }
    size_t first_berth(size_t robot) const { return units_[unit_of_[robot]].first; }
    static std::optional<BusLoad> load(const Bus& bus);
    Status open_bus(hub::Hub& hub, const std::vector<size_t>& robots, BusModel model);
    Status take_berths(size_t robot, Bus& bus);
    bool is_waited_for(const Berth& berth, size_t index) const;
    void call_receivers();
    void call_reached(const Bus& bus);
    void take_turn(Unit& unit, const Surroundings& around);
    void deliver(size_t index);
    void call_suffering();
    bool suffers(const Unit& unit) const;
    void suffer_turn(Unit& unit, const Surroundings& around);
    void deliver_in_chaos(size_t index, Time now);
    void send_on(size_t index, const wire::Frame& frame, Time now, Crossing crossing);
    void collect(size_t index, Time now, Crossing crossing);
    void drain(const Berth& berth);
    void receive(Berth& berth, const wire::Frame& frame);

    const WorldDefinition& definition_;
    hub::Hub& bus_;
    Heard heard_;
    Inhabitants* inhabitants_ = nullptr;
    // The common one, then those of robots with a project, in the order of the file; stay where
    // they are.
    std::deque<Bus> buses_;
    std::vector<std::unique_ptr<hub::Hub>> own_buses_;
    std::vector<Berth> berths_;                             // by bus, then by ascending node id
    std::vector<Unit> units_;                               // by bus, then by ascending node id
    std::vector<size_t> unit_of_;                           // by index of the robot
    std::vector<std::unique_ptr<hub::Hub>> private_buses_;  // by index of the robot
    std::vector<size_t> looked_after_;  // berths whose queues tell nothing when they fill
    Schedule schedule_;                 // of the units
    std::vector<uint8_t> wheels_turn_;  // by index of the robot: its drive() has something new
    uint64_t turns_taken_ = 0;
    std::unique_ptr<FrameNumbers> numbers_;  // nullptr: frames have none
    Witness* witness_ = nullptr;
    NodeChaos* chaos_ = nullptr;  // nullptr: nothing breaks
};

}  // namespace vagus::sim
