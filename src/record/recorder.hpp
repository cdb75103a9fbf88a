// What is recorded of a run in a world, or of a plan alone: put on a tape (topics.hpp), which is a
// file, or what compares it with one.
//
//     Recorder recorder(tape, format_run(about));
//     recorder.follow(session);                     // a world: before its first instant
//     run.listen([&](const plan::TraceEvent& event) { recorder.trace(event); });
//     …
//     recorder.end(at);
//
// At the end of each instant of the world, on the thread that steps it: what has changed of nodes
// each kVariablesEvery, poses each kPosesEvery, checks each kCheckEvery.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plan/trace.hpp"
#include "record/bus_messages.hpp"
#include "record/inputs.hpp"
#include "record/topics.hpp"
#include "session/sim_session.hpp"

namespace vagus::record {

constexpr Duration kVariablesEvery = std::chrono::milliseconds(20);
constexpr Duration kPictureEvery = std::chrono::seconds(10);  // all variables of a node
constexpr Duration kPosesEvery = std::chrono::milliseconds(100);
constexpr Duration kCamerasEvery = std::chrono::milliseconds(100);
constexpr Duration kCheckEvery = std::chrono::seconds(1);

// One for all of a check (Recorder::check_text()), as a person compares it: 16 digits.
std::string state_hash(std::string_view check);

// Whether there are cameras for --record-camera; nullptr: the run has no world. The Error says so.
Status check_cameras(const sim::World* world);

class Recorder {
public:
    // `run` is the message of /vagus/run. The tape is borrowed.
    Recorder(Tape& tape, std::string_view run);
    // Of a robot with a project of its own: what is on its bus, and nothing of the world around
    // it. As follow().
    Recorder(Tape& tape, session::SimSession& robot);
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    // Borrowed until the recorder goes, or the session before it, which forget() tells. Links that
    // the bus gets later are outside of the run: what comes from there is an input.
    void follow(session::SimSession& session);
    void forget() { session_ = nullptr; }
    // Behind follow(): also what the robots' cameras see. They are samples for people: nothing of
    // the run follows from them, and they are not compared.
    void follow_cameras();
    // After what is recorded of each instant: things may be done to the world here.
    void after_instant(std::function<void(Time)> act) { after_instant_ = std::move(act); }

    void trace(const plan::TraceEvent& event);

    // ---- what comes from outside, now; acts and frames are heard here ----
    void input(InputWhat what);
    // The same at a time, of a run without a world: from any thread.
    void input_at(Time at, InputWhat what);
    // What comes from here on has another turn, or that one.
    void begin_turn() { turn_begins_ = true; }
    void set_turn(uint32_t turn) { turn_ = turn; }
    // The same, and it is done: a moment in which time is stopped; a program that a host has
    // loaded, by whose names the variables of its node are told from here on.
    void hold();
    void script(const ScriptLoaded& script, const std::string& path);

    // The last check.
    void end(Time at);

    // What a check says that is made now: a hash of the state of each node, the plan, each body.
    std::string check_text(Time at) const;

private:
    struct Node {
        sim::RobotId robot;
        uint16_t id = 0;
        std::string label;  // in topics and checks
        uint16_t topic = 0;
        const void* program = nullptr;  // whose variables these are
        size_t named = 0;               // words, from the first on: behind them none has a name
        RecordedVariables variables;
        std::vector<int16_t> words;  // those with names, as they were recorded
        bool pictured = false;
    };

    struct Camera {
        sim::RobotId robot;
        std::string name;
        uint16_t topic = 0;
    };

    void declare();
    void follow_bus(session::SimSession& session);
    void instant();
    void samples(Time at);
    void from_outside(hub::LinkId from, const wire::Frame& frame);
    void frame(const wire::Frame& frame, uint32_t number);
    void heard(const debug::Event& event);
    void look_for_nodes();
    void learn_variables(Node& node);
    void variables(Node& node, Time at, bool all);
    void scene(Time at);
    void poses(Time at);
    void pictures(Time at);
    void check(Time at);
    std::string nodes_check() const;
    std::string bodies_check() const;
    void chaos();
    std::string label_of(sim::RobotId robot, const std::string& name) const;
    Time now() const { return session_->now(); }

    Tape& tape_;
    session::SimSession* session_ = nullptr;
    const bool of_robot_ = false;  // with a project of its own
    std::function<void(Time)> after_instant_;
    uint16_t input_ = 0;
    uint16_t check_ = 0;
    uint16_t trace_ = 0;
    uint16_t states_ = 0;
    uint16_t frames_ = 0;
    uint16_t events_ = 0;
    uint16_t poses_ = 0;
    uint16_t scene_ = 0;
    uint16_t chaos_ = 0;       // 0: nothing breaks in this run
    hub::LinkId last_inside_;  // of the links of the bus that are part of the run
    uint32_t turn_ = 0;
    bool turn_begins_ = false;
    std::vector<Node> nodes_;
    // Of the message that is being made.
    std::string text_;
    std::vector<const RecordedVariable*> told_;
    std::vector<Camera> cameras_;
    std::string objects_;     // as the scene told them last
    uint64_t plan_hash_ = 0;  // of all lines of the trace so far
    std::map<std::string, std::map<std::string, int, std::less<>>, std::less<>> numbers_;
};

}  // namespace vagus::record
