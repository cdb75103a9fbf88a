// The life of a run as a value: what is opened, loaded, let go, paused, stopped and closed, and
// who is answered when. No nodes, no processes, no clock: it takes what happens and the time, and
// gives what is to be done, in this order.
//
//     Life life;
//     for (const life::Action& action : life.take(life::Stop{call, {"Ann"}}, now)) perform(action);
//     for (const life::Action& action : life.tick(now, silent)) perform(action);
//
// Each command with a number is answered exactly once, by Answer, AnswerStop or GoOnLeaving. After
// Stop nothing is let go until somebody asks for it. What was opened is closed by Disconnect.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "base/time.hpp"
#include "serve/life/orders.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kDescribeWithin = 3s;     // nodes of a world; then it is loaded without the rest
constexpr Duration kIntoWithin = 1s;         // nodes get breakpoints; then a plan goes on without
constexpr Duration kPlanEndsWithin = 300ms;  // in a world; its nodes are stopped behind it
constexpr Duration kReportWithin = 1500ms;   // for what becomes of the nodes; then it is answered
constexpr Duration kRollOut = 500ms;         // a world goes on so long after Stop
constexpr Duration kResultWithin = 3s;       // of a plan that was told to end
constexpr Duration kRestReportWithin = 1s;   // of nodes behind a plan that has ended
constexpr Duration kRunWaitsMax = 3s;        // Run waits no longer behind a stop
// The process of a run opens a world within the first, a plan on a bus within the second since its
// last word: a robot must not begin to drive long after Run.
constexpr Duration kOpenWithin = 30s;
constexpr Duration kOpenSilentMax = 3s;
// The past of a run is lived again first, while its process says that it is there.
constexpr Duration kReliveWithin = 10min;

class Life {
public:
    enum class State {
        None,
        Opening,
        Loading,
        Ready,
        Running,
        Paused,
        Stopping,
        ComingToRest,
        Dead
    };

    life::Actions take(const life::Input& input, Time now);
    // `silent`: the process of the run does not say a word.
    life::Actions tick(Time now, bool silent);
    Time next_tick() const;

    State state() const { return state_; }
    // Something runs, or is about to.
    bool is_live() const;
    // A world or a plan is being opened for somebody who waits.
    bool is_starting() const { return starting_.has_value(); }
    // Nodes of a world are to say what they are, or get breakpoints for a step into a script:
    // Described and BreakpointsSet are waited for.
    bool waits_for_nodes() const {
        return into_ || (starting_ && starting_->phase == Phase::Describing);
    }
    bool is_stopping() const { return stopping_.has_value(); }
    // A plan was let go, and has not ended.
    bool plan_runs() const { return plan_ == Plan::Runs; }

private:
    enum class Target { None, World, Bus };
    enum class Plan { None, Paused, Runs, Ending };
    enum class What { World, Plan, Scripts, GoOn };
    enum class Phase { Opening, Describing, Loading, Going };
    struct Starting {
        uint64_t number = 0;
        What what = What::World;
        Phase phase = Phase::Opening;
        bool go = false;
        bool relives = false;
        std::vector<life::CallNumber> calls = {};
        Time until{};  // of Describing
    };
    struct Stopping {
        uint64_t number = 0;
        std::vector<life::CallNumber> calls = {};
        bool asked = false;  // the nodes were told
        Time until{};
    };
    // An end that is not told yet: the plan's result is still to come.
    struct Untold {
        life::End end;
        Time until{};
        bool rests = false;  // its nodes are made safe, and read
    };

    void on(const life::Joined& joined);
    void on(const life::Open& open);
    void on(const life::Start& start);
    void on(const life::Opened& opened);
    void on(const life::Failed& failed);
    void on(const life::Described& described);
    void on(const life::Loaded& loaded);
    void on(const life::Went& went);
    void on(const life::Halted& halted);
    void on(const life::Pause& pause);
    void on(const life::NodesPaused& paused);
    void on(const life::HoldPlan& hold);
    void on(const life::ContinuePlan& go_on);
    void on(const life::EndThePlan& end);
    void on(const life::StepInto& into);
    void on(const life::BreakpointsSet& set);
    void on(const life::PlanEnded& ended);
    void on(const life::Died& died);
    void on(const life::Stop& stop);
    void on(const life::Stopped& stopped);
    void on(const life::Leave& leave);

    void act(life::Action action) { actions_.push_back(std::move(action)); }
    void done(life::CallNumber call);
    void refuse(life::CallNumber call, const char* code, const std::string& why);

    void begin(What what, Phase phase, bool go, life::CallNumber call);
    void open_runner(life::OpenRunner::What what);
    void open_world(const life::Open& open);
    void reopen_world();
    void start_now(const life::Start& start);
    bool waits_its_turn(const life::Start& start);
    bool joins(const life::Start& start, bool goes_on) const;
    void opened_on_bus();
    void load(bool fresh);
    void nodes_have_scripts();
    void world_is_ready();
    void nodes_go();
    void finish_start(State state);
    void give_up(const std::string& why);
    void go_into();

    void begin_stop(const life::Cause& cause, std::string result, std::string message);
    void ask_nodes();
    void finish_stop(const StopReport& report);
    void finish_stop_unseen();
    void tell_end();
    void tell_replaced(const std::string& by);
    void tell_end_by_itself(const life::Cause& cause, const life::PlanEnded& ended);
    void after_stop();
    void start_next();
    bool plan_is_ending() const;
    void watch_opening(bool silent);
    bool needs_rest(const life::Start& start) const;
    void leave_now();
    void come_to_rest(bool silent);

    life::Actions actions_;
    Time now_{};
    State state_ = State::None;
    Target target_ = Target::None;
    Plan plan_ = Plan::None;
    bool world_open_ = false;
    bool known_ = false;        // what the nodes of a bus do: we stopped them, or let them run
    bool halted_ = false;       // a node came to a breakpoint while nodes were let go
    std::string plan_stop_by_;  // who told the plan alone to end
    std::optional<life::OpenRunner::What> runner_opens_;
    Time open_until_{}, word_until_{};  // of that
    std::optional<Starting> starting_;
    std::optional<Stopping> stopping_;
    std::optional<Untold> untold_;
    life::End told_;  // the last one
    Time rest_until_{};
    std::optional<life::Start> next_;  // waits until the stop under way is over
    Time next_until_{};
    std::vector<life::Leave> leaves_;       // wait for it, too
    std::optional<life::CallNumber> into_;  // a step into a script
    Time into_until_{};
    std::set<life::CallNumber> pauses_;
    uint64_t starts_ = 0, ends_ = 0;
    uint64_t last_stop_ = 0;  // that is over; its nodes may still answer
};

}  // namespace vagus::serve
