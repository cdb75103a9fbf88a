// The node of a simulated e-puck as in the playground: its variables, local events and natives
// around an epuck::Body.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "sim/epuck/body.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::epuck {

#define VAGUS_VARIABLES "sim/epuck/variables.def"
#include "sim/node_variables.inl"

// The energy of one e-puck and of all of them together.
struct Energy {
    EnergyPool* pool;  // that of the world, which outlives its robots
    uint16_t own = 10;
};

class Epuck : public Robot {
public:
    // `seed` is that of its noise; `pool` must outlive it.
    Epuck(Arena& arena, const RobotDefinition& definition, EnergyPool& pool, uint64_t seed);

    std::span<Machine* const> machines() override { return machines_; }
    BodyId body() const override { return body_.id(); }
    std::span<const Point> outline() const override { return epuck::outline(); }
    void sense(const Surroundings& around) override;
    Time next_due(Time now) override;
    bool drive(Arena& arena, Time now) override;
    std::vector<Lamp> lamps() const override;
    std::vector<Beam> beams(const Arena& arena) const override;
    void reseed(uint64_t seed) override { noise_.reseed(seed); }
    Colour colour() const override;

private:
    void see(const Surroundings& around);

    Energy energy_;
    std::string name_;
    node::Description description_;  // differs from robot to robot by its name
    Machine machine_;
    std::array<Machine*, 1> machines_ = {&machine_};
    Body body_;
    Noise noise_;
    Colour paint_;
};

}  // namespace vagus::sim::epuck
