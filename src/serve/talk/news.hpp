// What the process of a run tells the server: every message there is. How they travel: codec.hpp.
//
//     if (const auto* clock = std::get_if<talk::Clock>(&news)) t = clock->t;
//
// After an Open come Opening, then Opened or OpenFailed, with its number. What comes before Opening
// is still of the run before.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "serve/follow/plan_outline.hpp"
#include "serve/talk/values.hpp"
#include "serve/target/happened.hpp"

namespace vagus::serve::talk {

// Nothing else to tell, but it works.
struct Alive {
    static constexpr std::string_view kName = "alive";
    static void layout(auto&, auto&) {}
    bool operator==(const Alive&) const = default;
};

// ---- a run begins ----

struct Opening {
    uint64_t order = 0;
    static constexpr std::string_view kName = "opening";
    static void layout(auto& each, auto& it) { each("order", it.order); }
    bool operator==(const Opening&) const = default;
};

struct SceneRobot {
    std::string name = {};
    std::vector<uint16_t> nodes = {};
    static void layout(auto& each, auto& it) {
        each("name", it.name);
        each("nodes", it.nodes);
    }
    bool operator==(const SceneRobot&) const = default;
};

// What is in the world.
struct Scene {
    std::vector<SceneRobot> robots = {};  // in the order of the document
    Document document = {};               // the topic scene
    static void layout(auto& each, auto& it) {
        each("robots", it.robots);
        each("document", it.document);
    }
    bool operator==(const Scene&) const = default;
};

// A source that the world has loaded into a node.
struct Program {
    uint16_t node = 0;
    std::string source = {};
    static void layout(auto& each, auto& it) {
        each("node", it.node);
        each("source", it.source);
    }
    bool operator==(const Program&) const = default;
};

struct Opened {
    uint64_t order = 0;
    std::optional<Scene> scene = {};  // none: the plan is on a bus
    std::vector<Program> programs = {};
    std::set<std::string> hears = {};      // events for which the plan listens
    std::set<std::string> stops = {};      // events by which its templates end work on nodes
    std::vector<std::string> others = {};  // of a run with a past: files that are others now
    static constexpr std::string_view kName = "opened";
    static void layout(auto& each, auto& it) {
        each("order", it.order);
        each("scene", it.scene);
        each("programs", it.programs);
        each("hears", it.hears);
        each("stops", it.stops);
        each("others", it.others);
    }
    bool operator==(const Opened&) const = default;
};

struct OpenFailed {
    uint64_t order = 0;
    std::string why = {};  // a sentence, or several lines of the checker
    static constexpr std::string_view kName = "failed";
    static void layout(auto& each, auto& it) {
        each("order", it.order);
        each("why", it.why);
    }
    bool operator==(const OpenFailed&) const = default;
};

// ---- the plan ----

// The plan that runs from the next line of the trace on: the first version, and each that has taken
// over (P31), once.
struct PlanVersion {
    uint64_t number = 0;      // 1: the first; counts up by one
    PlanOutlines plans = {};  // what it is made of, the outermost first
    // Of its files; none if they are too large.
    std::map<std::string, std::string> texts = {};
    static constexpr std::string_view kName = "plan.version";
    static void layout(auto& each, auto& it) {
        each("number", it.number);
        each("plans", it.plans);
        each("texts", it.texts);
    }
    bool operator==(const PlanVersion&) const = default;
};

// A line of the trace, and what the server has to know of it.
struct Traced {
    std::string line = {};
    std::optional<std::string> actor = {};  // it begins with this line
    bool late = false;                      // a check of a supervisor began late
    static constexpr std::string_view kName = "trace";
    static void layout(auto& each, auto& it) {
        each("line", it.line);
        each("actor", it.actor);
        each("late", it.late);
    }
    bool operator==(const Traced&) const = default;
};

enum class PlanState { Running, Paused, Ended };
template <>
struct Words<PlanState> {
    static constexpr std::string_view kAll[] = {"running", "paused", "ended"};
};

struct PlanLevel {
    std::string file = {};
    Document document = {};  // the rest of its PlanLevel in protocol.json
    static void layout(auto& each, auto& it) {
        each("file", it.file);
        each("document", it.document);
    }
    bool operator==(const PlanLevel&) const = default;
};

struct PlanNow {
    PlanState state = PlanState::Running;
    double t = 0;
    std::string file = {};  // of the outermost plan
    std::vector<PlanLevel> levels = {};
    DocumentList story = {};
    std::optional<std::string> result = {};  // once it has ended
    std::string message = {};                // of an error
    std::vector<uint64_t> stands_at = {};    // breakpoints that hold it, by their numbers
    static constexpr std::string_view kName = "plan";
    static void layout(auto& each, auto& it) {
        each("state", it.state);
        each("t", it.t);
        each("file", it.file);
        each("levels", it.levels);
        each("story", it.story);
        each("result", it.result);
        each("message", it.message);
        each("stands_at", it.stands_at);
    }
    bool operator==(const PlanNow&) const = default;
};

// Events of the bus that wait while the plan is paused.
struct HeldNow {
    Document document = {};  // the topic held
    static constexpr std::string_view kName = "held";
    static void layout(auto& each, auto& it) { each("document", it.document); }
    bool operator==(const HeldNow&) const = default;
};

struct BreakpointNow {
    uint64_t number = 0;
    uint64_t hits = 0;
    bool set = false;
    std::string why = {};  // why it is not, or why its condition cannot be evaluated
    static void layout(auto& each, auto& it) {
        each("number", it.number);
        each("hits", it.hits);
        each("set", it.set);
        each("why", it.why);
    }
    bool operator==(const BreakpointNow&) const = default;
};

struct BreakpointsNow {
    std::vector<BreakpointNow> list = {};
    static constexpr std::string_view kName = "breakpoints";
    static void layout(auto& each, auto& it) { each("list", it.list); }
    bool operator==(const BreakpointsNow&) const = default;
};

// The plan on a bus has ended, and all that it had to say was told.
struct PlanOver {
    static constexpr std::string_view kName = "over";
    static void layout(auto&, auto&) {}
    bool operator==(const PlanOver&) const = default;
};

// ---- answers and sentences ----

struct Answer {
    uint64_t request = 0;
    std::string why = {};                 // why it was not done; empty: it was
    std::optional<uint32_t> number = {};  // of an object that was put
    std::optional<std::vector<std::string>> reasons =
        {};  // against a version; none: it is no such plan
    static constexpr std::string_view kName = "answer";
    static void layout(auto& each, auto& it) {
        each("request", it.request);
        each("why", it.why);
        each("number", it.number);
        each("reasons", it.reasons);
    }
    bool operator==(const Answer&) const = default;
};

enum class LineKind { Note, Warning, Error };
template <>
struct Words<LineKind> {
    static constexpr std::string_view kAll[] = {"note", "warning", "error"};
};

// For the console.
struct Line {
    LineKind kind = LineKind::Note;
    std::string text = {};
    static constexpr std::string_view kName = "line";
    static void layout(auto& each, auto& it) {
        each("kind", it.kind);
        each("text", it.text);
    }
    bool operator==(const Line&) const = default;
};

// ---- the world ----

// Ten times a second, also while paused.
struct Clock {
    double t = 0;  // seconds of the run
    bool paused = true;
    double real = 0;                  // measured: simulated seconds a second
    std::optional<double> load = {};  // of the bus, in percent
    static constexpr std::string_view kName = "clock";
    static void layout(auto& each, auto& it) {
        each("t", it.t);
        each("paused", it.paused);
        each("real", it.real);
        each("load", it.load);
    }
    bool operator==(const Clock&) const = default;
};

// The scene is another one.
struct SceneNow {
    Scene scene = {};
    static constexpr std::string_view kName = "scene";
    static void layout(auto& each, auto& it) { each("scene", it.scene); }
    bool operator==(const SceneNow&) const = default;
};

struct FrameSeen {
    double t = 0;
    BusFrame frame = {};
    static constexpr std::string_view kName = "frame";
    static void layout(auto& each, auto& it) {
        each("t", it.t);
        each("frame", it.frame);
    }
    bool operator==(const FrameSeen&) const = default;
};

// ---- what flows to pages as it is: layouts in protocol.json ----

struct Poses {
    double t = 0;
    Bytes bytes = {};
    static constexpr std::string_view kName = "poses";
    static void layout(auto& each, auto& it) {
        each("t", it.t);
        each("bytes", it.bytes);
    }
    bool operator==(const Poses&) const = default;
};

struct Rays {
    double t = 0;
    Bytes bytes = {};
    static constexpr std::string_view kName = "rays";
    static void layout(auto& each, auto& it) {
        each("t", it.t);
        each("bytes", it.bytes);
    }
    bool operator==(const Rays&) const = default;
};

struct Picture {
    double t = 0;
    std::string robot = {};
    Bytes bytes = {};
    static constexpr std::string_view kName = "picture";
    static void layout(auto& each, auto& it) {
        each("t", it.t);
        each("robot", it.robot);
        each("bytes", it.bytes);
    }
    bool operator==(const Picture&) const = default;
};

// What changed in the world, for the history: whole records (follow/record.hpp).
struct Records {
    Bytes bytes = {};
    static constexpr std::string_view kName = "records";
    static void layout(auto& each, auto& it) { each("bytes", it.bytes); }
    bool operator==(const Records&) const = default;
};

// What a camera saw, for the history: now and then (docs/decisions/0240).
struct PictureThen {
    double t = 0;
    std::string robot = {};
    Bytes bytes = {};
    static constexpr std::string_view kName = "picture.then";
    static void layout(auto& each, auto& it) {
        each("t", it.t);
        each("robot", it.robot);
        each("bytes", it.bytes);
    }
    bool operator==(const PictureThen&) const = default;
};

// Of the bus while the past of a run is run again, for the history: what the nodes and the plan
// said, in its order.
struct HappenedOne {
    Happened what = {};
    static void layout(auto& each, auto& it) {
        each("t", it.what.t);
        each("kind", it.what.kind);
        each("node", it.what.node);
        each("source", it.what.source);
        each("name", it.what.name);
        each("text", it.what.text);
        each("args", it.what.args);
        each("line", it.what.line);
    }
    bool operator==(const HappenedOne&) const = default;
};
struct HappenedNow {
    std::vector<HappenedOne> list = {};
    static constexpr std::string_view kName = "happened";
    static void layout(auto& each, auto& it) { each("list", it.list); }
    bool operator==(const HappenedNow&) const = default;
};

// A variable of its plan that it tells the fleet.
struct ToldFleet {
    std::string name = {};
    std::vector<int16_t> values = {};
    static constexpr std::string_view kName = "fleet.told";
    static void layout(auto& each, auto& it) {
        each("name", it.name);
        each("values", it.values);
    }
    bool operator==(const ToldFleet&) const = default;
};

// All of them. Which one a packet holds is its place in this list.
using News = std::variant<Alive, Opening, Opened, OpenFailed, PlanVersion, Traced, PlanNow, HeldNow,
                          BreakpointsNow, PlanOver, Answer, Line, Clock, SceneNow, FrameSeen, Poses,
                          Rays, Picture, Records, HappenedNow, PictureThen, ToldFleet>;

}  // namespace vagus::serve::talk
