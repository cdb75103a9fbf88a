// The hand from above: what a person moves, puts, takes and presses in a world that is there.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
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
Status hand(sim::World& world, const talk::TapRobot& order);
// Gives the number of what was put.
Result<uint32_t> hand(sim::World& world, const talk::PutObject& order);

// A Thymio looks at its buttons 20 times a second.
constexpr Duration kPressLasts = std::chrono::milliseconds(50);

// Buttons under a finger. A click may begin and end between two instants of the world: its node
// would see a button that is up. So each is down for kPressLasts of the world's time at least.
class Buttons {
public:
    // As hand() above; a button that has just been pressed is released later.
    Status press(sim::World& world, const talk::PressButton& order);
    // Releases the buttons that are due. Call it before each instant.
    void release_due(sim::World& world);
    // Of another world.
    void forget() { down_.clear(); }

private:
    struct Down {
        std::string robot, button;
        Time since;
        bool let_go = false;  // it only waits for its time
    };
    std::vector<Down> down_;
};

}  // namespace vagus::serve
