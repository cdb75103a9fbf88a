// The studio without its door: the open project with its files, scripts and breakpoints, the robot
// and the run, and the commands that join them. One thread, told the time; the loop with the web
// server hands its events to the desk.
//
//     Workbench bench(links, desk, places);
//     bench.open("examples/follow-wall", links.now());
//     for (;;) {
//         for (const net::Event& event : links.poll(next)) bench.hear(event);
//         bench.tick(links.now());
//     }
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fleet/member.hpp"
#include "net/links.hpp"
#include "record/past_run.hpp"
#include "run/real_time_parts.hpp"
#include "serve/edit/editing.hpp"
#include "serve/json.hpp"
#include "serve/life/life.hpp"
#include "serve/project/files.hpp"
#include "serve/run/plan_breakpoints.hpp"
#include "serve/run/run.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"
#include "serve/target/breakpoints.hpp"
#include "serve/target/bus_carrier.hpp"
#include "serve/target/target.hpp"
#include "serve/workbench/compare_desk.hpp"
#include "serve/workbench/history_desk.hpp"
#include "serve/workbench/kept.hpp"
#include "serve/workbench/library.hpp"
#include "serve/workbench/log_desk.hpp"
#include "serve/workbench/opened.hpp"
#include "serve/workbench/pair_desk.hpp"
#include "serve/workbench/recordings.hpp"
#include "serve/workbench/run_ends.hpp"
#include "serve/workbench/scripts_recording.hpp"
#include "serve/workbench/targets.hpp"
#include "serve/workbench/test_desk.hpp"
#include "serve/workbench/try_desk.hpp"
#include "serve/workbench/turning_desk.hpp"
#include "serve/workbench/why_desk.hpp"
#include "serve/worker.hpp"

namespace vagus::serve {

constexpr Duration kWorldFollowsAfter = 150ms;  // the last edit of its file, before a run has begun
constexpr Duration kPictureEvery = 1s;          // the file of a ground is looked at
constexpr size_t kKeepsAtOnce = 1;              // runs that become tests
constexpr int kStepMs = 10;                     // of run.step, unless it says otherwise
constexpr const char* kTheServer = "the server";  // who asks where nobody else does

struct WorkbenchPlaces {
    LibraryPlaces library;
    std::string settings;         // file
    std::string program;          // vagus, for runners
    std::string home;             // where choosing a folder begins
    std::string target = {};      // of every project that is opened; empty: its own
    bool serves = false;          // one project on one target; pages offer no other
    StartRunProcess runner = {};  // of runs; empty: a process of `program`
    // How long this computer has slept so far.
    std::function<Duration()> slept = run::slept_by_clocks;
};

// What can be counted of a robot that works, since the server began.
struct Figures {
    uint64_t runs = 0, deaths = 0;  // started; processes that died
    bool plan_runs = false;
    double seconds = 0;        // the run's clock
    double speed = 0;          // of a simulation against the wall clock, measured
    uint64_t late_checks = 0;  // of supervisors, in this run
    TargetCounts target = {};
    std::optional<double> bus_load = {};  // 0 to 1
    size_t clients = 0;
    std::map<std::string, uint64_t> ends = {}, results = {};  // of runs: why; of their plans
    size_t missing_stops = 0;  // nodes that the last end did not read back as stopped
};

// What a run that continues from an instant of the one before takes on there.
struct Continues {
    double t = 0;
    Json set = Json::array();  // PlanSetting
};

class Workbench {
public:
    Workbench(net::Links& links, Desk& desk, const WorkbenchPlaces& places);
    ~Workbench();

    // Opens what a path names, in place of what is open, as soon as its robot has stopped; what is
    // unsaved there stays in its journal; `by` is who stops it. The Error says what can be opened.
    Status open(
        const std::string& path, Time now, std::function<void()> then = [] {},
        const std::string& by = kTheServer);
    // The newest copy of an example, or a fresh one.
    Status open_example(const std::string& id, Time now);
    // At once, the last act of a server; then it ticks on while processes of runs complete their
    // recordings.
    void close();
    bool runs_are_ending() const { return run_.closed_are_ending(); }

    void hear(const net::Event& event);
    void tick(Time now);
    Time next_tick(Time now) const;
    // ---- for a robot that works by itself ----
    const std::optional<OpenedProject>& project() const { return project_; }
    // Its files with changes that are not on disk.
    std::vector<std::string> unsaved() const { return files_.unsaved(); }
    // Nodes that the project's scripts are for and that have not told what they are, by their
    // names; on a bus only.
    std::vector<std::string> missing_nodes() const;
    // What run.start and stop do. `done` gets why it does not run, or nothing.
    void start_run(std::function<void(const std::string& why)> done);
    void stop_run(const life::Cause& cause, std::function<void()> done);
    // Also where no further event comes that would make the node tell of it.
    void look_for_endless_loops(bool looks) { target_.look_for_endless_loops(looks); }
    // What a node of that name is: the one that is there, or one that is known.
    aesl::Target target_of(const std::string& name, uint16_t id) const;
    // The same for another thread: of the nodes that are there now.
    Scripts::TargetOf targets_now() const;
    Figures figures() const;
    // Each line of the console, too.
    void on_line(std::function<void(const std::string& kind, const std::string& text)> line) {
        line_ = std::move(line);
    }
    // "its plan runs", "its plan is over: OK"; empty: it has none.
    std::string how_plan_is() const;
    // Somebody has pressed Stop.
    void on_stop(std::function<void()> stopped) { stopped_ = std::move(stopped); }
    // The process of the run has died.
    void on_death(std::function<void()> died) { died_ = std::move(died); }
    // A run has ended, however; once for each.
    void on_end(std::function<void(const life::End& end)> ended) { ended_ = std::move(ended); }
    // The last one: who ended it, how, and which nodes are at rest.
    std::string end_in_words() const { return ends_.sentence(); }

    // ---- for a robot of a fleet ----
    fleet::Shown shown() const;
    // Events that scripts emit, and variables as they change.
    void on_tells(std::vector<fleet::Tells> variables, TargetTells tells);
    // An event of the bus, from the fleet.
    Status emit(const std::string& event, const std::vector<int16_t>& args) {
        return target_.emit(event, args);
    }
    // The same, and the plan hears from whom it is.
    Status hear_of_fleet(const talk::HearOfFleet& event);
    // As which member plans ask the fleet, from the next run on; nothing: as none.
    void join_fleet(std::optional<talk::MemberOf> member, Run::ToldFleet told) {
        run_.join_fleet(std::move(member), std::move(told));
    }
    // Whether a node of that name has it; the Error names those that there are.
    Status find_variable(const std::string& node, const std::string& name) const {
        return target_.find_variable(node, name);
    }
    vagus::Result<plan::Value> plan_variable(const std::string& name) const {
        return run_.variable(name);
    }
    // What somebody of the fleet wants; `done` gets the answer, once.
    using Obeyed = std::function<void(fleet::Answer answer)>;
    void obey(const fleet::Command& command, Obeyed done);
    // Also what was to start later.
    void stop_for(const std::string& by);

    // Stop was pressed by the client with that number, or by nobody's page (0): what was asked for
    // before is not done after it.
    void somebody_stops(uint32_t member);
    // If anything runs, or was sent that can move a node: the plan ends, and all nodes stop. Until
    // that is over, or waited for no longer, is_stopping().
    void end_by(const std::string& by, life::Why why);
    bool is_stopping() const { return life_.is_stopping(); }

private:
    // ---- of_fleet.cpp ----
    void stop_and_report(const std::string& by, Obeyed done);
    void obey_start(const fleet::Command& command, Obeyed done);
    void write(const fleet::Command& command, Obeyed done);

    // ---- workbench.cpp: what is open ----
    void declare_topics();
    void declare_project_commands();
    void declare_kept_commands();
    Result<OpenedProject> project_at(const std::string& path) const;
    void leave_for(OpenedProject project, std::function<void()> then, const std::string& by);
    void enter(OpenedProject project);
    void forget_recording();
    void forget_project();
    void project_file_changed();
    void take_safe_stop();
    std::vector<std::string> toolboxes_on_disk() const;
    // A file of this computer as the project calls it, and back; as it is without a project.
    std::string doc_of(const std::string& file) const;
    std::string real(const std::string& doc) const;
    EditedProject edited_project() const;
    void watch_run();
    void keep_breakpoints();
    Result<std::string> add_script(uint16_t node);
    void add_missing_scripts();
    std::string with_short_paths(std::string text) const;
    void say(const std::string& kind, const std::string& text);
    double clock() const;
    Json studio_document() const;
    Result<std::string> project_made_for(const std::string& doc) const;
    Json list_folder(const std::string& path) const;

    // ---- plan_debugging.cpp: breakpoints of plans, events by hand ----
    void declare_debug_commands();
    void declare_held_commands();
    Status is_in_plan(const PlanBreakpoint& wanted);
    void set_plan_breakpoint(const Call& call);
    void plan_breakpoints_changed();
    std::vector<talk::BreakpointOrder> plan_breakpoint_orders() const;
    Json handlers_of(const std::vector<std::string>& events);
    void step_into_script(const Call& call);

    // ---- recording.cpp: what the history and the recording are told ----
    void record_history();
    void record_happened(Happened happened);
    void record_run(RunOrder& order);
    void continue_from(const Call& call);
    void continue_run(const Call& call, const std::string& recording);
    void record_script(uint16_t node, const std::string& name);
    ShownRun shown_run();
    bool run_has_begun() const;
    Result<std::string> recording_of_run() const;
    Result<std::string> recording_at(const std::string& path) const;
    Result<std::string> asked_recording(const std::string& path) const;
    void begin_past(const Call& call, RunOrder order, bool go);
    void list_recordings(const Call& call);
    void open_recording(const Call& call);
    static void not_again(const Call& call, const std::string& why);
    void relive(const Call& call, const std::string& recording, const record::PastRun& past);
    QuestionRules keep_rules() const;
    void keep_test(const Call& call);
    Result<std::string> new_test(const std::string& main, const std::string& text);
    void record_plan(const RunOrder& order);
    void record_bus();
    void record_scripts();
    void end_scripts_recording();

    // ---- running.cpp: what people ask of a run ----
    void declare_run_commands();
    void declare_plan_commands();
    void declare_world_commands();
    void leave(const life::Cause& cause, std::function<void()> then);
    void choose_target(const Call& call);
    const char* no_world() const;
    Status join_target(const std::string& target);
    bool simulates() const { return run_.has_world(); }
    RunOrder order_of(const std::string& plan, const Json& set) const;
    bool world_has_changed() const;
    void world_saved(const std::string& path);
    void world_edited(const std::string& path);
    bool is_being_opened() const;
    void follow_world_text();
    void note_opened_world(const std::string& text);
    void look_at_picture();
    void touch_world();
    void file_saved(const std::string& path);
    void change_plan();
    void check_change(const Call& call);
    void start(const Call& call);
    void start_with(const Call& call, const std::string& plan, life::Start start);
    void reset(const Call& call);
    void step(const Call& call);
    void stop(const Call& call, life::Cause cause);
    bool save_all(const Call& call);
    void people_changed();

    // ---- living.cpp: the wires of its life ----
    life::CallNumber keep(const Call& call);
    std::string who_asks(const Call& call) const;
    void tell_life(life::Input input);
    void live();
    void tick_life();
    void watch_stop();
    void watch_sleep();
    void hear_run();
    Status open_plan(RunOrder order);
    Status open_world(RunOrder order, bool keep_poses);
    std::set<uint16_t> stop_events() const;
    void perform(const life::Action& action);
    void perform(const life::OpenRunner& open);
    void perform(const life::ConnectWorld&);
    void take_changes(const Continues& continues);
    void perform(const life::BeginScripts&);
    void perform(const life::LoadNodes& load);
    void perform(const life::LetNodesGo& go);
    void perform(const life::BeginRun&);
    void perform(const life::ContinueRun&);
    void perform(const life::StepPlan&);
    void perform(const life::PauseRun&);
    void perform(const life::RestRun&);
    void perform(const life::PauseNodes& pause);
    void perform(const life::CountStart&);
    void perform(const life::EndPlan& end);
    void perform(const life::StopNodes& stop);
    void perform(const life::MakeSafe& safe);
    void perform(const life::EndRunner& end);
    void perform(const life::Disconnect&);
    void perform(const life::GoOnLeaving& leaving);
    void perform(const life::Answer& answer);
    void perform(const life::AnswerStop& answer);
    void perform(const life::Tell& told);

    net::Links& links_;
    Desk& desk_;
    WorkbenchPlaces places_;
    Library library_;
    DiskSync kept_on_disk_;
    Kept settings_;
    Kept state_;  // of the project

    Files files_;
    Scripts scripts_;
    ScriptBreakpoints breakpoints_;
    PlanBreakpoints plan_breakpoints_;
    Editing editing_;
    Target target_;
    Run run_;
    Worker worker_;
    HistoryDesk history_;
    Recordings recordings_;
    std::map<std::string, RunOrder> recorded_;  // of the last two runs, by recording
    std::optional<Continues> continues_;        // the run that is being opened
    ScriptsRecording scripts_recording_{[this](const auto& warning) { say("warning", warning); }};
    bool scripts_run_ = false;  // on a bus, without a plan
    WhyDesk whys_;
    TurningDesk turnings_;
    LogDesk logs_;
    PairDesk pairs_;
    RunQuestions keeps_;  // runs that become tests
    CompareDesk compares_;
    TryDesk tries_;
    TestDesk tests_;
    std::unique_ptr<BusCarrier> bus_;
    std::optional<Time> bus_since_;  // nothing: what is to run there has not begun
    Targets targets_;

    std::function<void(const std::string&, const std::string&)> line_ = [](auto&, auto&) {};
    std::function<void()> stopped_ = [] {};
    std::function<void()> died_ = [] {};
    std::function<void(const life::End&)> ended_ = [](const life::End&) {};

    std::optional<OpenedProject> project_;
    Time now_{};
    uint64_t runs_ = 0;
    uint64_t stops_ = 0;                              // that somebody has pressed
    std::string failed_loads_;                        // of the start under way
    std::pair<int, uint64_t> watched_run_ = {-1, 0};  // descriptor, generation
    Life life_;
    run::SleepWatch sleep_;
    std::deque<life::Input> told_life_;  // not taken yet
    bool lives_ = false;                 // it is at work
    bool send_at_once_ = false;
    life::CallNumber calls_ = 0;
    std::map<life::CallNumber, Call> waiting_;  // commands that it answers
    std::map<life::CallNumber, RunOrder> orders_;
    std::map<life::CallNumber, Json> results_;                   // of those that give one
    std::map<life::CallNumber, std::function<void()>> leaving_;  // what is done then
    RunEnds ends_;
    uint64_t stop_number_ = 0;  // of the latest
    size_t people_ = 0;
    std::vector<std::string> saved_plans_;              // the run is not told of them yet
    std::string opened_world_;                          // text of the world that is there
    std::string picture_, picture_then_, picture_now_;  // on its ground: path, states of the file
    Time next_picture_look_{};
    bool world_touched_ = false;                       // a hand has changed it since
    bool run_is_over_ = false;                         // and no other one has begun in its world
    bool placed_by_hand_ = false;                      // meanwhile, or before the first run
    std::optional<Time> world_edited_;                 // its file; not followed yet
    std::map<uint16_t, std::string> loaded_by_world_;  // source by node
};

}  // namespace vagus::serve
