// Everything that the terminal view shows at one moment, as plain values. cli/sim fills it from a
// session; draw() (screen.hpp) turns it into cells. Nothing here knows a robot, a socket or a
// terminal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"

namespace vagus::cli {

struct Rgb {
    uint8_t r = 0;
    uint8_t g = 0;
    uint8_t b = 0;
    friend bool operator==(const Rgb&, const Rgb&) = default;
};

// Metres, origin lower left, y up, as in world files.
struct Point {
    double x = 0;
    double y = 0;
};

struct Outline {
    std::vector<Point> corners;  // of a convex polygon; empty: a circle
    Point centre;
    double radius = 0;  // of the circle
};

enum class ShapeKind { Patch, Solid, Light };

struct ShapeView {
    ShapeKind kind = ShapeKind::Solid;
    Outline outline;
    Rgb colour;
};

struct RayView {
    Point from;
    Point to;
    bool hit = false;  // it sees something
};

struct RobotPicture {
    std::string name;
    Point at;
    double angle = 0;  // radians, counter-clockwise, 0 along x
    Outline outline;
    Rgb paint;
    std::optional<Rgb> led;  // the light on its top, if it is on
    std::vector<RayView> rays;
    std::vector<Point> trail;  // where it was, oldest first
};

// The pixels of the floor, first row at the top. Empty: `ground` everywhere.
struct GroundImage {
    int columns = 0;
    int rows = 0;
    std::vector<Rgb> pixels;
};

// One line of sensors: "prox ▁▃▇▁▁ 0 1503 4210 0 0".
struct BarsView {
    std::string label;
    std::vector<int> values;
    int full = 1;  // the value of a full bar
};

// A wheel: what it was told and what it does, each with its word.
struct WheelView {
    std::string label;
    std::string target_word = "told";
    std::string speed_word = "does";
    int target = 0;
    int speed = 0;
};

struct VariableView {
    std::string name;
    std::vector<int16_t> values;
    bool fresh = false;  // changed a moment ago
};

struct EventView {
    std::string name;
    uint64_t count = 0;
    std::vector<int16_t> args;  // of the last one
    Time last{};
};

struct PanelView {
    std::string node_name;
    uint16_t node_id = 0;
    std::string state;   // "running", "paused", "no script" …
    bool wrong = false;  // the state is a fault
    std::vector<BarsView> bars;
    std::vector<WheelView> wheels;
    std::vector<VariableView> variables;
    std::vector<EventView> events;  // the latest first
};

// ---- a plan beside the world ----

// A line of the list of actors: those of the outermost plan, and under one whose sub-plan runs the
// actors that are active inside.
struct ActorView {
    std::string name;
    int depth = 0;
    bool active = false;
    Duration for_so_long{};  // active
};

struct WatchView {
    std::string name;
    std::string events;
    bool global = false;
};

struct PlanVariableView {
    std::string name;
    std::string value;
    std::string unit;
    bool fresh = false;  // changed a moment ago
};

struct HappeningView {
    Time at{};
    std::string text;
    bool fresh = false;
};

struct NodeLoadView {
    std::string name;
    double share = 0;  // of the bus in the last second, 0 to 1
};

struct PlanPanelView {
    std::string name;
    std::string state;  // "running", "OK" …
    bool wrong = false;
    bool over = false;  // nothing is left to do but to look
    std::vector<ActorView> actors;
    std::vector<WatchView> watching;
    std::vector<PlanVariableView> variables;
    std::vector<HappeningView> happenings;  // the latest first
    size_t forgotten = 0;                   // earlier ones that are not among them
    std::vector<NodeLoadView> loads;        // empty: the bus has no model
    double load = 0;                        // of all
};

// What is wrong: a sentence, and the line that it is about with the marks under it.
struct ProblemView {
    std::string sentence;
    std::vector<std::string> source;
};

// "space", "pause"
struct KeyHelp {
    std::string key;
    std::string does;
};

struct View {
    std::string title;
    double width = 1;
    double height = 1;
    Rgb ground{200, 200, 200};
    GroundImage image;
    std::vector<ShapeView> shapes;  // painted in this order, marks on the floor first
    std::optional<Rgb> border;      // the walls around, if there are some
    std::vector<RobotPicture> robots;
    size_t selected = 0;  // the robot that the panel is about
    PanelView panel;
    std::optional<PlanPanelView> plan;  // then it has the place of the panel
    Time now{};
    std::string speed;  // "x1", "x0.5", "max"
    bool paused = false;
    std::string listening;      // "tcp:127.0.0.1:33333", empty if nobody can connect
    std::string notice;         // one line: what was loaded last
    std::vector<KeyHelp> keys;  // those that do something, the needed ones first
    size_t scrolled = 0;        // lines of the list of events above the first that is shown
    // What is wrong with the scripts.
    std::string problems_title;
    std::vector<ProblemView> problems;
};

}  // namespace vagus::cli
