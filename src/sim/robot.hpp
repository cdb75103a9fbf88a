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
    bool clock_stops_with_nodes = false;  // World::stops_with_nodes()
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
    // After sense() and the run of its machines at `now`: the next instant at which it has to be
    // called again, if nobody sends it anything nor touches it until then.
    virtual Time next_due(Time now) { return now + kNodeStep; }
    // Brings to its variables what sense() was not called for, up to `now`: called before anybody
    // reads or writes them.
    virtual void catch_up(Time now) { (void)now; }
    // Before each step of the arena, at `now`: variables to wheels. False if it would only say the
    // same again in the next steps, as long as its machines do not run.
    virtual bool drive(Arena& arena, Time now) = 0;
    // A knock, or the first touch of another body.
    virtual void knock() {}
    // One of buttons_of() its type.
    virtual void set_button(std::string_view button, bool pressed) {
        (void)button;
        (void)pressed;
    }
    virtual std::vector<Lamp> lamps() const = 0;
    // Its distance sensors as they are.
    virtual std::vector<Beam> beams(const Arena& arena) const = 0;
    // From now on its noise and its slip are drawn from that seed; how its wheels are made stays.
    virtual void reseed(uint64_t seed) = 0;
    // The colour that cameras see.
    virtual Colour colour() const = 0;
    // Where its camera is, in its frame; it looks ahead. Nothing: it has none.
    virtual std::optional<Point> camera() const { return std::nullopt; }
};

// How many instants there are by `now` of something that happens `rate` times a second: the n-th is
// the first millisecond at or after n / rate.
inline int64_t times_due(Time now, int64_t rate) {
    return now / std::chrono::milliseconds(1) * rate / 1000;
}

// The first of them after `now`.
inline Time next_time(Time now, int64_t rate) {
    const int64_t n = times_due(now, rate) + 1;
    return std::chrono::milliseconds((n * 1000 + rate - 1) / rate);
}

// True at these instants.
inline bool is_due(Time now, int64_t rate) {
    return times_due(now, rate) > times_due(now - std::chrono::milliseconds(1), rate);
}

}  // namespace vagus::sim
