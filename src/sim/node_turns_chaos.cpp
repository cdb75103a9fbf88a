// Turns of nodes that faults are done to (node_chaos.hpp): what is lost, late, spoilt, or not done.
#include <algorithm>

#include "sim/node_turns.hpp"

namespace vagus::sim {

std::vector<ChaosNode> NodeTurns::chaos_nodes() {
    std::vector<ChaosNode> nodes;
    for (const Berth& berth : berths_) {
        const Machine& its = machine(berth);
        nodes.push_back({definition_.robots[berth.robot].name, its.name(), &its});
    }
    return nodes;
}

std::vector<std::string> NodeTurns::own_bus_robots() const {
    std::vector<std::string> names;
    for (const RobotDefinition& robot : definition_.robots) {
        if (!robot.project.empty()) names.push_back(robot.name);
    }
    return names;
}

void NodeTurns::take_edge(const ChaosEdge& edge, Time now) {
    const ChaosFault& fault = *edge.fault;
    const std::optional<size_t> node = chaos_->node_of(fault);
    if (!node) return;
    const Berth& berth = berths_[*node];
    robot(berth.robot).catch_up(now - kNodeStep);
    if (edge.begins) {
        chaos_->begin(fault);
    } else {
        chaos_->end(fault, machine(berth));
    }
    const bool watchdog = fault.kind == ChaosKind::Hung && !edge.begins;
    if (fault.kind == ChaosKind::Reset || watchdog) {
        machine(berth).switch_on_again(chaos_->switched_on(*node));
    }
    call(berth.robot);
}

RobotId NodeTurns::robot_of(const ChaosFault& fault) const {
    const std::optional<size_t> node = chaos_->node_of(fault);
    return node ? RobotId{static_cast<uint32_t>(berths_[*node].robot) + 1} : RobotId{};
}

bool NodeTurns::suffers(const Unit& unit) const {
    for (size_t i = unit.first; i < unit.end; ++i) {
        if (chaos_->suffers(i)) return true;
    }
    return false;
}

void NodeTurns::call_suffering() {
    for (const Unit& unit : units_) {
        if (suffers(unit)) call(unit.robot);
    }
}

// As take_turn(), with the faults in between.
void NodeTurns::suffer_turn(Unit& unit, const Surroundings& around) {
    Robot& its = robot(unit.robot);
    its.catch_up(around.now - kNodeStep);
    for (size_t i = unit.first; i < unit.end; ++i) deliver_in_chaos(i, around.now);
    for (size_t i = unit.first; i < unit.end; ++i) chaos_->give_back(i, machine(berths_[i]));
    its.sense(around);
    for (size_t i = unit.first; i < unit.end; ++i) {
        chaos_->spoil(i, machine(berths_[i]), around.now);
        if (!chaos_->hangs(i)) machine(berths_[i]).run();
    }
    unit.has_sent = true;  // what is late may be due
    unit.next = around.now + kNodeStep;
}

void NodeTurns::deliver_in_chaos(size_t index, Time now) {
    Berth& berth = berths_[index];
    Bus& bus = buses_[berth.bus];
    Machine& node = machine(berth);
    ChaosLine& line = chaos_->to(index);
    node.begin_millisecond();
    wire::Frame frame;
    const auto take = [&] {
        return bus.node_bus ? bus.node_bus->take(index - bus.first, frame)
                            : bus.hub->take(berth.link, frame);
    };
    while (berth.sent_to && take()) {
        if (!berth.for_others.take(frame)) line.put(frame, now);
    }
    while (node.wants_frame() && line.take(frame, now)) receive(berth, frame);
    hub::Hub* const own_bus = private_buses_[berth.robot].get();
    const bool hangs = chaos_->hangs(index);
    while (own_bus != nullptr && (hangs || node.wants_frame()) &&
           own_bus->take(berth.private_link, frame)) {
        if (!hangs) node.receive(frame);
    }
    berth.sent_to = own_bus != nullptr && own_bus->waiting(berth.private_link) > 0;
}

}  // namespace vagus::sim
