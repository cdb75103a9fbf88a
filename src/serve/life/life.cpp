#include "serve/life/life.hpp"

#include <algorithm>
#include <utility>

namespace vagus::serve {

using namespace life;

namespace {

constexpr const char* kBeingStarted = "the run is just being started";
constexpr const char* kReplaced = "the world was opened again meanwhile";

}  // namespace

namespace life {

const char* name_of(Why why) {
    switch (why) {
        case Why::Stop:
            return "stop";
        case Why::Plan:
            return "plan";
        case Why::Error:
            return "error";
        case Why::Died:
            return "died";
        case Why::Signal:
            return "signal";
        case Why::Target:
            return "target";
        case Why::Project:
            return "project";
        case Why::Version:
            return "version";
        case Why::Alone:
            return "alone";
        case Why::Slept:
            return "slept";
        case Why::Before:
            break;
    }
    return "before";
}

}  // namespace life

Actions Life::take(const Input& input, Time now) {
    now_ = now;
    std::visit([this](const auto& one) { on(one); }, input);
    return std::exchange(actions_, {});
}

Actions Life::tick(Time now, bool silent) {
    now_ = now;
    if (starting_ && starting_->phase == Phase::Describing && now >= starting_->until) load(true);
    if (into_ && now >= into_until_) go_into();
    watch_opening(silent);
    if (stopping_ && !stopping_->asked && now >= stopping_->until) ask_nodes();
    if (stopping_ && stopping_->asked && now >= stopping_->until) finish_stop({});
    if (state_ == State::ComingToRest && now >= rest_until_) come_to_rest(silent);
    if (untold_ && !stopping_ && now >= untold_->until) {
        tell_end();
        start_next();
    }
    return std::exchange(actions_, {});
}

Time Life::next_tick() const {
    Time next = Time::max();
    if (starting_ && starting_->phase == Phase::Describing) next = starting_->until;
    if (into_) next = std::min(next, into_until_);
    if (stopping_) next = std::min(next, stopping_->until);
    // A process that is silent is asked again.
    if (state_ == State::ComingToRest) next = std::min(next, std::max(rest_until_, now_ + 20ms));
    if (untold_ && !stopping_) next = std::min(next, untold_->until);
    if (runner_opens_) next = std::min({next, open_until_, word_until_});
    return next;
}

bool Life::is_live() const {
    return state_ == State::Running || state_ == State::Paused || plan_ != Plan::None ||
           (starting_ && starting_->go);
}

void Life::done(CallNumber call) {
    if (call != 0) act(Answer{call, "", ""});
}

void Life::refuse(CallNumber call, const char* code, const std::string& why) {
    if (call != 0) act(Answer{call, code, why});
}

// ---- beginning ----

void Life::begin(What what, Phase phase, bool go, CallNumber call) {
    last_stop_ = 0;  // from here on nodes do something else
    starting_.emplace(Starting{++starts_, what, phase, go});
    if (call != 0) starting_->calls.push_back(call);
    state_ = phase == Phase::Opening ? State::Opening : State::Loading;
    halted_ = false;
}

void Life::open_runner(OpenRunner::What what) {
    runner_opens_ = what;
    const bool relives = starting_ && starting_->relives;
    open_until_ = now_ + (relives ? kReliveWithin : kOpenWithin);
    const Duration silent_max = target_ == Target::Bus ? kOpenSilentMax : kOpenWithin;
    word_until_ = now_ + silent_max;
    plan_ = Plan::None;  // what ran there is replaced
    world_open_ = false;
    const bool waited_for = starting_ && !starting_->calls.empty();
    act(OpenRunner{what, waited_for ? starting_->calls.front() : 0});
}

void Life::on(const Joined&) {
    target_ = Target::Bus;
    state_ = State::Ready;
    known_ = false;
}

void Life::on(const Open& open) {
    if (starting_ && !starting_->calls.empty()) {
        return refuse(open.call, "conflict", kBeingStarted);
    }
    if (stopping_) finish_stop_unseen();
    if (next_) refuse(std::exchange(next_, std::nullopt)->call, "failed", kReplaced);
    tell_replaced(open.by);
    open_world(open);
}

// One that is frozen would begin whenever it is let go on.
void Life::watch_opening(bool silent) {
    if (!runner_opens_) return;
    if (!silent) word_until_ = std::max(word_until_, now_ + kOpenSilentMax);
    if (now_ < open_until_ && now_ < word_until_) return;
    const std::string why = "did not open what it was to run in time";
    act(EndRunner{why});
    on(Failed{"the run " + why + "; its process was ended. Run it again"});
}

void Life::open_world(const Open& open) {
    tell_end();
    target_ = Target::World;
    begin(What::World, Phase::Opening, open.go, open.call);
    starting_->relives = open.past;
    open_runner(OpenRunner::What::World);
}

// The world alone, with its robots where they are. Nobody waits for it.
void Life::reopen_world() {
    begin(What::World, Phase::Opening, false, 0);
    open_runner(OpenRunner::What::WorldAgain);
}

void Life::on(const Start& start) {
    if (waits_its_turn(start)) return;
    start_now(start);
}

// Behind a stop that is under way, and behind one that a robot needs which does nobody knows what.
bool Life::waits_its_turn(const Start& start) {
    if (next_) {
        refuse(start.call, "conflict", kBeingStarted);
        return true;
    }
    if (!stopping_ && !starting_ && target_ == Target::Bus) {
        const bool replaces = start.plan && start.again && plan_ == Plan::Runs;
        if (replaces) begin_stop({start.by, Why::Stop}, "", "");
        if (!replaces && needs_rest(start)) begin_stop({"server", Why::Before}, "", "");
    }
    if (!stopping_ && !plan_is_ending()) return false;
    next_ = start;
    next_until_ = now_ + kRunWaitsMax;
    return true;
}

// What goes on moves as it did; what begins does so with a robot that is known to be at rest.
bool Life::needs_rest(const Start& start) const {
    const bool begins = start.plan ? plan_ != Plan::Runs : state_ == State::Ready;
    return !known_ || (begins && !start.quiet);
}

// What is under way is just what it asks for.
bool Life::joins(const Start& start, bool goes_on) const {
    const What what = starting_->what;
    if (what == What::World) return !start.plan && starting_->calls.empty();
    return (!start.plan || goes_on) && (what == What::Scripts || what == What::GoOn);
}

void Life::start_now(const Start& start) {
    const bool goes_on = plan_ == Plan::Runs && !start.again;
    if (starting_ && joins(start, goes_on)) {
        starting_->go = true;
        if (start.call != 0) starting_->calls.push_back(start.call);
        return;
    }
    if (starting_ && !starting_->calls.empty()) {
        return refuse(start.call, "conflict", kBeingStarted);
    }
    if (goes_on) {
        begin(What::GoOn, Phase::Loading, true, start.call);
        return act(LoadNodes{starts_, false});
    }
    if (start.plan && target_ == Target::Bus) {
        tell_end();
        begin(What::Plan, Phase::Loading, start.go, start.call);
        return act(LoadNodes{starts_, false});
    }
    if (start.plan) {
        tell_replaced(start.by);
        tell_end();
        target_ = Target::World;
        begin(What::Plan, Phase::Opening, start.go, start.call);
        starting_->relives = start.past;
        return open_runner(OpenRunner::What::Plan);
    }
    if (target_ != Target::Bus && start.world_again) return open_world({start.call, true});
    begin(What::Scripts, Phase::Loading, true, start.call);
    if (target_ == Target::Bus) act(BeginScripts{});
    act(LoadNodes{starts_, false});
}

void Life::on(const Opened&) {
    const auto opened = std::exchange(runner_opens_, std::nullopt);
    if (!opened) return;
    if (target_ == Target::Bus) return opened_on_bus();
    // Stopped while its world opened: the plan is abandoned, the world stays.
    if (*opened == OpenRunner::What::Plan && !starting_) return reopen_world();
    if (!starting_) begin(What::World, Phase::Opening, false, 0);
    if (*opened == OpenRunner::What::Plan) plan_ = Plan::Paused;
    world_open_ = true;
    act(ConnectWorld{});
    starting_->phase = Phase::Describing;
    starting_->until = now_ + kDescribeWithin;
    state_ = State::Loading;
}

// It is paused before its first actor.
void Life::opened_on_bus() {
    if (!starting_ || starting_->phase != Phase::Opening) {  // Stop came meanwhile
        plan_ = Plan::Ending;
        return act(EndPlan{});
    }
    plan_ = Plan::Paused;
    starting_->phase = Phase::Going;
    state_ = State::Loading;
    act(LetNodesGo{starting_->number, true});
}

void Life::on(const Failed& failed) {
    const auto opened = std::exchange(runner_opens_, std::nullopt);
    if (!opened) return;
    const bool wanted = starting_.has_value();
    give_up(failed.why);
    plan_ = Plan::None;
    if (target_ == Target::Bus) {
        // What was loaded for it runs already.
        if (!stopping_ && wanted) begin_stop({"plan", Why::Error}, "", failed.why);
        return;
    }
    state_ = State::None;
    // A plan that cannot run leaves the world as it was.
    if (*opened == OpenRunner::What::Plan) reopen_world();
}

void Life::on(const Described&) {
    if (starting_ && starting_->phase == Phase::Describing) load(true);
}

void Life::load(bool fresh) {
    starting_->phase = Phase::Loading;
    act(LoadNodes{starting_->number, fresh});
}

void Life::on(const Loaded& loaded) {
    if (!starting_ || starting_->number != loaded.start) return;
    if (starting_->phase != Phase::Loading) return;
    nodes_have_scripts();
}

void Life::nodes_have_scripts() {
    if (target_ == Target::Bus && starting_->what == What::Plan) {
        starting_->phase = Phase::Opening;
        state_ = State::Opening;
        return open_runner(OpenRunner::What::Plan);
    }
    if (starting_->what == What::World || starting_->what == What::Plan) return world_is_ready();
    if (starting_->what == What::Scripts) act(CountStart{});
    // A script has come to a breakpoint, or to its end by a fault, as it was loaded: its robot
    // brakes, until somebody lets it go.
    if (starting_->what == What::Scripts && target_ == Target::Bus && halted_) {
        return finish_start(State::Paused);
    }
    if (starting_->what == What::GoOn && target_ == Target::Bus) {
        act(ContinueRun{});
        act(LetNodesGo{starting_->number, true});
        return finish_start(State::Running);
    }
    starting_->phase = Phase::Going;
    act(LetNodesGo{starting_->number, false});
}

void Life::world_is_ready() {
    if (plan_ == Plan::Paused) plan_ = Plan::Runs;
    if (!starting_->go) {
        return finish_start(plan_ == Plan::Runs ? State::Paused : State::Ready);
    }
    act(BeginRun{});
    act(CountStart{});
    finish_start(State::Running);
}

void Life::on(const Went& went) {
    if (!starting_ || starting_->number != went.start) return;
    if (starting_->phase != Phase::Going) return;
    nodes_go();
}

// One that has come to its next breakpoint before all of them run has stopped time again: it stays
// so.
void Life::nodes_go() {
    const bool first = starting_->what == What::Plan;
    if (first && !starting_->go) {
        act(StepPlan{});
    } else if (first || (target_ == Target::World && !halted_)) {
        act(ContinueRun{});
    }
    if (first) {
        if (plan_ == Plan::Paused) plan_ = Plan::Runs;
        act(CountStart{});
    }
    const bool paused = first ? !starting_->go : halted_;
    finish_start(paused ? State::Paused : State::Running);
}

void Life::finish_start(State state) {
    const std::vector<CallNumber> calls = std::move(starting_->calls);
    starting_.reset();
    state_ = state;
    if (target_ == Target::Bus) known_ = true;
    for (const CallNumber call : calls) done(call);
}

// ---- while it runs ----

void Life::on(const Halted&) {
    halted_ = true;
    if (target_ != Target::World) return;
    act(PauseRun{});
    if (state_ == State::Running) state_ = State::Paused;
}

void Life::on(const Pause& pause) {
    if (world_open_ || plan_ != Plan::None) act(PauseRun{});
    if (state_ == State::Running) state_ = State::Paused;
    if (target_ != Target::Bus) return done(pause.call);
    if (pause.call != 0) pauses_.insert(pause.call);
    act(PauseNodes{pause.call});
}

void Life::on(const NodesPaused& paused) {
    if (pauses_.erase(paused.call) == 0) return;
    if (paused.why.empty()) return done(paused.call);
    refuse(paused.call, "failed", paused.why);
}

void Life::on(const HoldPlan& hold) {
    act(PauseRun{});
    if (state_ == State::Running) state_ = State::Paused;
    done(hold.call);
}

void Life::on(const ContinuePlan& go_on) {
    if (stopping_ || plan_ != Plan::Runs) {
        return refuse(go_on.call, "unavailable", "no plan runs");
    }
    act(ContinueRun{});
    if (state_ == State::Paused) state_ = State::Running;
    done(go_on.call);
}

void Life::on(const EndThePlan& end) {
    if (plan_ == Plan::None) return refuse(end.call, "unavailable", "no plan runs");
    plan_stop_by_ = end.by;
    act(EndPlan{false});
    done(end.call);
}

void Life::on(const StepInto& into) {
    if (into_) refuse(*into_, "conflict", "another step into a script was asked for");
    into_.reset();
    if (stopping_ || plan_ != Plan::Runs) return refuse(into.call, "unavailable", "no plan runs");
    into_ = into.call;
    into_until_ = now_ + kIntoWithin;
}

void Life::on(const BreakpointsSet&) {
    if (into_) go_into();
}

void Life::go_into() {
    const CallNumber call = *std::exchange(into_, std::nullopt);
    act(ContinueRun{});
    if (state_ == State::Paused) state_ = State::Running;
    done(call);
}

// What was under way is void, and answered.
void Life::give_up(const std::string& why) {
    if (into_) refuse(*std::exchange(into_, std::nullopt), "failed", why);
    if (next_) {
        const CallNumber call = std::exchange(next_, std::nullopt)->call;
        refuse(call, "failed", why);
    }
    ++starts_;
    if (!starting_) return;
    const std::vector<CallNumber> calls = std::move(starting_->calls);
    starting_.reset();
    for (const CallNumber call : calls) refuse(call, "failed", why);
}

}  // namespace vagus::serve
