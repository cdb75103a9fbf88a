// What a world is made of, as plain values with defaults: the content of a `NAME.world.json`
// (docs/formats.md). Lengths are metres, angles radians counter-clockwise, masses kilograms; the
// origin is the lower left corner.
//
//     WorldDefinition world;
//     world.width = 2;
//     world.objects.push_back(
//         {.id = "post", .kind = ObjectKind::Cylinder, .at = {1, 1}, .radius = 0.05});
//     world.robots.push_back({.name = "thymio", .at = {0.5, 0.5}});
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/time.hpp"

namespace vagus::sim {

constexpr Duration kNodeStep = std::chrono::milliseconds(1);
constexpr Duration kPhysicsStep = std::chrono::milliseconds(10);

constexpr size_t kRobotsMax = 10000;
constexpr size_t kObjectsMax = 10000;
constexpr size_t kNodeLast = 65534;  // 65535 is nobody
constexpr size_t kTimelineMax = 10000;
constexpr double kWorldSizeMax = 100;  // metres, each side
constexpr double kWorldSizeMin = 0.2;
constexpr double kObjectSizeMin = 0.001;  // metres: a side, a radius
constexpr double kMassMax = 1000;         // kilograms
constexpr double kAngleMax = 1000;        // radians, either sign
constexpr double kTimelineEndMax = 1e6;   // seconds
constexpr size_t kImageSideMax = 8192;    // pixels of a ground image
constexpr double kFleetDelayMax = 60;     // seconds: latency and jitter of a fleet
constexpr double kFleetChanceMax = 0.9;   // of a message to be lost, or to arrive twice

struct Point {
    double x = 0;
    double y = 0;
    bool operator==(const Point&) const = default;
};

struct Pose {
    Point at;
    double angle = 0;
    bool operator==(const Pose&) const = default;
};

// Red, green, blue from 0 to 1.
struct Colour {
    double r = 0;
    double g = 0;
    double b = 0;
    bool operator==(const Colour&) const = default;
};

enum class ObjectKind {
    Wall,      // a rectangle that never moves
    Box,       // a rectangle; moves if it has a mass
    Cylinder,  // a disc; moves if it has a mass
    Patch,  // a colour on the ground, rectangle or disc: felt by ground sensors, never in the way
    Light,  // a lamp above the ground: felt as ambient light, never in the way
    Infrared,  // a beacon above the ground, never in the way
};

struct ObjectDefinition {
    std::string id = {};  // empty, or unlike that of any other object
    ObjectKind kind = ObjectKind::Wall;
    Point at = {};  // the middle
    double angle = 0;
    double width = 0;   // rectangles: along x before turning
    double length = 0;  // rectangles: along y before turning
    double radius = 0;  // discs: above 0 means a disc
    double height = 0.1;
    double mass = 0;  // 0: fixed
    Colour colour = {0.9, 0.9, 0.9};
    bool operator==(const ObjectDefinition&) const = default;
};

enum class RobotType { Thymio2, Epuck, Carbot };

struct RobotDefinition {
    std::string name = {};
    RobotType type = RobotType::Thymio2;
    Point at = {};
    double angle = 0;
    uint16_t node = 1;  // id of its first node on the bus; further ones follow
    std::optional<uint16_t> port =
        {};  // a TCP port of its own beside the common bus; 0: a free one
    std::string script =
        {};  // an .aesl that the opener of the world loads over the bus; empty: none
    // A folder with a vagus.json, or that file: the robot has a bus of its own, on which the opener
    // of the world runs that project. Empty: it is on the common bus.
    std::string project = {};
    Colour paint = {0.95, 0.95, 0.95};
    bool operator==(const RobotDefinition&) const = default;
};

// What the timeline does at an instant of the run.
struct AddObject {
    ObjectDefinition object;
    bool operator==(const AddObject&) const = default;
};
struct RemoveObject {
    std::string id;
    bool operator==(const RemoveObject&) const = default;
};
struct MoveObject {
    std::string id;  // of an object, or the name of a robot
    Point at;
    std::optional<double> angle;  // empty: as it is
    bool operator==(const MoveObject&) const = default;
};
struct PressButton {
    std::string robot;
    std::string button;
    bool pressed = true;
    bool operator==(const PressButton&) const = default;
};
struct SwitchLight {
    std::string id;
    bool on = true;
    bool operator==(const SwitchLight&) const = default;
};
// The way from a robot to its fleet is cut, or there again; the world's opener sees to it.
struct CutFleet {
    std::string robot;  // empty: of all of them, as if the broker were gone
    bool cut = true;
    bool operator==(const CutFleet&) const = default;
};
// The keepers of the fleets are killed, or others start; the world's opener sees to it.
struct RunKeeper {
    bool on = true;
    bool operator==(const RunKeeper&) const = default;
};
using Action = std::variant<AddObject, RemoveObject, MoveObject, PressButton, SwitchLight, CutFleet,
                            RunKeeper>;

struct TimelineEntry {
    Time at{};
    Action action;
    bool operator==(const TimelineEntry&) const = default;
};

// How messages between robots of a fleet travel, for the world's opener: the world itself knows no
// fleets.
struct FleetDefinition {
    Duration latency = std::chrono::milliseconds(5);  // of each way: to the broker, and from it
    Duration jitter{};                                // at most so much more, at random
    double loss = 0;                                  // how likely a message is lost on a way
    double twice = 0;                                 // how likely it arrives twice
    bool operator==(const FleetDefinition&) const = default;
};

struct WorldDefinition {
    std::string name;
    std::string help;
    uint64_t seed = 1;
    double width = 1;
    double height = 1;
    bool open = false;  // no walls around
    Colour ground = {1, 1, 1};
    // A PNG, path from the folder of the world file; empty: `ground` everywhere.
    std::string ground_image;
    std::vector<ObjectDefinition> objects;
    std::vector<RobotDefinition> robots;
    std::vector<TimelineEntry> timeline;  // by ascending time
    FleetDefinition fleet;
    bool operator==(const WorldDefinition&) const = default;
};

// The sentence for a name that no robot of the world has: "there is no robot "x" in this world; did
// you mean xy?". `where`: " in this world".
std::string no_robot(const WorldDefinition& world, const std::string& name, std::string_view where);

// "wall", "thymio2": as in the file.
std::string_view name_of(ObjectKind kind);
std::string_view name_of(RobotType type);
// How many nodes a robot is: they have neighbouring ids.
uint16_t nodes_of(RobotType type);
// The names of the buttons of a robot, in the order of its variables.
std::span<const std::string_view> buttons_of(RobotType type);
// Whether a knock on its body means something to it.
bool feels_knocks(RobotType type);
// Whether it has a sensor for the colours of bodies.
bool sees_colours(RobotType type);

}  // namespace vagus::sim
