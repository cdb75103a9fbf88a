// What faults do to the nodes of a world and to their links; the world tells it the time.
//
//     auto made = NodeChaos::make(of, seed, nodes, {});     // the nodes with their names
//     NodeChaos& chaos = made.value();
//     while (const auto edge = chaos.next(now)) turns.take_edge(*edge, now);
//     if (chaos.suffers(berth)) chaos.to(berth).put(frame, now);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "sim/chaos.hpp"
#include "sim/chaos_clock.hpp"
#include "sim/chaos_line.hpp"
#include "sim/machine.hpp"
#include "sim/sensor_chaos.hpp"

namespace vagus::sim {

// One node of the world, by its place among all of them.
struct ChaosNode {
    std::string robot;
    std::string node;
    const Machine* machine = nullptr;  // as it was switched on; for its names
};

// The names of the nodes as faults have them, and their sensors.
std::vector<ChaosTarget> targets_of(const std::vector<ChaosNode>& nodes);

class NodeChaos {
public:
    // The Error names the place in the file of the fault whose node or sensor is not there. `buses`
    // are names of robots with a bus of their own.
    static Result<NodeChaos> make(Chaos chaos, uint64_t seed, const std::vector<ChaosNode>& nodes,
                                  const std::vector<std::string>& buses);
    NodeChaos(NodeChaos&&) noexcept = default;

    // As at the time 0 of a run.
    void restart();
    // As World::reseed(), of what is random in faults; which faults there are stays.
    void reseed(uint64_t seed);
    const std::vector<ChaosFault>& faults() const { return faults_; }
    std::optional<ChaosEdge> next(Time now) { return clock_.next(now); }
    // The node that the fault is done to; nothing: the main computer.
    std::optional<size_t> node_of(const ChaosFault& fault) const;

    // ---- of one node ----
    void begin(const ChaosFault& fault);
    // `machine` gets back what its sensors sense.
    void end(const ChaosFault& fault, Machine& machine);
    // Something acts on it, or waits in its lines: it has its turn each millisecond.
    bool suffers(size_t node) const;
    bool hangs(size_t node) const { return states_[node].hangs > 0; }
    ChaosLine& to(size_t node) { return states_[node].to; }
    ChaosLine& from(size_t node) { return states_[node].from; }
    // Around the sensing of its robot.
    void give_back(size_t node, Machine& machine) const;
    void spoil(size_t node, Machine& machine, Time now);
    const std::vector<int16_t>& switched_on(size_t node) const { return switched_on_[node]; }

private:
    struct State {
        ChaosLine to, from;
        std::vector<SensorChaos> sensors;
        int hangs = 0;
        int acting = 0;
    };
    struct Variable {
        uint16_t address = 0;
        uint16_t words = 0;
    };

    NodeChaos(std::vector<ChaosFault> faults, uint64_t seed)
        : faults_(std::move(faults)), seed_(seed), first_seed_(seed), clock_(faults_) {}
    Status bind(const Chaos& chaos, const std::vector<ChaosNode>& nodes,
                const std::vector<std::string>& buses);
    size_t index_of(const ChaosFault& fault) const {
        return static_cast<size_t>(&fault - faults_.data());
    }

    std::vector<ChaosFault> faults_;  // stay where they are
    uint64_t seed_;
    uint64_t first_seed_;  // before any reseed()
    ChaosClock clock_;
    std::vector<std::optional<size_t>> nodes_;  // of each fault
    std::vector<Variable> variables_;           // of each fault of a sensor
    std::vector<State> states_;                 // of each node
    std::vector<std::vector<int16_t>> switched_on_;
};

}  // namespace vagus::sim
