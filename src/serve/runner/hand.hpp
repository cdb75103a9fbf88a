// The hand from above: what a person moves, puts, takes and presses in a world that is there.
#pragma once

#include "base/result.hpp"
#include "serve/talk/orders.hpp"

namespace vagus::sim {
class World;
}

namespace vagus::serve {

// The Error says what is not there, or why it cannot be.
Status hand(sim::World& world, const talk::MoveRobot& order);
Status hand(sim::World& world, const talk::MoveObject& order);
Status hand(sim::World& world, const talk::TakeObject& order);
Status hand(sim::World& world, const talk::SwitchLight& order);
Status hand(sim::World& world, const talk::PressButton& order);
Status hand(sim::World& world, const talk::TapRobot& order);
// Gives the number of what was put.
Result<uint32_t> hand(sim::World& world, const talk::PutObject& order);

}  // namespace vagus::serve
