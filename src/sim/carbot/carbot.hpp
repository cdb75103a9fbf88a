// A simulated Carbot: a hull on two steered wheels with four nodes, each in a file of its own
// (drive_node, bumper_node, range_node, head_node). docs/carbot.md says what they offer.
#pragma once

#include <array>

#include "sim/carbot/bumper_node.hpp"
#include "sim/carbot/drive_node.hpp"
#include "sim/carbot/head_node.hpp"
#include "sim/carbot/node_parts.hpp"
#include "sim/carbot/range_node.hpp"
#include "sim/robot.hpp"

namespace vagus::sim::carbot {

std::span<const Point> outline();

class Carbot : public Robot {
public:
    // `seed` is that of its slip and its noise.
    Carbot(Arena& arena, const RobotDefinition& definition, uint64_t seed);

    std::span<Machine* const> machines() override { return machines_; }
    BodyId body() const override { return body_; }
    std::span<const Point> outline() const override { return carbot::outline(); }
    void sense(const Surroundings& around) override;
    bool drive(Arena& arena, Time now) override;
    void set_button(std::string_view button, bool pressed) override;
    std::vector<Lamp> lamps() const override;
    std::vector<Beam> beams(const Arena& arena) const override;
    void reseed(uint64_t seed) override;
    Colour colour() const override { return paint_; }
    std::optional<Point> camera() const override;

private:
    BodyId body_;
    DriveNode drive_;
    BumperNode bumper_;
    RangeNode range_;
    HeadNode head_;
    std::array<Machine*, kPlaces> machines_;
    Colour paint_;
};

}  // namespace vagus::sim::carbot
