// The runner as the server holds it: starts it, speaks with it, carries the frames of its bus,
// keeps what it told last for pages, and says what happened when it dies or hangs.
//
//     Run run(desk, start_runner("/usr/bin/vagus"));
//     run.open({.world = "hall.world.json", .plan = "WallFollow.plan.json"}, now);
//     robot.connect(run, "sim", "Simulator", "simulator", now);
//     run.tick(now);
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plan/value.hpp"
#include "serve/json.hpp"
#include "serve/process.hpp"
#include "serve/run/flows.hpp"
#include "serve/run/hand_order.hpp"
#include "serve/studio/desk.hpp"
#include "serve/talk/codec.hpp"
#include "serve/target/carrier.hpp"

namespace vagus::serve {

constexpr Duration kHangingAfter = 2s;  // without a word: shown, with a button that ends it
constexpr Duration kSilentAfter = 300ms;
constexpr Duration kClockAgainAfter = 1s;   // of a clock that says nothing new
constexpr Duration kClosedEndsWithin = 1s;  // by itself; then it is killed
constexpr size_t kClosedMax = 8;            // that end at a time; the oldest is killed
constexpr size_t kHandsKept = 10'000;       // orders of hands that a world can get again

struct RunOrder {
    std::string world;                      // paths of this computer
    std::optional<std::string> world_text;  // without a plan: what its editor has, saved or not
    std::string plan;                       // empty: the world alone
    std::vector<std::string> toolboxes;
    nlohmann::json set = nlohmann::json::object();
    std::string from;  // the actor that the plan begins with; empty: its start
    std::vector<talk::BreakpointOrder> breakpoints;  // as PlanBreakpoints::orders()
    std::string robot;
    std::string bus, project;          // the plan on a bus instead of in a world: target and .aesl
    std::string target;                // that bus, as a person names it
    std::string recording;             // file that it is recorded in; empty: none
    std::optional<talk::PastOf> past;  // it continues from there
    nlohmann::json set_then = nlohmann::json::array();  // PlanSetting: of its plan, there
    bool keep_poses = false;                            // robots are at rest where they were before
    bool keep_objects = false;  // what hands did to objects of this world is done again
    bool paused = true;         // at first
};

// The process of a run, as it is held: a child, or what a test makes of it.
class RunProcess {
public:
    virtual ~RunProcess() = default;  // ends it, at once
    virtual Pipe& pipe() = 0;
    virtual std::optional<ChildEnd> ended() = 0;
    virtual void kill() = 0;
};
using StartRunProcess = std::function<Result<std::unique_ptr<RunProcess>>()>;
// A child that runs a verb of `program`.
StartRunProcess start_runner(std::string program, std::string verb = "run-host",
                             size_t memory_max = kRunMemoryMax);

class Run final : public Carrier {
public:
    enum class State { None, Running, Paused, Hanging, Dead };

    // Declares the topics clock, plan, held, scene, poses, rays, picture.
    Run(Desk& desk, StartRunProcess start);

    void on_say(std::function<void(const std::string& kind, const std::string& text)> say) {
        say_ = std::move(say);
    }
    // The document of a file of this computer, for pages.
    void set_doc_of(std::function<std::string(const std::string& file)> doc_of) {
        doc_of_ = std::move(doc_of);
    }
    // A sentence with paths of this computer, for pages.
    void set_short(std::function<std::string(const std::string& text)> shorten) {
        short_ = std::move(shorten);
    }
    // The world is open and its nodes can be talked to.
    void on_opened(std::function<void()> opened) { opened_ = std::move(opened); }
    // It cannot be opened: a sentence, or several lines of the checker.
    void on_failed(std::function<void(const std::string& why)> failed) {
        failed_ = std::move(failed);
    }
    // What the debugger of the plan says of its breakpoints.
    using BreakpointsNow = std::vector<talk::BreakpointNow>;
    void on_breakpoints(std::function<void(const BreakpointsNow& list)> told) {
        breakpoints_told_ = std::move(told);
    }
    // What it tells for the history: which plan runs from now on, once for each version; a line of
    // the trace; records of the world; what happened on its bus while its past was run again; what
    // a camera saw.
    struct Told {
        std::function<void(const talk::PlanVersion& version)> plan = [](auto&) {};
        std::function<void(const std::string& line)> trace = [](auto&) {};
        std::function<void(const std::string& bytes)> records = [](auto&) {};
        std::function<void(const Happened& happened)> happened = [](auto&) {};
        std::function<void(const talk::PictureThen& picture)> picture = [](auto&) {};
    };
    void on_told(Told told) { told_ = std::move(told); }
    // Its process has died, whatever ran in it: a sentence.
    void on_death(std::function<void(const std::string& why)> died) { died_ = std::move(died); }
    // The plan has ended by itself or as it was told; not for one whose process died.
    struct PlanEnd {
        std::string result;   // OK, Interrupted, Error
        std::string message;  // of an Error
    };
    void on_plan_ended(std::function<void(const PlanEnd& end)> ended) {
        plan_ended_ = std::move(ended);
    }

    Status open(const RunOrder& order, Time now);
    // Nothing of it is heard or told from here on. Its process ends its plan, completes its
    // recording and ends: within kClosedEndsWithin of ticks, or it is killed.
    void close();
    bool closed_are_ending() const { return !closed_.empty(); }
    bool is_open() const { return child_ != nullptr; }
    // A simulated world is open and can be talked to.
    bool has_world() const { return has_world_ && is_open(); }
    State state() const { return state_; }
    // To be watched for reading; -1 without a runner. Another runner may have the same number:
    // generation() tells them apart.
    int descriptor();
    uint64_t generation() const { return generation_; }

    void pace(bool paused, double speed);
    void pause() { pace(true, speed_); }
    void go_on() { pace(false, speed_); }
    void step(int milliseconds);
    void set_speed(double speed) { pace(paused_, speed); }
    // The clock is paused, and nobody waits for it to continue: before the start, after Stop.
    void rest();
    // Ends the process, as for one that hangs.
    void kill();
    // Ends the process at once, without a word to on_death(): "the run " + why.
    void give_up(const std::string& what);
    double speed() const { return speed_; }
    bool paused() const { return paused_; }
    bool rests() const { return rests_; }
    // The first start of a run: it goes on, unless its plan has come to a breakpoint already, at
    // the instant 0, while its nodes were made ready.
    void begin();
    bool plan_runs() const;
    // What a file of the plan that runs says, by its document; nothing: it is not made of it.
    std::optional<std::string> plan_text(const std::string& doc) const;
    // What the plan that runs does now: its innermost actor; empty without one.
    std::string actor() const;
    // What a variable of the plan that runs, the outermost, holds. The Error says why nobody knows.
    vagus::Result<plan::Value> variable(const std::string& name) const;
    // The plan that runs waits for an event of that name.
    bool plan_hears(const std::string& event) const {
        return plan_runs() && hears_.contains(event);
    }
    // Events by which the plan on a bus ends its work on nodes.
    const std::set<std::string>& stop_events() const { return stops_work_; }
    // It has not said a word for longer than one that works would.
    bool is_silent() const { return is_open() && now_ > heard_ + kSilentAfter; }
    // ---- the plan ----
    void step_plan();  // to the next actor that begins
    void stop_plan();
    void set_breakpoints(const std::vector<talk::BreakpointOrder>& list);
    // A hand from above: `done` gets the number of an object that was put, or why it was not done.
    // What it did to objects is done again where an order keeps them: their numbers stay.
    using HandDone = std::function<void(std::optional<uint32_t> number, const std::string& why)>;
    void lend_hand(HandOrder order, HandDone done);
    // Somebody debugs these nodes, and no others: the plan on a bus waits for them. It is told what
    // is news.
    void hold_nodes(std::vector<uint16_t> nodes);
    // Writes a variable of the plan; `done` gets why not, or nothing.
    using SetDone = std::function<void(const std::string& why)>;
    void set_variable(int level, const std::string& name, const Json& value, SetDone done);
    // Raises an event of a supervisor that watches, as if it had done so itself.
    void raise(const std::string& supervisor, const std::string& event, const Json& outputs,
               SetDone done);
    // As which member of a fleet its plans ask, from the next one on; nothing: as none. `told`:
    // variables that they tell.
    using ToldFleet = std::function<void(const talk::ToldFleet& told)>;
    void join_fleet(std::optional<talk::MemberOf> member, ToldFleet told) {
        member_ = std::move(member);
        told_fleet_ = std::move(told);
    }
    void hear_of_fleet(const talk::HearOfFleet& event);
    // Of the events that wait while the plan is paused.
    void handle_held(talk::HeldAct act, std::optional<uint64_t> number, SetDone done);

    // Plan files have been saved: what the plan that runs is made of is to take over (P31). What
    // came of it is in the document of the plan, and is said.
    void change_plan(const std::vector<std::string>& files);
    // Whether it could take over now, if files had these texts: `done` gets what is in its way,
    // or nothing if the plan that runs is not made of them.
    using Reasons = std::optional<std::vector<std::string>>;
    void check_change(const std::map<std::string, std::string>& texts,
                      std::function<void(const Reasons& reasons)> done);

    // ---- its recording ----
    // A node was loaded with the script that this file of this computer holds for it.
    void script_loaded(uint16_t node, const std::string& file, const std::string& text);
    // `done` is told when all that has been recorded by now is in the file.
    void flush_recording(std::function<void()> done);

    double time() const { return t_; }
    std::optional<double> load() const { return load_; }
    double measured_speed() const { return real_; }
    uint64_t deaths() const { return deaths_; }  // of runners
    // Checks of supervisors that began late, in this run.
    uint64_t late_checks() const { return late_checks_; }
    std::string robot_of(uint16_t node) const;
    size_t node_count() const;
    // Files that are others now than in the past of this run.
    const std::vector<std::string>& changed_since() const { return changed_since_; }
    // Sources that the world has loaded into nodes.
    const std::map<uint16_t, std::string>& programs() const { return programs_; }

    void tick(Time now);
    Time next_tick() const;

    // ---- Carrier ----
    void send(const wire::Frame& frame) override;
    std::vector<Carried> take() override { return std::exchange(frames_, {}); }
    uint64_t heard() const override { return frames_in_; }
    Connection connection() const override;
    std::string why() const override { return why_; }
    std::vector<LinkView> links() const override;

private:
    // ---- run.cpp: what it is told ----
    using Answered = std::function<void(const talk::Answer& answer)>;
    void tell(const talk::Order& order);
    template <typename Request>
    void ask(Request order, Answered answered);
    void forget_run();
    void let_end();
    void end_closed();
    void note_hand(const HandOrder& order);
    void keep_hands();
    talk::Open open_order(const RunOrder& order);
    const std::vector<talk::SceneRobot>& robots() const;
    void show_what_is_watched();
    Reasons reasons_in(const talk::Answer& answer) const;
    void keep_change(const std::vector<std::string>& files, const talk::Answer& answer);
    void forget_asked(const std::string& why);
    void forget_held();

    // ---- run_hearing.cpp: what it tells ----
    void hear_all();
    std::optional<std::string> hear_packets();
    bool counts(const talk::News& news) const;
    void hear(const talk::Alive&) {}
    void hear(const talk::Opening&) { opening_ = false; }
    void hear(talk::Opened& opened);
    void hear(const talk::OpenFailed& failure);
    void hear(const talk::PlanVersion& version);
    void hear(const talk::Traced& traced);
    void hear(talk::PlanNow& plan);
    void hear(talk::HeldNow& held);
    void hear(const talk::BreakpointsNow& now) { breakpoints_told_(now.list); }
    void hear(const talk::PlanOver&) { rest(); }
    void hear(const talk::Answer& answer);
    void hear(const talk::Line& line);
    void hear(const talk::Clock& clock);
    void hear(talk::SceneNow& scene);
    void hear(const talk::FrameSeen& seen);
    void hear(talk::Poses& poses) { flows_.show(std::move(poses)); }
    void hear(talk::Rays& rays) { flows_.show(std::move(rays)); }
    void hear(talk::Picture& picture) { flows_.show(std::move(picture)); }
    void hear(const talk::Records& records) { told_.records(records.bytes.bytes); }
    void hear(const talk::HappenedNow& happened);
    void hear(const talk::PictureThen& picture) { told_.picture(picture); }
    void hear(const talk::ToldFleet& told) {
        if (told_fleet_) told_fleet_(told);
    }
    void hear_end(const std::string& what);
    void be_over(const std::string& what);

    // ---- run_documents.cpp: what pages see of it ----
    void declare_topics();
    Json clock_document() const;
    Json plan_document() const;
    Json scene_document() const;

    Desk& desk_;
    const StartRunProcess start_;
    std::function<void(const std::string&, const std::string&)> say_ = [](auto&, auto&) {};
    std::function<std::string(const std::string&)> doc_of_ = [](const std::string& f) { return f; };
    std::function<std::string(const std::string&)> short_ = [](const std::string& t) { return t; };
    std::function<void()> opened_ = [] {};
    std::function<void(const std::string&)> failed_ = [](const std::string&) {};
    std::function<void(const std::string&)> died_ = [](const std::string&) {};
    std::function<void(const PlanEnd&)> plan_ended_ = [](const PlanEnd&) {};
    std::function<void(const BreakpointsNow&)> breakpoints_told_ = [](const auto&) {};
    Told told_;
    std::optional<talk::MemberOf> member_;
    ToldFleet told_fleet_;
    uint64_t asked_ = 0;
    std::map<uint64_t, Answered> answers_;  // of the runner, by number of what was asked
    std::map<uint16_t, std::string> programs_;
    std::vector<std::string> changed_since_;
    std::vector<HandOrder> by_hand_;       // what was done to objects of this world, in its order
    std::vector<HandOrder> by_hand_next_;  // what is to be done to those of the one that is opened
    std::set<std::string> hears_;          // events, by the plan
    std::set<std::string> stops_work_;
    std::vector<uint16_t> held_nodes_;  // as it was told
    uint64_t generation_ = 0;
    uint64_t orders_ = 0;
    uint64_t opened_order_ = 0;  // that opened the world whose objects are there
    bool opening_ = false;       // what the runner tells is still of the order before
    bool keeps_objects_ = false;
    bool rests_ = true;
    uint64_t deaths_ = 0, late_checks_ = 0;

    struct Closed {
        std::unique_ptr<RunProcess> process;
        std::optional<Time> until;  // set by the first tick
    };
    std::vector<Closed> closed_;
    std::unique_ptr<RunProcess> child_;
    State state_ = State::None;
    std::string why_;
    std::vector<Carried> frames_;
    uint64_t frames_in_ = 0, frames_out_ = 0;
    bool has_world_ = false;
    std::optional<talk::Scene> scene_;               // as it was told last
    std::optional<talk::PlanNow> plan_;              // the same; none: no plan has run in this run
    Json held_;                                      // events that wait while the plan is paused
    std::map<std::string, std::string> plan_texts_;  // of the version that runs, by document
    Json change_;  // what came of the last save while the plan ran; null: none
    uint64_t changes_ = 0;
    std::string last_actor_;  // that began
    double t_ = 0, real_ = 0, speed_ = 1;
    bool paused_ = true;
    std::optional<double> load_;
    Time heard_{};
    Time now_{};
    Time clock_told_{};
    std::optional<talk::Show> shown_;  // none: it was not told yet
    Flows flows_;
};

}  // namespace vagus::serve
