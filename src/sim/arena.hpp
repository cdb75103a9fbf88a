// The bodies of a world and what can be seen of them: physics by Box2D, sight by exact geometry. It
// knows shapes, speeds and distances, and nothing of robots' types, nodes or files.
//
//     Arena arena({.width = 2, .height = 1});
//     const BodyId robot = arena.add_robot(kOutline, {{0.5, 0.5}, 0}, {.mass = 0.27});
//     arena.drive(robot, {.forward = 0.1, .turn = 0});   // until told otherwise
//     arena.step();                                      // kArenaStep of it
//     arena.look(robot, kRays, 0.02, distances);         // from 2 cm above; after prepare_looks()
//
// Lengths are metres here; inside, Box2D counts in decimetres (decision 0070).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/crew.hpp"
#include "sim/definitions.hpp"

namespace vagus::sim {

constexpr double kArenaStep = 0.01;    // seconds
constexpr size_t kOutlineMax = 8;      // corners of a body
constexpr size_t kRaysMax = 24;        // of one look()
constexpr double kBorderHeight = 0.3;  // m: what a camera sees of the walls around

struct BodyId {
    uint32_t index = UINT32_MAX;
    auto operator<=>(const BodyId&) const = default;
};
constexpr BodyId kBorder = {UINT32_MAX - 1};  // the walls around, as a partner of a touch

struct ArenaSize {
    double width = 1;
    double height = 1;
    bool open = false;  // no walls around
};

// A convex polygon, counter-clockwise, or a disc.
struct Outline {
    std::span<const Point> corners;  // 3 to kOutlineMax; empty: a disc
    double radius = 0;
};

struct RobotBody {
    double mass = 0.3;      // kg
    double inertia = 5e-4;  // kg m^2, about the point between the wheels
    double grip = 0.05;     // half the distance of the wheels, m
    double height = 0.05;   // m: what looks over it does not see it
};

// What the wheels would do on free ground.
struct Drive {
    double forward = 0;   // m/s
    double turn = 0;      // rad/s
    double sideways = 0;  // m/s to the left; only wheels that are steered do that
};

// One look of a sensor, in the frame of its robot; the direction has length 1.
struct Ray {
    Point from;
    Point direction;
    double range = 0;
};

// The rays of all sensors of a robot, arranged for looking: make it once.
class RayFan {
public:
    // At most kRaysMax.
    explicit RayFan(std::span<const Ray> rays);

    size_t size() const { return size_; }
    // Coordinate by coordinate, so that the compiler can take several rays at once. Rays beyond
    // size() are zero.
    std::array<double, kRaysMax> x{}, y{}, dx{}, dy{}, range{};
    double reach = 0;  // from the middle of the robot to the farthest end

private:
    size_t size_;
};

// Two bodies have begun to touch; `a` is the older one.
struct Touch {
    BodyId a;
    BodyId b;
};

// Where something lies against a body now, in the frame of the body: along an edge from one point
// to another, or at one point (both the same).
struct TouchedPart {
    Point from;
    Point to;
};

// What is seen by a wide-angle look: the nearest body in each column.
struct Column {
    double distance = 0;
    BodyId body;  // kBorder for the walls around; no body: nothing there
};

// A body in one column of a camera: where the line of sight enters it, and where it leaves it.
// Depths are measured along the axis of the camera.
struct Slice {
    uint32_t column = 0;
    BodyId body;  // kBorder for the walls around
    double enter = 0;
    double leave = 0;
    double height = 0;
    Point normal;   // of the face that it enters, in the world, length 1
    Point on_body;  // where it enters, in the frame of the body
};

class Arena {
public:
    explicit Arena(const ArenaSize& size);
    Arena(Arena&&) noexcept;
    Arena& operator=(Arena&&) noexcept;
    ~Arena();

    // The body of a robot is at rest on its wheels: it drives, and is pushed, with the grip of its
    // tyres. The corners are copied.
    BodyId add_robot(const Outline& outline, const Pose& pose, const RobotBody& body);
    // A wall, box or cylinder. With a mass it slides on the ground when pushed.
    BodyId add_object(const ObjectDefinition& object);
    void remove(BodyId body);
    // Puts a body somewhere else, standing still.
    void place(BodyId body, const Pose& pose);

    void drive(BodyId robot, const Drive& drive);
    void step();
    // The same, to the last bit, with the help of others.
    void step(Crew& crew);
    Pose pose(BodyId body) const;
    // Those begun in the last step, in the order of the contacts of the solver.
    std::span<const Touch> touches() const;
    // Appends all parts of a body that are touched, in the order of the contacts of the solver.
    void touched_parts(BodyId body, std::vector<TouchedPart>& parts) const;

    // Call once after bodies have moved, before look(); it sorts them by place.
    void prepare_looks();
    // How far each ray of a robot gets, at most its range. What is lower than `eye` (m) is not
    // seen. May be called for several robots at once from several threads.
    void look(BodyId robot, const RayFan& rays, double eye, std::span<double> distances) const;
    // The nearest body in each of the directions `tangents` (sideways per ahead, ascending from
    // right to left), from a point ahead of the middle of the robot.
    void look_wide(BodyId robot, double ahead, std::span<const double> tangents,
                   std::span<Column> columns) const;
    // All bodies but `self` in each of the directions `tangents` (as above) from a place: by
    // column, in each by ascending depth.
    void slice(BodyId self, const Pose& eye, std::span<const double> tangents,
               std::vector<Slice>& slices) const;

private:
    struct Insides;
    std::unique_ptr<Insides> insides_;
};

}  // namespace vagus::sim
