// One simulated world with its bus and the scripts of its robots, on one clock. Scripts go to the
// robots as from any host: the session is a host of its own on the bus, waits for the robots'
// descriptions, compiles, and sends the bytecode. It is told how much time passes and opens no
// socket; a program with sockets adds links to world().bus().
//
//     Result<SimSession> opened = open_sim("arena.world.json", {});
//     SimSession& session = opened.value();
//     session.load("explore.aesl", text);
//     session.step(std::chrono::milliseconds(40));
//     for (const Note& note : session.take_notes()) show(note.text);
//     for (const NodeState& node : session.nodes()) show(node.name, node.state);
//
// A robot of the world that has a project is on a bus of its own, and has a session of its own,
// which borrows the world; world_buses.hpp steps them all together.
//
// What mistakes a script has is known once the robots have described themselves, some milliseconds
// of simulated time after the start: settled() tells when.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "aesl/compile.hpp"
#include "base/diagnostic.hpp"
#include "base/result.hpp"
#include "base/shared_value.hpp"
#include "debug/network.hpp"
#include "debug/turns.hpp"
#include "session/script_file.hpp"
#include "session/stopping.hpp"
#include "session/trace.hpp"
#include "sim/host_chaos.hpp"
#include "sim/world.hpp"

namespace vagus::session {

constexpr size_t kScriptFilesMax = sim::kRobotsMax + 1;  // one for each robot, and one for all
// Programs on their way at a time. On an ideal bus only its own node sees one, so as many as the
// network has turns for: eight arrive in a millisecond, and 10,000 robots have their scripts before
// two seconds are over. Over a CAN they share one wire with all else.
constexpr size_t kLoadsAtOnce = debug::kTurnsAtOnce;
constexpr size_t kLoadsAtOnceOverCan = 4;
constexpr size_t kEventNamesMax = 256;  // different events that are counted; further ones only pass
constexpr size_t kNotesMax = 10000;     // not taken yet; then the newest are dropped
constexpr size_t kHeardMax = 10000;     // the same of take_heard()
// A handler that takes so much simulated time, all of which its node gave it, has no end. Below the
// 3 s without a fault after which a fleet believes that a version is well.
constexpr Duration kEndlessAfter = std::chrono::seconds(2);
// Until all that was loaded runs: in all, and for each node more.
constexpr Duration kSettleWithin = std::chrono::seconds(5);
constexpr Duration kSettleWithinMore = std::chrono::milliseconds(20);

struct SimOptions {
    sim::WorldOptions world;
    aesl::Options compile;
    bool traced = false;                    // keep lines for take_trace()
    bool heard = false;                     // keep what happens on the bus for take_heard()
    SafeStop guests = shipped_safe_stop();  // what brings nodes to rest that others bring
};

enum class NoteKind {
    Loaded,    // a script runs
    Mistakes,  // a script does not compile, or its file is no project; what ran before runs on
    Warnings,  // it compiles, with remarks; or remarks about the world file
    Event,     // someone sent a user event
    Fault,     // a script was stopped by what it did
    Trouble,   // a script could not be sent
    Plan,      // the plan of a robot with a project has ended
    Fleet,     // what such a robot says of its fleet
    Chaos,     // a fault of the run has begun, or is over
};

struct Note {
    Time at{};
    NoteKind kind = NoteKind::Event;
    // Mistakes and Warnings: several lines, each with its newline; else one sentence.
    std::string text;
};

struct EventCount {
    std::string name;
    uint64_t count = 0;
    std::vector<int16_t> arguments;  // of the last one
    Time last{};
};

// One node of a robot as its script and the node itself tell.
struct NodeState {
    sim::RobotId robot;
    uint16_t id = 0;
    std::string name;  // empty until it described itself
    debug::ProgramState state = debug::ProgramState::Unknown;
    bool has_script = false;
    std::string fault;   // the sentence, until the next program or reset
    std::string killed;  // the same: a handler that had not ended as the next event came
};

class SimSession {
public:
    // Of the common bus.
    SimSession(sim::World world, SimOptions options);
    // Of the bus of that robot alone, in a world that another session owns. Lines of its trace name
    // the robot.
    SimSession(sim::World& world, sim::RobotId robot, SimOptions options);

    // Takes over the scripts of a file for all nodes they are for; those of the same path that came
    // before are forgotten. A plain script is for the first node of every robot. Whatever is wrong,
    // with the file or a script, comes as a note and stays among the mistakes() until a better text
    // comes.
    void load(const std::string& path, std::string_view text);
    // For one robot only, as the world file says: the scripts for its nodes, or, for its first
    // node, the only one.
    void load_for(sim::RobotId robot, const std::string& path, std::string_view text);
    // A file that was loaded before has another text now. With mistakes, what ran before runs on.
    void reload(const std::string& path, std::string_view text);
    // The files that were loaded.
    std::vector<std::string> script_paths() const;

    // Lets `span` pass: whole milliseconds, the rest is kept.
    void step(Duration span);
    // One sim::kNodeStep in two halves, as those of sim::World: for a plan beside it, which comes
    // between the nodes and the bodies.
    void begin_instant();
    void end_instant();
    // What a session does around the steps of a world that several share: before its nodes have
    // their turns, behind that, and behind the bodies; `told` is how many happenings there were
    // before the bodies moved.
    void before_nodes();
    void after_nodes();
    void after_bodies(size_t told);
    // The same around sim::World::hold_instant().
    void before_hold();
    void after_hold();
    // At time 0: loads the scripts while the world is paused (docs/decisions/0083). False if not
    // all of them are settled() after settles_within().
    bool settle();
    // By then everything is settled() that ever will be: kSettleWithin and kSettleWithinMore.
    Duration settles_within() const;
    Time now() const { return world_->now(); }
    // Time 0 again, and the same scripts are sent again.
    void reset();
    // The same after another session has reset the world.
    void begin_again();
    // Everything that was loaded runs on its node, or has mistakes.
    bool settled() const;

    // ---- a plan beside it ----
    // Sends a user event as a host; `at` is for the trace. It is delivered at the next instant.
    // Fails for an event that no project of the robots declares, and for another number of
    // arguments than is declared.
    // `cause` is the number of the frame that it follows from, where frames have one.
    Status emit(const std::string& event, std::span<const int16_t> arguments, Time at,
                uint32_t cause = 0);
    // From now on only this robot takes what is emitted: a plan is for one robot.
    void emit_to(sim::RobotId robot) { emits_to_ = robot; }
    // What the bus told since, user events and all else, in its order; with SimOptions::heard.
    std::vector<debug::Event> take_heard();
    // Between begin_instant() and end_instant(), for a plan that a debugger holds there: user
    // events that have arrived since are heard now, all else at the next instant. Stop passes only
    // what has not been taken from the bus, so a run that is to be the same again does it at the
    // same place: on_ahead().
    void hear_ahead();
    // Names of events and constants, by the projects that the robots load.
    const aesl::CommonDefinitions& common() const { return network_.common(); }

    // Stops all nodes of its robots, as a host does who presses Stop.
    void stop_nodes();

    // ---- the nodes of a robot, for who tells them what to do (node_commands.hpp) ----
    // What is asked leaves with this instant or the next; what comes of it is in take_heard(), at
    // times of clock(), which also goes on over reset().
    debug::Network& network() { return network_; }
    Time clock() const { return clock_; }
    // Scripts are compiled, but not loaded, until run_scripts() or reset().
    void hold_scripts() { held_ = true; }
    // Nodes get what is meant for them again, and run it from its beginning.
    enum class Again { All, WhatDoesNotRun };
    void run_scripts(Again which);
    // All scripts that were loaded, for others that come instead. Nodes keep what they have.
    void forget_scripts();

    // ---- guests: nodes that others brought to the bus, real ones perhaps ----
    // Tells them to stop and makes them safe, as SimOptions::guests says; they are read back while
    // the world steps on. With Rest their scripts run on. False: there are none.
    bool stop_guests(Stopping::How how = Stopping::How::Stop);
    // All have been read back at rest, or are gone.
    bool guests_rest() const { return !guests_ || guests_->settled(); }
    std::vector<StopNode> guests() const;

    // ---- recording ----
    // Is told of each frame with its number (World::number_frames()): of its own as they leave, of
    // all others as they reach hosts.
    using FrameListener = std::function<void(const wire::Frame&, uint32_t number)>;
    void on_frame(FrameListener told) { told_of_frame_.push_back(std::move(told)); }
    // Is told of what this host hears, as it decoded it, and of user events that it sends itself,
    // as they leave: with the numbers of their frames, where frames have them.
    using HeardListener = std::function<void(const debug::Event&)>;
    void on_heard(HeardListener told) { told_of_heard_.push_back(std::move(told)); }
    // Is told at the end of each instant, when the bodies have moved.
    void on_instant(std::function<void()> told) { told_of_instant_.push_back(std::move(told)); }
    // Is told before hear_ahead() takes what waits.
    void on_ahead(std::function<void()> told) { told_of_ahead_ = std::move(told); }
    // Nobody is told any more.
    void forget_listeners() {
        told_of_ahead_ = {};
        told_of_frame_.clear();
        told_of_heard_.clear();
        told_of_instant_.clear();
    }
    // What a person needs to know of a handler that has run for kEndlessAfter and not ended: the
    // place where it was found; empty otherwise.
    std::string endless(uint16_t node);
    // The place in a file of a line of the program of a node; empty without one.
    std::optional<std::pair<std::string, int>> place_of(uint16_t node, int line) const;
    // What runs on a node; nullptr without a script.
    const aesl::Program* program(uint16_t node) const;
    // Another host has loaded that node with the program of this file: names and lines of the node
    // are those of it from here on. A file that is not for the node changes nothing.
    void was_loaded(uint16_t node, const std::string& path, std::string_view text);

    // ---- looking ----
    const sim::World& world() const { return *world_; }
    sim::World& world() { return *world_; }
    // A frame of it, as frame_numbers.hpp counts buses.
    sim::FrameOnBus on_bus(const wire::Frame& frame) const {
        return {frame, robot_ ? robot_->number : 0};
    }
    // The bus of this session.
    hub::Hub& bus() { return robot_ ? world_->bus_of(*robot_) : world_->bus(); }
    // All nodes of all robots: in the order of the robots, and of the nodes of each.
    std::vector<NodeState> nodes() const;
    // The script's own variables of a node with their values now, in order of address; empty
    // without a script.
    std::vector<std::pair<std::string, std::span<const int16_t>>> script_variables(
        uint16_t node) const;
    // A variable of the description of the robot's nodes, "prox.horizontal": of the first node that
    // has one of that name. Empty if there is none.
    std::span<const int16_t> node_variable(sim::RobotId robot, std::string_view name) const;
    // What a node told about itself; nullptr until then.
    const aesl::Target* target(uint16_t node) const;
    // The latest first.
    std::vector<EventCount> events() const;
    // What runs: the sources that were compiled for the nodes, by node.
    std::map<uint16_t, std::string> running_scripts() const;
    // The mistakes of the scripts as they are now.
    std::vector<Diagnostic> mistakes() const;
    // Names of the nodes that are to have a script and do not run it.
    std::vector<std::string> without_script() const;

    std::vector<Note> take_notes();
    // Adds a note of code that runs beside this session.
    void tell(NoteKind kind, std::string text) { note(kind, std::move(text)); }
    std::string take_trace();
    // What is doubtful about the world file: FILE:LINE:COL: warning: sentence. Also a note.
    const std::vector<std::string>& hints() const { return hints_; }
    void warn(const std::vector<std::string>& lines);

private:
    // A script on its way to a node, or there.
    enum class Stage { Waiting, Ready, Sent, Runs, Failed };
    static constexpr size_t kStages = 5;
    struct Assignment {
        std::string path;
        SharedValue<aesl::Script> script;
        SharedValue<aesl::CommonDefinitions> common;
        Stage stage = Stage::Waiting;
        SharedValue<aesl::Program> program;  // the last that compiled
        debug::RequestId request;
        std::vector<Diagnostic> mistakes;  // of the text as it is now; `program` may be older
    };
    struct Node {
        sim::RobotId robot;
        std::string robot_name;
        uint16_t id = 0;
        uint16_t place = 0;   // among the nodes of the robot
        uint16_t places = 1;  // how many nodes the robot has
        std::optional<Assignment> script;
        std::string fault;
        std::string killed = {};
        std::string endless = {};
        bool awaited = false;  // as the world began again it was away; it gets its script then
    };
    struct Compiled {  // a script for a kind of node
        std::string path;
        SharedValue<aesl::Script> script;
        SharedValue<aesl::CommonDefinitions> common;
        SharedValue<aesl::Target> target;
        SharedValue<aesl::Program> program;
        bool good = false;
        std::vector<Diagnostic> mistakes;
    };
    struct WaitingFile {
        ScriptFile file;
        std::optional<sim::RobotId> only;
    };

    void add_nodes_of(const sim::RobotView& robot);
    TraceLine trace_line(Time at, std::string_view kind) const;
    bool is_of_its_bus(sim::RobotId robot) const;
    std::vector<wire::Frame> take_frames();
    void listen(const std::vector<wire::Frame>& delivered);
    void speak();
    void send_frames();
    void send_on(const wire::Frame& frame);
    void open_chaos();
    void tell_chaos();
    void number_own(const wire::Frame& frame);
    void number_heard(const wire::Frame& frame);
    void note(NoteKind kind, std::string text);
    void hear(debug::Event event);
    void tell_own(const wire::Frame& frame, uint32_t number);
    void hear_user_event(const debug::Event& event, const debug::UserEvent& sent);
    void hear_fault(Node& node, const debug::Fault& fault);
    void hear_done(Node& node, const debug::RequestDone& done);
    void trace_happenings(size_t first);
    void trace_on_bus(const sim::Happening& happening);
    void trace_of_body(const sim::Happening& happening);
    void take(const std::string& path, std::optional<sim::RobotId> only, std::string_view text);
    bool all_described();
    void place_files();
    void place(const WaitingFile& waiting);
    size_t place_project(const ScriptFile& file);
    size_t place_plain(const ScriptFile& file);
    size_t place_for(sim::RobotId robot, const ScriptFile& file);
    size_t place_among(std::span<Node* const> nodes, const ScriptFile& file);
    const Compiled& compiled(const Node& node);
    void give(Node& node, const ScriptFile& file, const aesl::Script& script);
    void refuse_file(const std::string& path, Diagnostic why);
    const aesl::CommonDefinitions& names_without(const std::string& path) const;
    bool agree_on_names(const std::string& path, const aesl::CommonDefinitions& common);
    void compile(Node& node);
    void send_ready();
    void send(Node& node);
    size_t& count(Stage stage) { return in_stage_[static_cast<size_t>(stage)]; }
    size_t count(Stage stage) const { return in_stage_[static_cast<size_t>(stage)]; }
    void enter(Assignment& script, Stage stage);
    Node* find(debug::NodeId id);
    const Node* find(debug::NodeId id) const;
    std::string label(const Node& node) const;

    std::unique_ptr<sim::World> owned_;  // nullptr: another session owns it
    sim::World* world_;
    std::optional<sim::RobotId> robot_;  // whose bus it is; empty: the common one
    std::string robot_name_;
    SimOptions options_;
    debug::Network network_;
    hub::LinkId link_;                    // ours on the bus
    std::vector<wire::Frame> put_off_;    // taken by hear_ahead(), for the next instant
    std::vector<wire::Frame> delivered_;  // to be heard behind the turns of the nodes
    std::optional<sim::RobotId> emits_to_;
    bool over_can_;                                  // frames cross a modelled bus
    bool held_ = false;                              // no script is loaded now
    Time clock_{};                                   // of the network: goes on over reset()
    Duration rest_{};                                // of step()
    std::vector<Node> nodes_;                        // by robot, then by place
    std::unordered_map<uint16_t, size_t> index_of_;  // in nodes_, by id
    std::array<size_t, kStages> in_stage_{};         // how many scripts
    size_t undescribed_ = 0;                         // who was missing last, by place in nodes_
    size_t next_ready_ = 0;                          // where send_ready() looks on
    std::vector<WaitingFile> waiting_;
    std::vector<Compiled> compiled_;  // while files are placed
    std::vector<std::pair<std::string, std::optional<sim::RobotId>>> sources_;  // as loaded
    std::map<std::string, Diagnostic> file_mistakes_;  // by path: what keeps a whole file out
    // By path: events of the scripts that run.
    std::map<std::string, aesl::CommonDefinitions> names_;
    std::map<std::string, EventCount> events_;
    std::vector<Note> notes_;
    std::vector<std::string> hints_;
    std::vector<debug::Event> heard_;
    std::vector<FrameListener> told_of_frame_;
    std::vector<HeardListener> told_of_heard_;
    std::vector<std::function<void()>> told_of_instant_;
    std::function<void()> told_of_ahead_;
    uint32_t last_frame_ = 0;            // that it took, by its number
    std::deque<uint32_t> emit_causes_;   // of user events that have not left yet
    std::deque<uint32_t> event_frames_;  // of user events that were received, not yet heard
    std::optional<Stopping> guests_;
    std::unique_ptr<sim::HostChaos> chaos_;  // nullptr: its link to the bus has no faults
    std::string trace_;
};

// Whether the projects of robots are run (world_buses.hpp), or those robots stand still in a
// session of the common bus alone, which says so in a hint.
enum class Projects { StandStill, Run };

// Opens a world file and loads the scripts that it names for its robots, from the file's folder.
Result<SimSession> open_sim(const std::string& path, SimOptions options);
// The same of a text that the file may not have yet: as it is in an editor.
Result<SimSession> open_sim_text(const std::string& path, const std::string& text,
                                 SimOptions options, Projects projects = Projects::StandStill);

}  // namespace vagus::session
