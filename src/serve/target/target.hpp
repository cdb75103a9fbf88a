// The target and its nodes as pages see them: connection, programs, run control, breakpoints,
// variables, events. Above debug::Network, which knows nodes but neither files nor people.
//
//     Target target(desk, files, scripts, breakpoints);
//     target.connect(carrier, "tcp:127.0.0.1:33333", "Thymio", "bus", now);
//     target.tick(now);
//
// A node that was away comes back without anybody doing anything: one that says that it kept its
// program goes on with its breakpoints; any other gets it again and is paused until a page lets it
// run.
//
// What moves is stopped wherever nobody watches it (safe stop): stop_all() reads back whether nodes
// are at rest; of a live robot, one paused node brakes all (brake.cpp); a page that drives and
// loses the connection drives no more (lease.cpp).
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "debug/network.hpp"
#include "fleet/project_part.hpp"
#include "serve/json.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"
#include "serve/target/breakpoints.hpp"
#include "serve/target/carrier.hpp"
#include "serve/target/dropped_events.hpp"
#include "serve/target/happened.hpp"
#include "serve/target/stopping.hpp"
#include "serve/target/word_ranges.hpp"

namespace vagus::serve {

constexpr Duration kRestWithin = 500ms;  // make_safe() writes again what was written over
// A link on which nobody answers for so long is lost, counted while our own loop was on time.
constexpr Duration kLinkSilentMax = 3s;
constexpr Duration kLateMax = 100ms;       // a tick that comes later than this was not on time
constexpr size_t kLeasesMax = 1024;        // clients that drive by hand
constexpr Duration kRatesEvery = 1s;       // events a second are counted over this
constexpr size_t kTrafficMax = 2000;       // different events by sender
constexpr Duration kWatchedEvery = 50ms;   // variables that somebody looks at are asked for
constexpr size_t kWatchedWordsMax = 4096;  // of one subscription
constexpr size_t kSamplesKept = 20'000;    // of each plotted word
constexpr size_t kSamplesAtOnce = 10'000;  // in one frame; the rest comes with the next

// What a simulation adds to what nodes tell of themselves.
struct TargetHints {
    std::function<std::string(uint16_t node)> robot_of = [](uint16_t) { return std::string(); };
    // The plan waits for an event of that name.
    std::function<bool(const std::string& event)> plan_hears = [](auto&) { return false; };
    std::function<std::optional<double>()> load = [] { return std::optional<double>(); };
    // A script stopped at a breakpoint or by a fault: the clock of a simulation is paused with it.
    std::function<void()> stopped_at_breakpoint = [] {};
    // The run's clock, for what pages show.
    std::function<double()> time = [] { return 0.0; };
    // The source that the simulation itself has loaded into a node.
    std::function<std::optional<std::string>(uint16_t node)> loaded_already = [](uint16_t) {
        return std::optional<std::string>();
    };
};

// Whether a node works on an event is asked so often, and if it always did so many times in a row,
// there is no end. One that does so for 80 % of its time is taken for endless for a moment about
// once in two hours, one that does for half of it never.
constexpr Duration kHandlerLookEvery = std::chrono::milliseconds(200);
constexpr int kEndlessLooks = 40;  // 8 s

// Since the target was connected.
struct TargetCounts {
    uint64_t events = 0, lost = 0;  // events of nodes; frames that did not fit somewhere
    size_t nodes = 0, running = 0;  // that are there
};

// For the history: what happened; words that were seen, and words that nobody looks at any more.
struct TargetTold {
    using Words = std::span<const int16_t>;
    // As the network tells it.
    std::function<void(const debug::Event& event)> event = [](auto&) {};
    std::function<void(const Happened& happened)> happened = [](auto&) {};
    // The number of the run that it belongs to.
    std::function<uint64_t()> run = [] { return uint64_t{0}; };
    std::function<void(double t, uint16_t node, uint16_t address, Words values)> words =
        [](double, uint16_t, uint16_t, Words) {};
    std::function<void(double t, uint16_t node, uint16_t address, uint16_t count)> unwatched =
        [](double, uint16_t, uint16_t, uint16_t) {};
};

// For those who act for a robot as a whole: a fleet.
struct TargetTells {
    // A script of a node has emitted it.
    std::function<void(const std::string& event, const std::vector<int16_t>& args)> event =
        [](auto&, auto&) {};
    // A variable of tell_variables() has these values now.
    std::function<void(const fleet::Tells& variable, const std::vector<int16_t>& values)> variable =
        [](auto&, auto&) {};
};

struct DescribedNode {
    uint16_t id = 0;
    std::string name;
    aesl::Target target;
};
// The one of that name and number, or else the first of that name; an empty name is any.
std::optional<aesl::Target> target_among(const std::vector<DescribedNode>& nodes,
                                         const std::string& name, uint16_t id);

class Target {
public:
    // All borrowed. Declares its commands and topics at the desk.
    Target(Desk& desk, Files& files, Scripts& scripts, ScriptBreakpoints& breakpoints);
    ~Target();

    void set_hints(TargetHints hints) { hints_ = std::move(hints); }
    void on_told(TargetTold told) { told_ = std::move(told); }
    void on_tells(TargetTells tells) { tells_ = std::move(tells); }
    // Nodes are asked again and again whether they still work on the same event: endless.cpp.
    void look_for_endless_loops(bool looks) { looks_for_endless_ = looks; }
    // They are asked for from now on, whether a page looks at them or not.
    void tell_variables(std::vector<fleet::Tells> variables) {
        told_variables_ = std::move(variables);
    }
    // What is told to the people: a line of the console.
    void on_say(std::function<void(const std::string& kind, const std::string& text)> say) {
        say_ = std::move(say);
    }
    void on_breakpoints_changed(std::function<void()> changed) {
        breakpoints_changed_ = std::move(changed);
    }

    // ---- the target ----
    // The carrier is borrowed until disconnect(). `name` is for people.
    void connect(Carrier& carrier, const std::string& target, const std::string& name,
                 const std::string& kind, Time now);
    void disconnect();
    bool connected() const { return carrier_ != nullptr; }
    // As people see it: also one on which nobody answers is lost.
    Connection state() const;
    const std::string& target() const { return target_; }
    // nullptr while it is not connected; another one after each connect().
    const debug::Network* network() const { return network_.get(); }
    // What pages look at is told to the history once more, as far as it is known: it begins again.
    void tell_words() const;
    // Nodes that have told what they are.
    std::vector<DescribedNode> described() const;
    std::vector<std::string> names_of_nodes() const;  // of these
    // What a live node is, for compiling; nothing if it is not there.
    std::optional<aesl::Target> target_of(const std::string& name, uint16_t id) const;

    // ---- acting, also for other parts ----
    // What makes each node safe, by its name.
    void set_safe_stop(session::SafeStop safe) {
        end_rest();
        safe_stop_ = std::move(safe);
    }
    // Stop for every node, then what makes it safe, then what it says of that: before everything
    // else that is asked of nodes. `done` gets the report once, at the latest after kStopWithin.
    // Nodes that are not at rest then are asked on, until they are or acknowledge_stop().
    void stop_all(std::function<void(const StopReport&)> done);
    // Of the last of stop_all() and make_safe(): as it is now, for as long as nobody lets the nodes
    // run; empty while that is not answered.
    StopReport stop_report() const;
    void acknowledge_stop();
    // What makes nodes safe, while their scripts run.
    // What a handler under way writes over that is written again, for kRestWithin at most: then a
    // script that drives by itself does so.
    // `done` gets the report of the nodes that the safe stop names, once, unless something is to
    // move before that; nodes that did not answer are asked on.
    void make_safe(std::function<void(const StopReport&)> done = [](const StopReport&) {});
    // Something is to move from now on: what made nodes safe before is over.
    void will_move();
    // Something was done since Stop was sent, or ever, that can move a node.
    bool moved() const { return moved_; }
    // All nodes were told to stop, and nothing has happened since that can move one: nothing was
    // done, and none has come, or come back.
    bool quiet() const { return quiet_; }
    // Clients that drove by hand and are not there any more: what they drove is made safe.
    void end_leases();
    // Loads what differs from the texts; `done` gets sentences for what failed.
    void load_changed(bool run, std::function<void(std::vector<std::string>)> done);
    void run_all(std::function<void(std::vector<std::string>)> done);
    void pause_all(std::function<void(std::vector<std::string>)> done);
    // Of the paused nodes only.
    void run_paused(std::function<void(std::vector<std::string>)> done);
    void step_paused(std::function<void(std::vector<std::string>)> done);
    // An event of the bus, from here.
    Status emit(const std::string& event, const std::vector<int16_t>& args);
    // Writes "NAME", "NAME[3]" or "NAME[2:5]" of a node, for somebody without a page: nothing that
    // drives it. `done` gets why not, or nothing.
    void write(const std::string& node, const std::string& variable,
               const std::vector<int16_t>& values, std::function<void(std::string why)> done);
    // Whether a node of that name has that variable; the Error names what there is.
    Status find_variable(const std::string& node, const std::string& name) const;
    // What people should know of nodes: faults, nodes that are away.
    std::vector<std::string> problems() const;
    // One of those is not over: what a node did wrong before it was read back as stopped is.
    bool is_at_fault() const;
    // A node is paused at a line of its script.
    bool is_paused_inside() const;
    // Empty if it is not there or has not told what it is.
    std::string described_name(uint16_t node) const;
    // Nodes that somebody debugs: paused, reset, stepped or loaded from here, at a breakpoint of
    // a host, or paused because of such a one. In ascending order.
    std::vector<uint16_t> held_nodes() const;
    // Nodes that the project has no script for.
    std::vector<uint16_t> without_script() const;
    // So many nodes are there and have told what they are.
    bool all_described(size_t count) const { return live_nodes().size() >= count; }
    TargetCounts counts() const;
    // A document has another text: marks and breakpoints follow.
    void script_changed(const std::string& file);
    // Breakpoints are as another project keeps them: from now on they stay with their lines.
    void follow_breakpoints();
    // Sets them on the nodes, as they are now.
    void place_breakpoints();
    // [Breakpoint] of the protocol.
    Json breakpoints_list() const;

    void tick(Time now);
    Time next_tick() const;
    // How often it was put together what pages look at.
    uint64_t watched_made() const { return watched_made_; }

private:
    using Act = Result<debug::RequestId> (Target::*)(uint16_t);
    using Ask = std::function<Result<debug::RequestId>(uint16_t)>;
    // What we know of a node beside debug::NodeView.
    struct Known {
        std::string loaded;  // the source that was loaded
        bool has_program = false;
        double loaded_wall = 0;
        std::string why;  // it is paused
        std::string fault;
        int fault_line = 0;  // 0: not known
        std::string busy;
        bool lost_program = false;                // it came back without
        bool away = false;                        // it was there, and is not heard
        bool in_doubt = false;                    // it is back, and has not told what it runs
        bool stopped = false;                     // its next run starts from the beginning
        bool runs = false;                        // it said so last
        bool held = false;                        // somebody debugs it
        std::optional<debug::RequestId> braking;  // it is being paused for another
        uint64_t events = 0;
        std::optional<debug::RequestId> look;  // the question whether it works on an event
        int busy_looks = 0;                    // in a row at which it did
        bool endless = false;                  // that is what its `fault` says
    };
    // One command for several nodes.
    struct Batch {
        std::map<uint32_t, uint16_t> waiting;  // request to node
        std::vector<uint16_t> done;
        std::vector<std::pair<uint16_t, std::string>> failed, notes;
        std::function<void(Batch&)> finish;
        Json failures() const;  // [Failed] of the protocol
        Json answers() const;   // [NodeNote]
    };
    struct VariableWatch;
    struct SampleWatch;
    friend struct VariableWatch;
    friend struct SampleWatch;

    void declare_commands();
    void declare_node_commands();
    void declare_topics();
    void declare_watches();
    void act(const Call& call, Act what, const char* busy);
    void act(const Call& call, const Ask& ask, const char* busy);
    Result<debug::RequestId> let_run(uint16_t node);
    Result<debug::RequestId> step(uint16_t node);
    Result<debug::RequestId> pause(uint16_t node);
    Result<debug::RequestId> reset(uint16_t node);
    void let_run(const std::vector<uint16_t>& nodes,
                 std::function<void(std::vector<std::string>)> done);
    void start_batch(const std::vector<uint16_t>& nodes, const Ask& ask,
                     std::function<void(Batch&)> finish, const char* busy);
    void finish_batches();
    Result<debug::RequestId> stop(uint16_t node);
    void note_stopped(const Batch& batch);
    // It runs, or waits only for others.
    bool is_ready(uint16_t node) const;
    void note_failed_loads(const Batch& batch);

    // ---- the link ----
    std::string why_lost() const;
    void watch_link(Time now, bool heard);
    void name_events();
    void link_changed();

    // ---- a live robot brakes as a whole (brake.cpp) ----
    // Its clock does not stop when a node does.
    bool live() const { return carrier_ && kind_ == "bus"; }
    bool moves(uint16_t node) const;
    void make_safe(uint16_t node);
    // The node is paused, or is away, or is about to.
    void brake(uint16_t cause);
    // It does not any more: when no other does, the nodes that were paused for it run again.
    void release(uint16_t cause);
    void release_all();
    void end_rest();
    void tick_rest(Time now);
    void note_move();
    void after_step(uint16_t node);
    void brake_one(uint16_t node);
    void note_held(uint16_t node, const debug::StateChanged& state);
    bool is_held(uint16_t node) const;

    // ---- direct driving (lease.cpp) ----
    void note_lease(uint32_t member, uint16_t node, const debug::VariableRange& range);

    // ---- nodes that were away (returning.cpp) ----
    void went_away(uint16_t node);
    void came_back(uint16_t node);
    void program_is_lost(uint16_t node);
    void told_program(uint16_t node, uint32_t mark);
    void load_lost_programs();
    std::vector<uint16_t> nodes_of(const Json& node) const;
    std::vector<uint16_t> live_nodes() const;
    std::vector<uint16_t> paused_nodes() const;
    bool is_stopped(uint16_t node) const {
        const auto known = known_.find(node);
        return known != known_.end() && known->second.stopped;
    }
    void load(const std::vector<uint16_t>& nodes, bool run, std::function<void(Batch&)> finish);
    void set_variable(const Call& call);
    void set_breakpoint(const Call& call);

    void hear_all();
    void send_frames();
    void hear(const debug::Event& event);
    void note_state(uint16_t node, debug::ProgramState state);
    void hear(const debug::Event& event, const debug::NodeDescribed& described);
    void hear(const debug::Event& event, const debug::StateChanged& state);
    void hear(const debug::Event& event, const debug::Fault& fault);
    void hear(const debug::Event& event, const debug::BreakpointHit& hit);
    void hear(const debug::Event& event, const debug::UserEvent& sent);
    void count_dropped(uint16_t from, uint16_t event);
    void hear(const debug::RequestDone& done);
    void hear(const debug::Event& event, const debug::VariableChanged& changed);
    void hear_place(const debug::Event& event, const debug::BreakpointResult& result);
    void happen(Happened happened);
    void put_watched_together();
    void begin_samples(const std::pair<uint16_t, uint16_t>& word);
    void watch_what_is_shown();
    bool is_told(const std::string& node, const std::string& variable) const;
    void tell_unwatched(uint16_t node, const debug::NodeView& view, const std::string& name);
    static std::map<std::string, std::pair<uint32_t, uint32_t>> variables_of(
        const debug::NodeView& view);
    void count_rates(Time now);
    void look_at_handlers(Time now);
    void note_look(uint16_t node, bool answered);
    double time() const { return heard_t_ ? *heard_t_ : hints_.time(); }
    void restore(uint16_t node);
    // ---- placing.cpp: breakpoints on the nodes ----
    // Lines of what a node has loaded against those of the text as it is now.
    enum class Direction { ToText, ToNode };
    LineMap lines_between(uint16_t node, Direction direction) const;
    bool runs_older_text(uint16_t node) const;
    void remember_lines();
    void follow_lines(const std::string& file);
    void place_breakpoints(uint16_t node);
    ScriptBreakpoint* breakpoint_of(uint16_t node, int line);
    std::string doc_of(uint16_t node) const;
    std::string name_of(uint16_t node) const;
    std::string source_of(uint16_t node) const;

    Json target_document() const;
    Json node_document(const Json& of) const;
    Json node_line(uint16_t id) const;
    Json network_document() const;

    Desk& desk_;
    Files& files_;
    Scripts& scripts_;
    ScriptBreakpoints& breakpoints_;
    TargetHints hints_;
    TargetTold told_;
    TargetTells tells_;
    std::vector<fleet::Tells> told_variables_;
    std::function<void(const std::string&, const std::string&)> say_ = [](auto&, auto&) {};
    std::function<void()> breakpoints_changed_ = [] {};

    Carrier* carrier_ = nullptr;
    std::string target_, name_, kind_ = "none";
    Connection connection_ = Connection::Connecting;
    Duration silence_{};  // since something was heard, of a link with nodes
    uint64_t heard_ = 0;  // frames by then
    bool looks_for_endless_ = false;
    Time look_at_{};     // the next time
    bool mute_ = false;  // for too long
    bool more_ = false;  // frames wait that were not taken
    Time due_{};         // when this asked to be called
    Time looked_at_{};   // at the link
    session::SafeStop safe_stop_;
    Stopping stopping_;
    session::Stopping resting_;  // while scripts run on
    Time rest_until_{};
    std::function<void(const StopReport&)> rested_;  // is told of that
    bool rests_ = false;                             // it was asked for behind the last Stop
    bool in_charge_ = false;                         // somebody has acted on the robot from here
    bool moved_ = false;                             // … by what can move it, since Stop
    bool quiet_ = false;
    std::set<uint16_t> brake_causes_;                // nodes that stand, or are away
    std::set<uint16_t> braked_;                      // nodes that were paused because of them
    std::map<uint32_t, std::set<uint16_t>> leases_;  // what each client drives by hand
    std::unique_ptr<debug::Network> network_;
    Time now_{};
    std::optional<double> heard_t_;  // of the frame that is heard, by the clock of a simulation
    std::map<uint16_t, Known> known_;
    std::map<std::string, std::string> marked_;  // texts that breakpoints count in, by document
    std::vector<std::unique_ptr<Batch>> batches_;

    // Values of watched variables as they were told last: by node and address.
    std::map<uint16_t, std::map<uint16_t, int16_t>> values_;
    std::map<uint16_t, WordRanges> wanted_;  // that pages look at, by node
    uint64_t wanted_of_ = 0;                 // Topics::subscriptions()
    uint64_t watched_made_ = 0;
    std::map<uint16_t, std::set<std::string>> watched_;  // names that we watch at the network
    struct Sample {
        double t;
        int16_t value;
    };
    struct Samples {
        std::deque<Sample> kept;
        uint64_t end = 0;  // number of the next one
    };
    std::map<std::pair<uint16_t, uint16_t>, Samples> samples_;  // of plotted words
    std::map<std::pair<uint16_t, std::string>, uint64_t> traffic_;
    DroppedEvents dropped_;
    uint64_t events_ = 0, events_before_ = 0;
    double events_a_second_ = 0;
    Time rates_at_{};
};

}  // namespace vagus::serve
