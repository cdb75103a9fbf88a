#include "sim/node_turns.hpp"

#include <algorithm>
#include <cassert>

namespace vagus::sim {

NodeTurns::NodeTurns(const WorldDefinition& definition, hub::Hub& bus, Heard heard)
    : definition_(definition), bus_(bus), heard_(std::move(heard)) {}

// ---- places on the bus ----

Status NodeTurns::join(BusModel model) {
    std::vector<size_t> by_node;
    for (size_t i = 0; i < definition_.robots.size(); ++i) by_node.push_back(i);
    std::sort(by_node.begin(), by_node.end(), [this](size_t a, size_t b) {
        return definition_.robots[a].node < definition_.robots[b].node;
    });
    private_buses_.resize(by_node.size());
    unit_of_.resize(by_node.size());
    if (model == BusModel::Can) node_bus_.emplace(bus_, TRY(bus_.add({.name = "nodes"})));
    for (const size_t index : by_node) {
        const RobotDefinition& robot = definition_.robots[index];
        if (robot.port) private_buses_[index] = std::make_unique<hub::Hub>();
        unit_of_[index] = units_.size();
        units_.push_back({index, berths_.size(), berths_.size() + nodes_of(robot.type), {}, false});
        for (size_t place = 0; place < nodes_of(robot.type); ++place) {
            Berth berth{index, place, {}, {}, {}, false};
            const auto id = static_cast<uint16_t>(robot.node + place);
            const hub::LinkOptions link{.name = robot.name, .only_node = id};
            if (!node_bus_) berth.link = TRY(bus_.add(link));
            if (robot.port) berth.private_link = TRY(private_buses_[index]->add(link));
            if (node_bus_ || robot.port) looked_after_.push_back(berths_.size());
            berths_.push_back(berth);
        }
    }
    return Status::done();
}

// On a modelled bus they have the names that their descriptions give them; those of one robot among
// several have its name before them.
void NodeTurns::move_in(Inhabitants& inhabitants) {
    inhabitants_ = &inhabitants;
    schedule_.start(units_.size());
    wheels_turn_.assign(units_.size(), 1);
    for (Berth& berth : berths_) {
        berth.for_others.clear();
        berth.sent_to = false;
        drain(berth);
    }
    if (!node_bus_) return;
    if (node_bus_->size() > 0) {
        node_bus_->reset();
        return;
    }
    for (const Berth& berth : berths_) {
        const std::string& name = definition_.robots[berth.robot].name;
        const std::string prefix = definition_.robots.size() > 1 ? name + "/" : "";
        node_bus_->join(machine(berth).id(), prefix + machine(berth).name());
    }
}

void NodeTurns::drain(const Berth& berth) {
    wire::Frame frame;
    while (!node_bus_ && bus_.take(berth.link, frame)) {
    }
    hub::Hub* const own_bus = private_buses_[berth.robot].get();
    while (own_bus != nullptr && own_bus->take(berth.private_link, frame)) {
    }
}

// ---- an instant ----

void NodeTurns::accept(Time now) {
    if (node_bus_) node_bus_->accept(now);
}

void NodeTurns::call(size_t robot) {
    schedule_.call(unit_of_[robot]);
}

bool NodeTurns::is_waited_for(const Berth& berth, size_t index) const {
    const hub::Hub* const own_bus = private_buses_[berth.robot].get();
    return (node_bus_ && node_bus_->has_frames(index)) ||
           (own_bus != nullptr && own_bus->waiting(berth.private_link) > 0);
}

// A node that was sent something is due.
void NodeTurns::call_receivers() {
    for (const hub::LinkId link : bus_.take_reached()) {
        const size_t index = link.number - berths_.front().link.number;
        assert(berths_[index].link == link);  // they were added in a row
        berths_[index].sent_to = true;
        call(berths_[index].robot);
    }
    for (const size_t index : looked_after_) {
        if (!is_waited_for(berths_[index], index)) continue;
        berths_[index].sent_to = true;
        call(berths_[index].robot);
    }
}

void NodeTurns::run(const Surroundings& around, Crew& crew) {
    if (node_bus_) node_bus_->advance(around.now);
    call_receivers();
    const std::vector<uint32_t>& due = schedule_.due(around.now);
    crew.each(due.size(), [&](size_t i) { take_turn(units_[due[i]], around); });
    for (const uint32_t each : due) {
        const Unit& unit = units_[each];
        schedule_.set(each, unit.next);
        wheels_turn_[unit.robot] = 1;
        if (!unit.has_sent) continue;
        for (size_t i = unit.first; i < unit.end; ++i) collect(i, around.now, Crossing::Timed);
    }
    turns_taken_ += due.size();
}

// Touches nothing but the robot, its berths and its own queues.
void NodeTurns::take_turn(Unit& unit, const Surroundings& around) {
    Robot& its = robot(unit.robot);
    its.catch_up(around.now - kNodeStep);
    bool more = false;
    for (size_t i = unit.first; i < unit.end; ++i) {
        deliver(i);
        more = more || berths_[i].sent_to;
    }
    its.sense(around);
    unit.has_sent = false;
    for (Machine* const machine : its.machines()) {
        machine->run();
        unit.has_sent = unit.has_sent || !machine->sent().empty();
    }
    unit.next = more ? around.now + kNodeStep : its.next_due(around.now);
}

void NodeTurns::hold() {
    if (node_bus_) node_bus_->accept_at_once();
    call_receivers();
    for (size_t i = 0; i < berths_.size(); ++i) deliver(i);
    for (const Berth& berth : berths_) machine(berth).run();
    for (size_t i = 0; i < berths_.size(); ++i) collect(i, Time{}, Crossing::AtOnce);
    schedule_.start(units_.size());
}

void NodeTurns::drive(Arena& arena, Time now, Crew& crew) {
    crew.each(wheels_turn_.size(), [&](size_t i) {
        if (wheels_turn_[i] != 0) wheels_turn_[i] = robot(i).drive(arena, now) ? 1 : 0;
    });
}

// ---- the bus ----

void NodeTurns::deliver(size_t index) {
    Berth& berth = berths_[index];
    Machine& node = machine(berth);
    node.begin_millisecond();
    if (!berth.sent_to) return;
    wire::Frame frame;
    const auto take = [&] {
        return node_bus_ ? node_bus_->take(index, frame) : bus_.take(berth.link, frame);
    };
    while (node.wants_frame() && take()) {
        if (!berth.for_others.take(frame)) node.receive(frame);
    }
    hub::Hub* const own_bus = private_buses_[berth.robot].get();
    while (own_bus != nullptr && node.wants_frame() && own_bus->take(berth.private_link, frame))
        node.receive(frame);
    berth.sent_to = !node.wants_frame();  // it may look at no more in this millisecond
}

void NodeTurns::collect(size_t index, Time now, Crossing crossing) {
    const Berth& berth = berths_[index];
    Machine& node = machine(berth);
    hub::Hub* const own_bus = private_buses_[berth.robot].get();
    for (const wire::Frame& frame : node.sent()) {
        if (!node_bus_)
            bus_.receive(berth.link, frame);
        else if (crossing == Crossing::Timed)
            node_bus_->send(index, frame, now);
        else
            node_bus_->send_at_once(index, frame);
        if (own_bus != nullptr) own_bus->receive(berth.private_link, frame);
        heard_(berth.robot, frame);
    }
    node.sent().clear();
}

void NodeTurns::send_to(size_t robot, hub::LinkId host, const wire::Frame& frame) {
    for (Berth& berth : berths_)
        if (berth.robot != robot) berth.for_others.add(frame);
    bus_.receive(host, frame);
}

std::optional<BusLoad> NodeTurns::load() const {
    if (!node_bus_) return std::nullopt;
    return node_bus_->load();
}

void NodeTurns::host_left(size_t index) {
    for (Machine* const machine : robot(index).machines()) machine->host_left();
}

std::span<const int16_t> NodeTurns::variables_of(uint16_t node, Time now) {
    const auto found = std::lower_bound(
        berths_.begin(), berths_.end(), node,
        [this](const Berth& berth, uint16_t id) { return machine(berth).id() < id; });
    if (found == berths_.end() || machine(*found).id() != node) return {};
    robot(found->robot).catch_up(now);
    return machine(*found).variables();
}

}  // namespace vagus::sim
