#include "sim/node_chaos.hpp"

#include <algorithm>
#include <map>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "node/description.hpp"

namespace vagus::sim {

namespace {

// Several robots have nodes of the same names: then those of their robots are before them.
std::vector<std::string> names_of(const std::vector<ChaosNode>& nodes) {
    const bool one_robot = std::ranges::all_of(
        nodes, [&nodes](const ChaosNode& node) { return node.robot == nodes.front().robot; });
    std::vector<std::string> names;
    for (const ChaosNode& node : nodes) {
        names.push_back(one_robot ? node.node : node.robot + "/" + node.node);
    }
    return names;
}

std::vector<std::string> sensors_of(const Machine& machine) {
    const node::Description& description = machine.description();
    std::vector<std::string> sensors;
    for (uint16_t i = 0; i < description.variable_count; ++i) {
        const std::string_view name = description.variables[i].name;
        if (is_sensor(name)) sensors.emplace_back(name);
    }
    return sensors;
}

Error at_fault(const Chaos& chaos, const ChaosFault& fault, const std::string& what) {
    return {Code::NotFound, at_place(chaos.file, fault.place, what)};
}

// The node of that name: also "ROBOT/NODE" in a world with one robot.
std::optional<size_t> find_node(const std::vector<ChaosNode>& nodes,
                                const std::vector<std::string>& names, const std::string& where) {
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (names[i] == where || nodes[i].robot + "/" + nodes[i].node == where) return i;
    }
    return std::nullopt;
}

}  // namespace

std::vector<ChaosTarget> targets_of(const std::vector<ChaosNode>& nodes) {
    const std::vector<std::string> names = names_of(nodes);
    std::vector<ChaosTarget> targets;
    for (size_t i = 0; i < nodes.size(); ++i) {
        targets.push_back({names[i], sensors_of(*nodes[i].machine)});
    }
    return targets;
}

Result<NodeChaos> NodeChaos::make(Chaos chaos, uint64_t seed, const std::vector<ChaosNode>& nodes,
                                  const std::vector<std::string>& buses) {
    std::vector<ChaosFault> faults = chaos.faults;
    if (chaos.draw) {
        const auto drawn = draw_chaos(targets_of(nodes), *chaos.draw, seed);
        faults.insert(faults.end(), drawn.begin(), drawn.end());
    }
    NodeChaos made(std::move(faults), seed);
    TRY(made.bind(chaos, nodes, buses));
    made.states_.resize(nodes.size());
    for (const ChaosNode& node : nodes) made.switched_on_.push_back(node.machine->variables());
    return made;
}

Status NodeChaos::bind(const Chaos& chaos, const std::vector<ChaosNode>& nodes,
                       const std::vector<std::string>& buses) {
    const std::vector<std::string> names = names_of(nodes);
    for (const ChaosFault& fault : faults_) {
        nodes_.push_back(find_node(nodes, names, fault.where));
        variables_.emplace_back();
        const bool may_be_main = is_of_link(fault.kind) || fault.kind == ChaosKind::Slow;
        const bool main = fault.where.empty() || fault.where == kMainComputer ||
                          std::ranges::any_of(buses, [&fault](const std::string& robot) {
                              return fault.where == robot + "/main";
                          });
        if (may_be_main && main) continue;
        if (!nodes_.back()) {
            std::vector<std::string> known = names;
            if (may_be_main) known.emplace_back(kMainComputer);
            return at_fault(chaos, fault,
                            "the world has no node \"" + fault.where + "\"; " +
                                known_instead(fault.where, known));
        }
        if (!is_of_sensor(fault.kind)) continue;
        const Machine& machine = *nodes[*nodes_.back()].machine;
        uint16_t address = 0;
        for (uint16_t i = 0; i < machine.description().variable_count; ++i) {
            const node::Variable& one = machine.description().variables[i];
            if (one.name == fault.sensor && is_sensor(one.name)) {
                variables_.back() = {address, one.size};
            }
            address = static_cast<uint16_t>(address + one.size);
        }
        if (variables_.back().words != 0) continue;
        return at_fault(chaos, fault,
                        "the node \"" + fault.where + "\" has no sensor \"" + fault.sensor +
                            "\"; " + known_instead(fault.sensor, sensors_of(machine)));
    }
    return Status::done();
}

void NodeChaos::restart() {
    seed_ = first_seed_;
    clock_.restart();
    for (State& state : states_) {
        state.to.reset();
        state.from.reset();
        state.sensors.clear();
        state.hangs = state.acting = 0;
    }
}

void NodeChaos::reseed(uint64_t seed) {
    seed_ = seed;
    for (State& state : states_) {
        state.to.reseed(seed, 1);
        state.from.reseed(seed, 2);
        for (SensorChaos& sensor : state.sensors) {
            sensor.reseed(chaos_seed(sensor.fault(), seed, 0));
        }
    }
}

std::optional<size_t> NodeChaos::node_of(const ChaosFault& fault) const {
    return nodes_[index_of(fault)];
}

// ---- one node ----

void NodeChaos::begin(const ChaosFault& fault) {
    const std::optional<size_t> node = node_of(fault);
    if (!node || fault.kind == ChaosKind::Reset) return;
    State& state = states_[*node];
    ++state.acting;
    if (is_of_sensor(fault.kind)) {
        const Variable& variable = variables_[index_of(fault)];
        state.sensors.emplace_back(fault, variable.address, variable.words,
                                   chaos_seed(fault, seed_, 0));
        return;
    }
    if (fault.kind == ChaosKind::Hung) ++state.hangs;
    state.to.begin(fault, chaos_seed(fault, seed_, 1));
    state.from.begin(fault, chaos_seed(fault, seed_, 2));
}

void NodeChaos::end(const ChaosFault& fault, Machine& machine) {
    const std::optional<size_t> node = node_of(fault);
    if (!node) return;
    State& state = states_[*node];
    --state.acting;
    if (is_of_sensor(fault.kind)) {
        give_back(*node, machine);
        std::erase_if(state.sensors,
                      [&fault](const SensorChaos& one) { return &one.fault() == &fault; });
        return;
    }
    if (fault.kind == ChaosKind::Hung) --state.hangs;
    state.to.end(fault);
    state.from.end(fault);
}

bool NodeChaos::suffers(size_t node) const {
    const State& state = states_[node];
    return state.acting > 0 || !state.to.is_plain() || !state.from.is_plain();
}

// In the opposite order of spoil(): what one has spoilt the next one has sensed.
void NodeChaos::give_back(size_t node, Machine& machine) const {
    const std::vector<SensorChaos>& sensors = states_[node].sensors;
    for (size_t i = sensors.size(); i-- > 0;) sensors[i].give_back(machine);
}

void NodeChaos::spoil(size_t node, Machine& machine, Time now) {
    for (SensorChaos& sensor : states_[node].sensors) sensor.spoil(machine, now);
}

}  // namespace vagus::sim
