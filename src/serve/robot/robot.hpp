// The target and its nodes as pages see them: connection, programs, run control, breakpoints,
// variables, events. Above debug::Network, which knows nodes but neither files nor people.
//
//     Robot robot(desk, scripts, breakpoints);
//     robot.connect(std::move(carrier), "tcp:127.0.0.1:33333");
//     robot.tick(now);
//
// A node that was away comes back without anybody doing anything: one that kept its program goes on
// with its breakpoints, one that lost it gets it again and stands until someone lets it run.
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
#include "serve/robot/breakpoints.hpp"
#include "serve/robot/carrier.hpp"
#include "serve/robot/dropped_events.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

constexpr Duration kRatesEvery = 1s;       // events a second are counted over this
constexpr size_t kTrafficMax = 2000;       // different events by sender
constexpr Duration kWatchedEvery = 50ms;   // variables that somebody looks at are asked for
constexpr size_t kSamplesKept = 20'000;    // of each plotted word
constexpr size_t kSamplesAtOnce = 10'000;  // in one frame; the rest comes with the next

// What a simulation adds to what nodes tell of themselves.
struct RobotHints {
    std::function<std::string(uint16_t node)> robot_of = [](uint16_t) { return std::string(); };
    // The plan waits for an event of that name.
    std::function<bool(const std::string& event)> plan_hears = [](auto&) { return false; };
    std::function<std::optional<double>()> load = [] { return std::optional<double>(); };
    // A script stopped at a breakpoint, or goes on: the clock of a simulation stands with it.
    std::function<void()> stopped_at_breakpoint = [] {};
    // The run's clock, for what pages show.
    std::function<double()> time = [] { return 0.0; };
    // The source that the simulation itself has loaded into a node.
    std::function<std::optional<std::string>(uint16_t node)> loaded_already = [](uint16_t) {
        return std::optional<std::string>();
    };
};

// Since the target was connected.
struct RobotCounts {
    uint64_t events = 0, lost = 0;  // events of nodes; frames that did not fit somewhere
    size_t nodes = 0, running = 0;  // that are there
};

// For the history: what happened, a Happening of the protocol; where a node stands; words that were
// seen, and words that nobody looks at any more.
struct RobotTold {
    using Words = std::span<const int16_t>;
    std::function<void(const nlohmann::json& happening)> happening = [](auto&) {};
    std::function<void(double t, uint16_t node, const std::string& state, int line)> stands =
        [](double, uint16_t, auto&, int) {};
    std::function<void(double t, uint16_t node, uint16_t address, Words values)> words =
        [](double, uint16_t, uint16_t, Words) {};
    std::function<void(double t, uint16_t node, uint16_t address, uint16_t count)> unwatched =
        [](double, uint16_t, uint16_t, uint16_t) {};
};

class Robot {
public:
    using Json = nlohmann::json;

    // All borrowed. Declares its commands and topics at the desk.
    Robot(Desk& desk, Files& files, Scripts& scripts, ScriptBreakpoints& breakpoints);
    ~Robot();

    void set_hints(RobotHints hints) { hints_ = std::move(hints); }
    void on_told(RobotTold told) { told_ = std::move(told); }
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
    const std::string& target() const { return target_; }
    // What a live node is, for compiling; nothing if it is not there.
    std::optional<aesl::Target> target_of(const std::string& name, uint16_t id) const;

    // ---- acting, also for other parts ----
    // Stop for every node, then what makes the wheels stand. `done` gets the nodes that answered.
    void stop_all(std::function<void(std::vector<uint16_t>)> done);
    // Loads what differs from the texts; `done` gets sentences for what failed.
    void load_changed(bool run, std::function<void(std::vector<std::string>)> done);
    void run_all(std::function<void(std::vector<std::string>)> done);
    void pause_all(std::function<void(std::vector<std::string>)> done);
    // Of the nodes that stand only.
    void run_standing(std::function<void(std::vector<std::string>)> done);
    void step_standing(std::function<void(std::vector<std::string>)> done);
    // A node stands at a line of its script.
    bool stands_inside() const;
    // Empty if it is not there or has not told what it is.
    std::string described_name(uint16_t node) const;
    // Nodes that the project has no script for.
    std::vector<uint16_t> without_script() const;
    // So many nodes are there and have told what they are.
    bool all_described(size_t count) const { return live_nodes().size() >= count; }
    RobotCounts counts() const;
    // A document has another text: marks and breakpoints follow.
    void script_changed(const std::string& file);
    // Breakpoints are as the project keeps them: sets them on the nodes.
    void place_breakpoints();
    // [Breakpoint] of the protocol.
    Json breakpoints_list() const;

    void tick(Time now);
    Time next_tick() const;

private:
    using Act = Result<debug::RequestId> (debug::Network::*)(debug::NodeId);
    using Ask = std::function<Result<debug::RequestId>(uint16_t)>;
    // What we know of a node beside debug::NodeView.
    struct Known {
        std::string loaded;  // the source that was loaded
        bool has_program = false;
        double loaded_wall = 0;
        std::string why;  // it stands
        std::string fault;
        std::string busy;
        bool lost_program = false;  // it came back without
        bool came_back = false;     // what it says of its state first tells whether without
        bool stopped = false;       // its next run begins anew
        uint64_t events = 0;
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
    void let_run(const std::vector<uint16_t>& nodes,
                 std::function<void(std::vector<std::string>)> done);
    void start_batch(const std::vector<uint16_t>& nodes, const Ask& ask,
                     std::function<void(Batch&)> finish, const char* busy);
    void finish_batches();
    Result<debug::RequestId> stop(uint16_t node);
    void note_stopped(const Batch& batch);
    std::vector<uint16_t> nodes_of(const Json& node) const;
    std::vector<uint16_t> live_nodes() const;
    std::vector<uint16_t> standing_nodes() const;
    bool is_stopped(uint16_t node) const {
        const auto known = known_.find(node);
        return known != known_.end() && known->second.stopped;
    }
    void act_on(const std::vector<uint16_t>& nodes, Act what, const char* busy,
                std::function<void(std::vector<std::string>)> done);
    void load(const std::vector<uint16_t>& nodes, bool run, std::function<void(Batch&)> finish);
    void set_variable(const Call& call);
    void set_breakpoint(const Call& call);

    void hear(const debug::Event& event);
    void hear(const debug::Event& event, const debug::NodeDescribed& described);
    void hear(const debug::Event& event, const debug::StateChanged& state);
    void hear(const debug::Event& event, const debug::Fault& fault);
    void hear(const debug::Event& event, const debug::BreakpointHit& hit);
    void hear(const debug::Event& event, const debug::UserEvent& sent);
    void count_dropped(uint16_t from, uint16_t event);
    void hear(const debug::RequestDone& done);
    void hear(const debug::Event& event, const debug::VariableChanged& changed);
    void hear_place(const debug::Event& event, const debug::BreakpointResult& result);
    void happen(const char* kind, uint16_t node, const std::string& name, const std::string& text,
                const std::vector<int16_t>& args = {});
    void watch_what_is_shown();
    void tell_unwatched(uint16_t node, const debug::NodeView& view, const std::string& name);
    static std::map<std::string, std::pair<uint32_t, uint32_t>> variables_of(
        const debug::NodeView& view);
    void count_rates(Time now);
    double time() const { return heard_t_ ? *heard_t_ : hints_.time(); }
    void restore(uint16_t node);
    ScriptBreakpoint* breakpoint_of(uint16_t node, int line);
    std::string doc_of(uint16_t node) const;
    std::string name_of(uint16_t node) const;

    Json robot_document() const;
    Json node_document(const Json& of) const;
    Json node_line(uint16_t id) const;
    Json network_document() const;

    Desk& desk_;
    Files& files_;
    Scripts& scripts_;
    ScriptBreakpoints& breakpoints_;
    RobotHints hints_;
    RobotTold told_;
    std::function<void(const std::string&, const std::string&)> say_ = [](auto&, auto&) {};
    std::function<void()> breakpoints_changed_ = [] {};

    Carrier* carrier_ = nullptr;
    std::string target_, name_, kind_ = "none";
    Connection connection_ = Connection::Connecting;
    std::unique_ptr<debug::Network> network_;
    Time now_{};
    std::optional<double> heard_t_;  // of the frame that is heard, by the clock of a simulation
    std::map<uint16_t, Known> known_;
    std::vector<std::unique_ptr<Batch>> batches_;

    // Values of watched variables as they were told last: by node and address.
    std::map<uint16_t, std::map<uint16_t, int16_t>> values_;
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
