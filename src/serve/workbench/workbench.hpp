// The studio without its door: the open project with its files, scripts and breakpoints, the robot
// and the run, and the commands that join them. One thread, told the time; whoever has the web
// server hands its events to the desk.
//
//     Workbench bench(network, desk, places);
//     bench.open("examples/follow-wall", network.now());
//     for (;;) {
//         for (const net::Event& event : network.poll(next)) bench.hear(event);
//         bench.tick(network.now());
//     }
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/network.hpp"
#include "serve/edit/editing.hpp"
#include "serve/project/files.hpp"
#include "serve/robot/breakpoints.hpp"
#include "serve/robot/bus_carrier.hpp"
#include "serve/robot/robot.hpp"
#include "serve/run/plan_breakpoints.hpp"
#include "serve/run/run.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"
#include "serve/workbench/history_desk.hpp"
#include "serve/workbench/kept.hpp"
#include "serve/workbench/library.hpp"
#include "serve/workbench/opened.hpp"
#include "serve/workbench/targets.hpp"

namespace vagus::serve {

// A run waits so long for the nodes of its world to describe themselves.
constexpr Duration kDescribeWithin = 3s;
constexpr Duration kIntoWithin = 1s;  // nodes get breakpoints; then a plan goes on without the rest
constexpr int kStepMs = 10;           // of run.step, unless it says otherwise

struct WorkbenchPlaces {
    LibraryPlaces library;
    std::string settings;     // file
    std::string program;      // vagus, for run hosts
    std::string home;         // where choosing a folder begins
    std::string target = {};  // of every project that is opened; empty: its own
    bool serves = false;      // one project on one target; pages offer no other
};

// What can be counted of a robot that works, since the server began.
struct Figures {
    uint64_t runs = 0, deaths = 0;  // started; processes that died
    bool plan_runs = false;
    double seconds = 0;        // the run's clock
    double speed = 0;          // of a simulation against the wall clock, measured
    uint64_t late_checks = 0;  // of supervisors, in this run
    RobotCounts robot = {};
    std::optional<double> bus_load = {};  // 0 to 1
    size_t clients = 0;
};

class Workbench {
public:
    using Json = nlohmann::json;
    Workbench(net::Network& network, Desk& desk, const WorkbenchPlaces& places);
    ~Workbench();

    // Opens what a path names, in place of what is open; what is unsaved there stays in its
    // journal. The Error says what can be opened.
    Status open(const std::string& path, Time now);
    // The newest copy of an example, or a fresh one.
    Status open_example(const std::string& id, Time now);
    void close();

    void hear(const net::Event& event);
    void tick(Time now);
    Time next_tick(Time now) const;
    // ---- for a robot that works by itself ----
    const std::optional<OpenedProject>& project() const { return project_; }
    // Nodes that the project's scripts are for and that have not told what they are, by their
    // names; on a bus only.
    std::vector<std::string> missing_nodes() const;
    // What run.start and stop do. `done` gets why it does not run, or nothing.
    void start_run(std::function<void(const std::string& why)> done);
    void stop_run(std::function<void()> done);
    // What a node of that name is: the one that is there, or one that is known.
    aesl::Target target_of(const std::string& name, uint16_t id) const;
    Figures figures() const;
    // Each line of the console, too.
    void on_line(std::function<void(const std::string& kind, const std::string& text)> line) {
        line_ = std::move(line);
    }
    // Somebody has pressed Stop.
    void on_stop(std::function<void()> stopped) { stopped_ = std::move(stopped); }
    // The process of the run has died.
    void on_death(std::function<void()> died) { run_.on_death(std::move(died)); }

    // The nodes stand and the plan has ended, as far as a dying server can: its last act.
    void stop_everything();

private:
    // ---- workbench.cpp: what is open ----
    void declare_topics();
    void declare_project_commands();
    void declare_kept_commands();
    void enter(OpenedProject project);
    void project_file_changed();
    EditedProject edited_project() const;
    void watch_run();
    void keep_breakpoints();
    Result<std::string> add_script(uint16_t node);
    void add_missing_scripts();
    std::string with_short_paths(std::string text) const;
    void say(const std::string& kind, const std::string& text);
    double clock() const;
    Json studio_document() const;
    Json list_folder(const std::string& path) const;

    // ---- plan_debugging.cpp: breakpoints of plans, events by hand ----
    void declare_debug_commands();
    void declare_held_commands();
    void set_plan_breakpoint(const Call& call);
    void plan_breakpoints_changed();
    Json plan_breakpoint_orders() const;
    Json handlers_of(const std::vector<std::string>& events);
    void step_into_script(const Call& call);
    void go_into_script();

    // ---- recording.cpp: what the history is told ----
    void record_history();
    void record_plan(const RunOrder& order);
    void record_bus(const std::string& plan);
    double history_clock() const;

    // ---- running.cpp: what runs ----
    void declare_run_commands();
    void declare_plan_commands();
    void declare_world_commands();
    Status choose_target(const std::string& target);
    void leave_target();
    bool simulates() const { return run_.has_world(); }
    // Opens the world, and the plan if there is one to run; it stands until its nodes are ready.
    Status open_world(const std::string& plan, const Json& set, bool keep_poses, bool then_go);
    RunOrder order_of(const std::string& plan, const Json& set) const;
    Status open_order(RunOrder order, bool keep_poses, bool then_go);
    bool world_has_changed() const;
    void reopen_world();
    void world_saved(const std::string& path);
    void file_saved(const std::string& path);
    void change_plan();
    void check_change(const Call& call);
    void world_opened();
    void world_failed(const std::string& why);
    void start(const Call& call);
    // `call` may say with which values, and from which actor.
    void start_plan(const Call& call, const std::string& plan, bool go);
    void start_plan_on_bus(const Call& call, RunOrder order, bool go);
    void plan_joined_bus();
    void plan_died();
    void go_on(const Call& call);
    void let_go(const Call& call);
    void start_scripts(const Call& call);
    void end_start();
    void tell_failed_loads(const std::vector<std::string>& failed);
    void give_up_start(const std::string& why);
    void step(const Call& call);
    void stop(const Call& call);
    void stop_nodes();
    void rest();
    bool save_all(const Call& call);
    void get_nodes_ready();

    net::Network& network_;
    Desk& desk_;
    WorkbenchPlaces places_;
    Library library_;
    Kept settings_;
    Kept state_;  // of the project

    Files files_;
    Scripts scripts_;
    ScriptBreakpoints breakpoints_;
    PlanBreakpoints plan_breakpoints_;
    Editing editing_;
    Robot robot_;
    Run run_;
    HistoryDesk history_;
    Time history_since_{};  // of a bus
    std::unique_ptr<BusCarrier> bus_;
    Time bus_since_{};
    Targets targets_;

    std::function<void(const std::string&, const std::string&)> line_ = [](auto&, auto&) {};
    std::function<void()> stopped_ = [] {};

    std::optional<OpenedProject> project_;
    Time now_{};
    uint64_t runs_ = 0;
    std::string failed_loads_;                        // of the start under way
    std::pair<int, uint64_t> watched_run_ = {-1, 0};  // descriptor, generation
    // A world that opens, or a plan on a bus: what is done once its nodes are there.
    struct Opening {
        Time until{};
        bool opened = false;
        bool go = false;
    };
    std::optional<Opening> opening_;
    std::optional<Call> opening_call_;  // answered then
    // Counts what makes a start void: another one, Stop, another target. What was begun for it and
    // finds another number lets nothing run any more.
    uint64_t start_ = 0;
    uint64_t begun_ = 0;  // its value at the latest start that was carried out
    uint64_t stops_ = 0;  // nodes that came to a breakpoint
    // The plan goes on once the nodes have the breakpoints of a step into a script.
    struct Into {
        Call call;
        Json spots;
        Time until{};
    };
    std::optional<Into> into_;
    // Stop, under way.
    std::optional<Time> nodes_stop_at_;
    std::vector<Call> stop_calls_;
    std::optional<Time> rest_at_;
    std::vector<std::string> saved_plans_;             // the run is not told of them yet
    std::string opened_world_;                         // text of the world that stands there
    std::map<uint16_t, std::string> loaded_by_world_;  // source by node
};

}  // namespace vagus::serve
