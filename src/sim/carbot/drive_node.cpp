#include "sim/carbot/drive_node.hpp"

#include <algorithm>
#include <cmath>

#include "base/trig.hpp"
#include "sim/carbot/node_parts.hpp"

namespace vagus::sim::carbot {
namespace {

constexpr double kMetre = 1000;               // mm
constexpr double kTenths = 1800 / trig::kPi;  // tenths of a degree in a radian
constexpr double kDegrees = 180 / trig::kPi;  // degrees in a radian
constexpr int kDistanceMax = 10'000'000;      // mm, either sign
constexpr int kSpeedLimit = 310;              // mm/s
constexpr int kTurnLimit = 136;               // deg/s in place
constexpr int kRateLimit = 1360;              // 0.1 deg/s

#define VAGUS_VARIABLES "sim/carbot/drive_variables.def"
#include "sim/node_variables.inl"
static_assert(sizeof(Layout) == 49 * kWord, "docs/carbot.md: 49 words are described");

enum Event : uint8_t { kArrived, kTurned, kHalted, kTickEvent };
constexpr node::LocalEvent kEvents[] = {
    {"arrived", "A move or a curve is done, the wheels are at rest"},
    {"turned", "A turn is done, the wheels are at rest"},
    {"halted", "The wheels are at rest after a brake or a pause"},
    {"tick", "Every 20 ms"}};

Driver& driver_of(node::Node& node) {
    return *static_cast<Driver*>(Machine::robot_of(node));
}

int joined(int16_t low, int16_t high) {
    return high * 65536 + static_cast<uint16_t>(low);
}

double metres(int16_t low, int16_t high) {
    return std::clamp(joined(low, high), -kDistanceMax, kDistanceMax) / kMetre;
}

// A speed that drives: its sign stays, 0 becomes the slowest.
double speed_of(int16_t value, int most) {
    const int size = std::clamp(value < 0 ? -int{value} : int{value}, 1, most);
    return value < 0 ? -size : size;
}

void move(node::Node& node) {
    const int16_t low = pop_word(node);
    const int16_t high = pop_word(node);
    const int16_t speed = pop_word(node);
    driver_of(node).motion.move(metres(low, high),
                                std::max(speed_of(speed, kSpeedLimit), 1.0) / kMetre);
    driver_of(node).tell_command();
}

void turn(node::Node& node) {
    const int16_t angle = pop_word(node);
    const int16_t speed = pop_word(node);
    driver_of(node).motion.turn(angle / kTenths,
                                std::max(speed_of(speed, kTurnLimit), 1.0) / kDegrees);
    driver_of(node).tell_command();
}

void curve(node::Node& node) {
    const int16_t radius = pop_word(node);
    const int16_t angle = pop_word(node);
    const int16_t speed = pop_word(node);
    driver_of(node).motion.curve(std::max<int>(radius, 1) / kMetre, angle / kTenths,
                                 speed_of(speed, kSpeedLimit) / kMetre);
    driver_of(node).tell_command();
}

void steer(node::Node& node) {
    const int speed = std::clamp<int>(pop_word(node), -kSpeedLimit, kSpeedLimit);
    const int rate = std::clamp<int>(pop_word(node), -kRateLimit, kRateLimit);
    driver_of(node).motion.steer(speed / kMetre, rate / kTenths);
    driver_of(node).tell_command();
}

void brake(node::Node& node) {
    driver_of(node).motion.brake();
    driver_of(node).tell_command();
}

void pause(node::Node& node) {
    driver_of(node).motion.pause();
}

void resume(node::Node& node) {
    driver_of(node).motion.resume();
}

// From -pi, excluded, to pi.
double wrapped(double angle) {
    while (angle > trig::kPi) angle -= 2 * trig::kPi;
    while (angle <= -trig::kPi) angle += 2 * trig::kPi;
    return angle;
}

void set_odometry(node::Node& node) {
    const int16_t x_low = pop_word(node);
    const int16_t x_high = pop_word(node);
    const int16_t y_low = pop_word(node);
    const int16_t y_high = pop_word(node);
    const int16_t heading = pop_word(node);
    driver_of(node).odometry.set(
        {{metres(x_low, x_high), metres(y_low, y_high)}, wrapped(heading / kTenths)});
}

constexpr node::Parameter kMoveParameters[] = {{1, "lo"}, {1, "hi"}, {1, "speed"}};
constexpr node::Parameter kTurnParameters[] = {{1, "angle"}, {1, "speed"}};
constexpr node::Parameter kCurveParameters[] = {{1, "radius"}, {1, "angle"}, {1, "speed"}};
constexpr node::Parameter kSteerParameters[] = {{1, "speed"}, {1, "rate"}};
constexpr node::Parameter kPlaceParameters[] = {
    {1, "x lo"}, {1, "x hi"}, {1, "y lo"}, {1, "y hi"}, {1, "heading"}};
constexpr node::Native kNatives[] = {
    {"drive.move", "Drives straight on: mm in two words, mm/s", kMoveParameters, 3, move},
    {"drive.turn", "Turns in place: 0.1 deg, deg/s", kTurnParameters, 2, turn},
    {"drive.curve", "Drives an arc: mm, 0.1 deg, mm/s (negative: backwards)", kCurveParameters, 3,
     curve},
    {"drive.steer", "Drives until another command: mm/s, 0.1 deg/s", kSteerParameters, 2, steer},
    {"drive.brake", "Forgets the command and stops", nullptr, 0, brake},
    {"drive.pause", "Stops and keeps the command", nullptr, 0, pause},
    {"drive.resume", "Goes on with a paused command", nullptr, 0, resume},
    {"odometry.set", "Says where the robot is: mm in two words each, 0.1 deg", kPlaceParameters, 5,
     set_odometry}};

constexpr node::Description kDescription = describe({"drive", kVariables, kEvents, kNatives});

int rounded(double value) {
    return static_cast<int>(std::floor(value + 0.5));
}

int16_t word(double value) {
    return static_cast<int16_t>(std::clamp(rounded(value), -32768, 32767));
}

}  // namespace

DriveNode::DriveNode(uint16_t id, uint64_t seed)
    : machine_(machine_of(kDescription, id, &driver_,
                          [](void* driver) { static_cast<Driver*>(driver)->cut(); })),
      chassis_(seed) {
    machine_.variable(ADDRESS(id)) = static_cast<int16_t>(id);
    driver_.command = &machine_.variable(ADDRESS(motion_kind));
}

void Driver::tell_command() const {
    *command = static_cast<int16_t>(motion.kind());
}

void Driver::cut() {
    if (!motion.cut()) return;
    owes_halted = true;
    tell_command();
}

Drive DriveNode::drive() {
    const Twist twist = chassis_.step(driver_.motion.step(chassis_.counted()));
    driver_.odometry.add(twist_of(chassis_.counted()), kArenaStep);
    return {.forward = twist.ahead, .turn = twist.turn, .sideways = twist.sideways};
}

void DriveNode::sense(const Surroundings& around) {
    if (gate_.shuts(machine_, around)) driver_.cut();
    write_variables();
    if (machine_.runs()) raise_endings();
    if (around.now % kTick == Duration::zero()) machine_.raise(kTickEvent);
}

// A program that does not run would miss them: they wait until it does. That the node has ended a
// command is told when the wheels rest, or when they have another command before that; to the next
// program if this one would not hear it, for it may be an empty one.
void DriveNode::raise_endings() {
    Motion& motion = driver_.motion;
    if (motion.take(Ending::Arrived)) machine_.raise(kArrived);
    if (motion.take(Ending::Turned)) machine_.raise(kTurned);
    const bool rests = motion.take(Ending::Halted);
    if (rests && !driver_.owes_halted) machine_.raise(kHalted);
    if (!driver_.owes_halted || motion.state() == MotionState::Brakes) return;
    if (!machine_.hears(kHalted)) return;
    machine_.raise(kHalted);
    driver_.owes_halted = false;
}

void DriveNode::write_variables() {
    const auto put = [this](uint16_t address, int16_t value) {
        machine_.variable(address) = value;
    };
    const auto put_two = [&put](uint16_t address, double value) {
        const int whole = std::clamp(rounded(value), -kDistanceMax, kDistanceMax);
        put(address, static_cast<int16_t>(whole & 0xffff));
        put(static_cast<uint16_t>(address + 1), static_cast<int16_t>(whole >> 16));
    };
    const auto& [front, rear] = chassis_.counted();
    put(ADDRESS(front_angle), word(front.angle * kTenths));
    put(ADDRESS(front_speed), word(front.speed * kMetre));
    put(ADDRESS(rear_angle), word(rear.angle * kTenths));
    put(ADDRESS(rear_speed), word(rear.speed * kMetre));
    const Pose& pose = driver_.odometry.pose();
    put_two(ADDRESS(odometry_x), pose.at.x * kMetre);
    put_two(ADDRESS(odometry_y), pose.at.y * kMetre);
    const int16_t heading = word(pose.angle * kTenths);
    put(ADDRESS(odometry_heading), heading == -1800 ? int16_t{1800} : heading);
    const Motion& motion = driver_.motion;
    put(ADDRESS(motion_kind), static_cast<int16_t>(motion.kind()));
    put(ADDRESS(motion_state), static_cast<int16_t>(motion.state()));
    const double unit = motion.kind() == MotionKind::Turn ? kTenths : kMetre;
    put_two(ADDRESS(motion_left), motion.left() * unit);
}

}  // namespace vagus::sim::carbot
