#include "sim/node_turns.hpp"

#include <algorithm>
#include <cassert>

namespace vagus::sim {

BusModel common_bus_model(const WorldDefinition& definition, std::optional<BusModel> model) {
    const bool has_carbot = std::any_of(
        definition.robots.begin(), definition.robots.end(), [](const RobotDefinition& robot) {
            return robot.project.empty() && robot.type == RobotType::Carbot;
        });
    return model.value_or(has_carbot ? BusModel::Can : BusModel::Ideal);
}

BusModel own_bus_model(const RobotDefinition& robot, std::optional<BusModel> model) {
    const bool is_carbot = robot.type == RobotType::Carbot;
    return model.value_or(is_carbot ? BusModel::Can : BusModel::Ideal);
}

NodeTurns::NodeTurns(const WorldDefinition& definition, hub::Hub& bus, Heard heard)
    : definition_(definition), bus_(bus), heard_(std::move(heard)) {}

// ---- places on the bus ----

Status NodeTurns::join(std::optional<BusModel> model) {
    const size_t robots = definition_.robots.size();
    private_buses_.resize(robots);
    unit_of_.resize(robots);
    std::vector<size_t> on_common;
    for (size_t i = 0; i < robots; ++i) {
        if (definition_.robots[i].project.empty()) on_common.push_back(i);
    }
    std::sort(on_common.begin(), on_common.end(), [this](size_t a, size_t b) {
        return definition_.robots[a].node < definition_.robots[b].node;
    });
    TRY(open_bus(bus_, on_common, common_bus_model(definition_, model)));
    for (size_t i = 0; i < robots; ++i) {
        if (definition_.robots[i].project.empty()) continue;
        own_buses_.push_back(std::make_unique<hub::Hub>());
        TRY(open_bus(*own_buses_.back(), {i}, own_bus_model(definition_.robots[i], model)));
    }
    return Status::done();
}

// `robots` by ascending node id.
Status NodeTurns::open_bus(hub::Hub& hub, const std::vector<size_t>& robots, BusModel model) {
    Bus& bus = buses_.emplace_back();
    bus.hub = &hub;
    bus.first = bus.end = berths_.size();
    if (model == BusModel::Can) bus.node_bus.emplace(hub, TRY(hub.add({.name = "nodes"})));
    for (const size_t robot : robots) TRY(take_berths(robot, bus));
    bus.end = berths_.size();
    return Status::done();
}

Status NodeTurns::take_berths(size_t index, Bus& bus) {
    const RobotDefinition& robot = definition_.robots[index];
    if (robot.port) private_buses_[index] = std::make_unique<hub::Hub>();
    unit_of_[index] = units_.size();
    units_.push_back({index, berths_.size(), berths_.size() + nodes_of(robot.type), {}, false});
    for (size_t place = 0; place < nodes_of(robot.type); ++place) {
        Berth berth{index, place, buses_.size() - 1, {}, {}, {}, false};
        const auto id = static_cast<uint16_t>(robot.node + place);
        const hub::LinkOptions link{.name = robot.name, .only_node = id};
        if (!bus.node_bus) berth.link = TRY(bus.hub->add(link));
        if (robot.port) berth.private_link = TRY(private_buses_[index]->add(link));
        if (bus.node_bus || robot.port) looked_after_.push_back(berths_.size());
        berths_.push_back(berth);
    }
    return Status::done();
}

// On a modelled bus they have the names that their descriptions give them; those of one robot among
// several on a bus have its name before them.
void NodeTurns::move_in(Inhabitants& inhabitants) {
    inhabitants_ = &inhabitants;
    watch(witness_);
    schedule_.start(units_.size());
    wheels_turn_.assign(units_.size(), 1);
    for (Berth& berth : berths_) {
        berth.for_others.clear();
        berth.sent_to = false;
        drain(berth);
    }
    for (Bus& bus : buses_) {
        if (!bus.node_bus) continue;
        if (bus.node_bus->size() > 0) {
            bus.node_bus->reset();
            continue;
        }
        if (bus.first == bus.end) continue;
        const bool several = berths_[bus.first].robot != berths_[bus.end - 1].robot;
        for (size_t i = bus.first; i < bus.end; ++i) {
            const std::string& name = definition_.robots[berths_[i].robot].name;
            const std::string prefix = several ? name + "/" : "";
            bus.node_bus->join(machine(berths_[i]).id(), prefix + machine(berths_[i]).name());
        }
    }
}

void NodeTurns::drain(const Berth& berth) {
    Bus& bus = buses_[berth.bus];
    wire::Frame frame;
    while (!bus.node_bus && bus.hub->take(berth.link, frame)) {
    }
    hub::Hub* const own_bus = private_buses_[berth.robot].get();
    while (own_bus != nullptr && own_bus->take(berth.private_link, frame)) {
    }
}

// ---- an instant ----

void NodeTurns::accept(Time now) {
    for (Bus& bus : buses_) {
        if (bus.node_bus) bus.node_bus->accept(now);
    }
}

void NodeTurns::call(size_t robot) {
    schedule_.call(unit_of_[robot]);
}

bool NodeTurns::is_waited_for(const Berth& berth, size_t index) const {
    const hub::Hub* const own_bus = private_buses_[berth.robot].get();
    const Bus& bus = buses_[berth.bus];
    return (bus.node_bus && bus.node_bus->has_frames(index - bus.first)) ||
           (own_bus != nullptr && own_bus->waiting(berth.private_link) > 0);
}

// On an ideal bus the hub knows.
void NodeTurns::call_reached(const Bus& bus) {
    for (const hub::LinkId link : bus.hub->take_reached()) {
        const size_t index = bus.first + link.number - berths_[bus.first].link.number;
        assert(berths_[index].link == link);  // they were added in a row
        berths_[index].sent_to = true;
        call(berths_[index].robot);
    }
}

// A node that was sent something is due.
void NodeTurns::call_receivers() {
    for (const Bus& bus : buses_) call_reached(bus);
    for (const size_t index : looked_after_) {
        if (!is_waited_for(berths_[index], index)) continue;
        berths_[index].sent_to = true;
        call(berths_[index].robot);
    }
}

void NodeTurns::run(const Surroundings& around, Crew& crew) {
    for (Bus& bus : buses_) {
        if (bus.node_bus) bus.node_bus->advance(around.now);
    }
    call_receivers();
    if (chaos_ != nullptr) call_suffering();
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
    if (chaos_ != nullptr && suffers(unit)) return suffer_turn(unit, around);
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
    for (Bus& bus : buses_) {
        if (bus.node_bus) bus.node_bus->accept_at_once();
    }
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
    Bus& bus = buses_[berth.bus];
    Machine& node = machine(berth);
    node.begin_millisecond();
    if (!berth.sent_to) return;
    wire::Frame frame;
    const auto take = [&] {
        return bus.node_bus ? bus.node_bus->take(index - bus.first, frame)
                            : bus.hub->take(berth.link, frame);
    };
    while (node.wants_frame() && take()) {
        if (!berth.for_others.take(frame)) receive(berth, frame);
    }
    hub::Hub* const own_bus = private_buses_[berth.robot].get();
    while (own_bus != nullptr && node.wants_frame() && own_bus->take(berth.private_link, frame))
        node.receive(frame);
    berth.sent_to = !node.wants_frame();  // it may look at no more in this millisecond
}

void NodeTurns::receive(Berth& berth, const wire::Frame& frame) {
    uint32_t number = 0;
    if (numbers_) {
        number = numbers_->find({frame, bus_number_of(berth)}, berth.last_frame);
        if (number != 0) berth.last_frame = number;
    }
    machine(berth).receive(frame, number);
}

FrameNumbers& NodeTurns::number_frames() {
    if (!numbers_) numbers_ = std::make_unique<FrameNumbers>();
    return *numbers_;
}

void NodeTurns::watch(Witness* witness) {
    witness_ = witness;
    for (const Berth& berth : berths_) {
        machine(berth).watch(witness,
                             {static_cast<uint32_t>(berth.robot + 1), machine(berth).id()});
    }
}

void NodeTurns::collect(size_t index, Time now, Crossing crossing) {
    const Berth& berth = berths_[index];
    Machine& node = machine(berth);
    hub::Hub* const own_bus = private_buses_[berth.robot].get();
    for (size_t i = 0; i < node.sent().size(); ++i) {
        const wire::Frame& frame = node.sent()[i];
        if (numbers_) {
            const uint32_t number =
                numbers_->sent({frame, bus_number_of(berth)}, node.origins()[i]);
            if (witness_ != nullptr) {
                witness_->sent({static_cast<uint32_t>(berth.robot + 1), node.id()}, number);
            }
        }
        if (chaos_ != nullptr && crossing == Crossing::Timed && chaos_->suffers(index)) {
            chaos_->from(index).put(frame, now);
        } else {
            send_on(index, frame, now, crossing);
        }
        if (own_bus != nullptr) own_bus->receive(berth.private_link, frame);
        heard_(berth.robot, frame);
    }
    node.forget_sent();
    if (chaos_ == nullptr || crossing != Crossing::Timed) return;
    wire::Frame late;
    while (chaos_->from(index).take(late, now)) send_on(index, late, now, crossing);
}

void NodeTurns::send_on(size_t index, const wire::Frame& frame, Time now, Crossing crossing) {
    Bus& bus = buses_[berths_[index].bus];
    if (!bus.node_bus)
        bus.hub->receive(berths_[index].link, frame);
    else if (crossing == Crossing::Timed)
        bus.node_bus->send(index - bus.first, frame, now);
    else
        bus.node_bus->send_at_once(index - bus.first, frame);
}

void NodeTurns::send_to(size_t robot, hub::LinkId host, const wire::Frame& frame) {
    Bus& bus = buses_[bus_index_of(robot)];
    for (size_t i = bus.first; i < bus.end; ++i) {
        if (berths_[i].robot != robot) berths_[i].for_others.add(frame);
    }
    bus.hub->receive(host, frame);
}

std::optional<BusLoad> NodeTurns::load(const Bus& bus) {
    if (!bus.node_bus) return std::nullopt;
    return bus.node_bus->load();
}

void NodeTurns::host_left(size_t index) {
    for (Machine* const machine : robot(index).machines()) machine->host_left();
}

std::span<const int16_t> NodeTurns::variables_of(uint16_t node, Time now) {
    const auto end = berths_.begin() + static_cast<ptrdiff_t>(buses_.front().end);
    const auto found = std::lower_bound(
        berths_.begin(), end, node,
        [this](const Berth& berth, uint16_t id) { return machine(berth).id() < id; });
    if (found == end || machine(*found).id() != node) return {};
    return variables_of(found->robot, node, now);
}

std::span<const int16_t> NodeTurns::variables_of(size_t index, uint16_t node, Time now) {
    const Machine* const machine = machine_of(index, node, now);
    return machine != nullptr ? std::span<const int16_t>(machine->variables())
                              : std::span<const int16_t>();
}

const Machine* NodeTurns::machine_of(size_t index, uint16_t node, Time now) {
    for (const Machine* const machine : robot(index).machines()) {
        if (machine->id() != node) continue;
        robot(index).catch_up(now);
        return machine;
    }
    return nullptr;
}

}  // namespace vagus::sim
