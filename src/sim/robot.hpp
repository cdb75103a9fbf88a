// What the world asks of a robot, whatever its type. A robot is a body in the arena and the
// machines of its nodes, one or several; its own folder (thymio2, epuck, carbot) knows what the
// variables mean.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/arena.hpp"
#include "sim/drawing.hpp"
#include "sim/ground.hpp"
#include "sim/machine.hpp"

namespace vagus::sim {

// What robots look at. Borrowed for the call.
struct Surroundings {
    const Arena& arena;
    const Ground& ground;
    std::span<const Colour> colours;  // of bodies by index
    std::span<const Point> beacons;   // infrared ones that are on
    Time now;
};

// The energy that the e-pucks of a world share (docs/spec, section 4.7).
struct EnergyPool {
    uint16_t amount = 10;
};

class Robot {
public:
    virtual ~Robot() = default;

    // Its nodes by ascending id: nodes_of() its type, the same ones for life.
    virtual std::span<Machine* const> machines() = 0;
    virtual BodyId body() const = 0;
    virtual std::span<const Point> outline() const = 0;
    // What is due at this millisecond, of all nodes: sensors to variables, local events raised.
    virtual void sense(const Surroundings& around) = 0;
    // Before each step of the arena: variables to wheels.
    virtual void drive(Arena& arena) = 0;
    // A knock, or the first touch of another body.
    virtual void knock() {}
    // One of buttons_of() its type.
    virtual void set_button(std::string_view button, bool pressed) {
        (void)button;
        (void)pressed;
    }
    virtual std::vector<Lamp> lamps() const = 0;
    // Its distance sensors as they stand.
    virtual std::vector<Beam> beams(const Arena& arena) const = 0;
    // The colour that cameras see.
    virtual Colour colour() const = 0;
    // Where its camera is, in its frame; it looks ahead. Nothing: it has none.
    virtual std::optional<Point> camera() const { return std::nullopt; }
};

// True at the instants at which something that happens `rate` times a second is due: the n-th time
// at the first millisecond at or after n / rate.
inline bool is_due(Time now, int64_t rate) {
    const int64_t ms = now / std::chrono::milliseconds(1);
    return ms * rate / 1000 > (ms - 1) * rate / 1000;
}

}  // namespace vagus::sim
