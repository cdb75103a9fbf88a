// What the server tells the process of a run: every order there is. How they travel: codec.hpp.
//
//     pipe.send(talk::encode(talk::SetPace{.paused = false, .speed = 2}));
//
// The first is Open; it can come again at any time, and ends what runs. Orders with a `request` are
// answered once each by an Answer with that number (news.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "plan/value.hpp"
#include "serve/talk/values.hpp"

namespace vagus::serve::talk {

// ---- a run begins ----

enum class BreakpointKind { Actor, State, Event, Condition };
template <>
struct Words<BreakpointKind> {
    static constexpr std::string_view kAll[] = {"actor", "state", "event", "condition"};
};

struct BreakpointOrder {
    uint64_t number = 0;    // as pages know it
    std::string plan = {};  // its file
    BreakpointKind kind = BreakpointKind::Actor;
    std::string element = {};
    std::string outcome = {};  // of a state or event; empty: any
    std::string condition = {};
    uint64_t stop_at = 1;  // at this hit and each after it
    bool enabled = true;
    static void layout(auto& each, auto& it) {
        each("number", it.number);
        each("plan", it.plan);
        each("kind", it.kind);
        each("element", it.element);
        each("outcome", it.outcome);
        each("condition", it.condition);
        each("stop_at", it.stop_at);
        each("enabled", it.enabled);
    }
    bool operator==(const BreakpointOrder&) const = default;
};

// A run that was recorded, up to an instant: what it was is known, unless the history lacks it.
struct PastOf {
    std::string recording = {};    // its file
    std::optional<double> t = {};  // seconds; none: to its end, and all of it is told
    static void layout(auto& each, auto& it) {
        each("recording", it.recording);
        each("t", it.t);
    }
    bool operator==(const PastOf&) const = default;
};

// The member of a fleet that the plan asks as.
struct MemberOf {
    std::string target = {};  // mqtts://HOST:PORT/FLEET
    std::string robot = {}, instance = {};
    std::string ca = {}, certificate = {}, key = {}, login = {};  // files
    static void layout(auto& each, auto& it) {
        each("target", it.target);
        each("robot", it.robot);
        each("instance", it.instance);
        each("ca", it.ca);
        each("certificate", it.certificate);
        each("key", it.key);
        each("login", it.login);
    }
    bool operator==(const MemberOf&) const = default;
};

struct Open {
    uint64_t order = 0;                          // counts up; what is told of it names it
    std::string world = {};                      // files of this computer
    std::optional<std::string> world_text = {};  // without: as the file is on the disk
    std::string plan = {};                       // empty: the world alone
    std::vector<std::string> toolboxes = {};
    std::map<std::string, std::string> set = {};  // variables of the plan, as texts
    std::vector<BreakpointOrder> breakpoints = {};
    std::string robot = {};  // that the plan drives; empty: the only one
    std::string from = {};   // the actor that it begins with; empty: its start
    std::string bus = {},
                project = {};      // the plan on a bus instead of in a world: target and .aesl
    std::string target = {};       // that bus, as a person names it
    std::vector<Pose> poses = {};  // of robots, in their order; none: where the file says
    std::string recording = {};    // file that the run is recorded in; empty: none
    // Of a run with a past, as `plan run` has them.
    std::string seed = {};
    std::vector<std::string> starts = {};   // "ROBOT=X,Y,DEGREES"
    std::string chaos = {};                 // faults, as JSON
    std::vector<std::string> scripts = {};  // loaded beside those of the world, before it begins
    std::optional<PastOf> past = {};        // it goes on from there: the rest is as it was then
    std::optional<MemberOf> member = {};    // none: it is in no fleet
    static constexpr std::string_view kName = "open";
    static void layout(auto& each, auto& it) {
        each("order", it.order);
        each("world", it.world);
        each("world_text", it.world_text);
        each("plan", it.plan);
        each("toolboxes", it.toolboxes);
        each("set", it.set);
        each("breakpoints", it.breakpoints);
        each("robot", it.robot);
        each("from", it.from);
        each("bus", it.bus);
        each("project", it.project);
        each("target", it.target);
        each("poses", it.poses);
        each("recording", it.recording);
        each("seed", it.seed);
        each("starts", it.starts);
        each("chaos", it.chaos);
        each("scripts", it.scripts);
        each("past", it.past);
        each("member", it.member);
    }
    bool operator==(const Open&) const = default;
};

// ---- time ----

struct SetPace {
    bool paused = true;
    double speed = 1;  // 0: as fast as it goes
    static constexpr std::string_view kName = "pace";
    static void layout(auto& each, auto& it) {
        each("paused", it.paused);
        each("speed", it.speed);
    }
    bool operator==(const SetPace&) const = default;
};

// While paused.
struct LetTimePass {
    uint32_t milliseconds = 0;
    static constexpr std::string_view kName = "step";
    static void layout(auto& each, auto& it) { each("milliseconds", it.milliseconds); }
    bool operator==(const LetTimePass&) const = default;
};

// ---- what costs time and is made only while somebody looks ----

struct Show {
    bool rays = false;
    std::set<std::string> pictures = {};  // robots whose cameras
    static constexpr std::string_view kName = "show";
    static void layout(auto& each, auto& it) {
        each("rays", it.rays);
        each("pictures", it.pictures);
    }
    bool operator==(const Show&) const = default;
};

// ---- the plan ----

// To the next actor that begins.
struct StepPlan {
    static constexpr std::string_view kName = "plan.step";
    static void layout(auto&, auto&) {}
    bool operator==(const StepPlan&) const = default;
};

struct StopPlan {
    static constexpr std::string_view kName = "plan.stop";
    static void layout(auto&, auto&) {}
    bool operator==(const StopPlan&) const = default;
};

// Nodes of the bus that somebody pauses or debugs: the plan waits for them. The whole list, each
// time it changes.
struct HoldNodes {
    std::vector<uint16_t> nodes = {};
    static constexpr std::string_view kName = "plan.hold_nodes";
    static void layout(auto& each, auto& it) { each("nodes", it.nodes); }
    bool operator==(const HoldNodes&) const = default;
};

// The whole list, each time it changes.
struct SetBreakpoints {
    std::vector<BreakpointOrder> list = {};
    static constexpr std::string_view kName = "plan.breakpoints";
    static void layout(auto& each, auto& it) { each("list", it.list); }
    bool operator==(const SetBreakpoints&) const = default;
};

struct SetVariable {
    uint64_t request = 0;
    uint32_t level = 0;  // 0: the outermost plan
    std::string name = {};
    plan::Value value = {};
    static constexpr std::string_view kName = "plan.set";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("level", it.level);
        each("name", it.name);
        each("value", it.value);
    }
    bool operator==(const SetVariable&) const = default;
};

// As if the supervisor, which must watch now, had raised it.
struct RaiseEvent {
    uint64_t request = 0;
    std::string supervisor = {}, event = {};
    std::map<std::string, plan::Value> outputs = {};
    static constexpr std::string_view kName = "plan.raise";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("supervisor", it.supervisor);
        each("event", it.event);
        each("outputs", it.outputs);
    }
    bool operator==(const RaiseEvent&) const = default;
};

enum class HeldAct { Go, Step, Drop };
template <>
struct Words<HeldAct> {
    static constexpr std::string_view kAll[] = {"go", "step", "drop"};
};

// Of the events that wait while the plan is paused: without a number the first steps, and all go or
// are dropped.
struct HandleHeld {
    uint64_t request = 0;
    HeldAct act = HeldAct::Go;
    std::optional<uint64_t> number = {};
    static constexpr std::string_view kName = "plan.held";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("act", it.act);
        each("number", it.number);
    }
    bool operator==(const HandleHeld&) const = default;
};

// These files have been saved: what is made of them is to take over (P31).
struct ChangePlan {
    uint64_t request = 0;
    std::vector<std::string> files = {};
    static constexpr std::string_view kName = "plan.change";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("files", it.files);
    }
    bool operator==(const ChangePlan&) const = default;
};

// Whether it could take over now, if files had these texts.
struct CheckPlan {
    uint64_t request = 0;
    std::map<std::string, std::string> texts = {};
    static constexpr std::string_view kName = "plan.check";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("texts", it.texts);
    }
    bool operator==(const CheckPlan&) const = default;
};

// ---- a hand from above ----

struct MoveRobot {
    uint64_t request = 0;
    std::string robot = {};
    Point at = {};
    std::optional<double> angle = {};  // without: it keeps its own
    static constexpr std::string_view kName = "robot.move";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("robot", it.robot);
        each("at", it.at);
        each("angle", it.angle);
    }
    bool operator==(const MoveRobot&) const = default;
};

struct MoveObject {
    uint64_t request = 0;
    uint32_t object = 0;  // its number in the scene
    Point at = {};
    std::optional<double> angle = {};
    static constexpr std::string_view kName = "object.move";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("object", it.object);
        each("at", it.at);
        each("angle", it.angle);
    }
    bool operator==(const MoveObject&) const = default;
};

enum class ObjectKind { Wall, Box, Cylinder, Patch, Light, Infrared };
template <>
struct Words<ObjectKind> {
    static constexpr std::string_view kAll[] = {"wall",  "box",   "cylinder",
                                                "patch", "light", "infrared"};
};

// Its answer has the number of the object.
struct PutObject {
    uint64_t request = 0;
    ObjectKind kind = ObjectKind::Box;
    Point at = {};
    double angle = 0;
    std::string id = {};                // empty, or unlike that of any other object
    std::optional<Point> size = {};     // of a rectangle
    std::optional<double> radius = {};  // of a disc; neither: what the kind has
    std::optional<double> height = {}, mass = {};
    std::optional<Colour> colour = {};
    bool on = true;  // of a lamp
    static constexpr std::string_view kName = "object.put";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("kind", it.kind);
        each("at", it.at);
        each("angle", it.angle);
        each("id", it.id);
        each("size", it.size);
        each("radius", it.radius);
        each("height", it.height);
        each("mass", it.mass);
        each("colour", it.colour);
        each("on", it.on);
    }
    bool operator==(const PutObject&) const = default;
};

struct TakeObject {
    uint64_t request = 0;
    uint32_t object = 0;
    static constexpr std::string_view kName = "object.take";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("object", it.object);
    }
    bool operator==(const TakeObject&) const = default;
};

struct SwitchLight {
    uint64_t request = 0;
    uint32_t object = 0;
    bool on = false;
    static constexpr std::string_view kName = "object.light";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("object", it.object);
        each("on", it.on);
    }
    bool operator==(const SwitchLight&) const = default;
};

struct PressButton {
    uint64_t request = 0;
    std::string robot = {}, button = {};
    bool down = false;
    static constexpr std::string_view kName = "robot.press";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("robot", it.robot);
        each("button", it.button);
        each("down", it.down);
    }
    bool operator==(const PressButton&) const = default;
};

struct TapRobot {
    uint64_t request = 0;
    std::string robot = {};
    static constexpr std::string_view kName = "robot.tap";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("robot", it.robot);
    }
    bool operator==(const TapRobot&) const = default;
};

// ---- the bus of the world ----

struct SendFrame {
    BusFrame frame = {};
    static constexpr std::string_view kName = "frame";
    static void layout(auto& each, auto& it) { each("frame", it.frame); }
    bool operator==(const SendFrame&) const = default;
};

// ---- the recording ----

// A node was loaded with the script that this file holds for it.
struct ScriptLoaded {
    uint16_t node = 0;
    std::string file = {};  // of this computer
    std::string text = {};
    static constexpr std::string_view kName = "script";
    static void layout(auto& each, auto& it) {
        each("node", it.node);
        each("file", it.file);
        each("text", it.text);
    }
    bool operator==(const ScriptLoaded&) const = default;
};

// Answered when all that has been recorded is in the file.
struct FlushRecording {
    uint64_t request = 0;
    static constexpr std::string_view kName = "recording.flush";
    static void layout(auto& each, auto& it) { each("request", it.request); }
    bool operator==(const FlushRecording&) const = default;
};

// An event of the fleet, for the plan: the bus has it, too.
struct HearOfFleet {
    std::string event = {}, from = {};
    std::vector<int16_t> args = {};
    static constexpr std::string_view kName = "fleet.hear";
    static void layout(auto& each, auto& it) {
        each("event", it.event);
        each("from", it.from);
        each("args", it.args);
    }
    bool operator==(const HearOfFleet&) const = default;
};

// All of them. Which one a packet holds is its place in this list.
using Order =
    std::variant<Open, SetPace, LetTimePass, Show, StepPlan, StopPlan, HoldNodes, SetBreakpoints,
                 SetVariable, RaiseEvent, HandleHeld, ChangePlan, CheckPlan, MoveRobot, MoveObject,
                 PutObject, TakeObject, SwitchLight, PressButton, TapRobot, SendFrame, ScriptLoaded,
                 FlushRecording, HearOfFleet>;

}  // namespace vagus::serve::talk
