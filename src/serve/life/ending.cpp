// How a run ends: every end takes this path, whatever asked for it.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "serve/life/life.hpp"
#include "session/stop_node_name.hpp"

namespace vagus::serve {

using namespace life;

namespace {

constexpr const char* kStopped = "it was stopped";
constexpr const char* kLeft = "the target was left";
constexpr const char* kWaited =
    "the plan before it took too long to end; nothing was started. Run it again";

bool has_stopped(const StopNode& node) {
    return node.state == StopNode::State::Stopped;
}

// One that is gone may be none of the robot's any more; one that is silent may do anything.
bool may_move(const StopNode& node) {
    return !has_stopped(node) && node.state != StopNode::State::Gone;
}

std::string not_at_rest(const StopNode& node) {
    const bool moves = node.state == StopNode::State::Moving;
    return fmt::format("{} {}, so nothing was started. Check the robot, then run it again",
                       session::number_and_name(node),
                       moves ? "did not stop" : "did not answer Stop");
}

}  // namespace

void Life::on(const Stop& stop) {
    if (stopping_) {
        if (next_) refuse(std::exchange(next_, std::nullopt)->call, "failed", kStopped);
        if (stop.call != 0) stopping_->calls.push_back(stop.call);
        return;
    }
    begin_stop(stop.cause, "", "");
    if (stop.call == 0) return;
    if (stopping_) {
        stopping_->calls.push_back(stop.call);
    } else {
        act(AnswerStop{stop.call, {}});  // nothing is there that could run
    }
}

void Life::begin_stop(const Cause& cause, std::string result, std::string message) {
    give_up(kStopped);
    tell_end();
    const bool plan = plan_ != Plan::None || (target_ == Target::Bus && runner_opens_);
    if (plan) act(EndPlan{});
    if (plan_ != Plan::None) plan_ = Plan::Ending;
    if (target_ == Target::None || (target_ == Target::World && !world_open_)) return;
    if (cause.why != Why::Before) {
        const Time until = plan_ == Plan::Ending ? now_ + kResultWithin : now_;
        untold_.emplace(Untold{{++ends_, cause, std::move(result), std::move(message), {}}, until});
    }
    stopping_.emplace(Stopping{++starts_});
    state_ = State::Stopping;
    // In a world the plan ends first, so that its last words still find their nodes; it has no more
    // than a moment. On a bus nothing is waited for.
    if (target_ == Target::World && plan_ == Plan::Ending) {
        stopping_->until = now_ + kPlanEndsWithin;
    } else {
        ask_nodes();
    }
}

void Life::ask_nodes() {
    stopping_->asked = true;
    stopping_->until = now_ + kReportWithin;
    act(StopNodes{stopping_->number});
}

void Life::on(const Stopped& stopped) {
    if (stopping_ && stopping_->number == stopped.number) return finish_stop(stopped.report);
    if (last_stop_ != stopped.number || stopping_) return;
    if (untold_ && untold_->rests) {
        untold_->end.nodes = stopped.report.nodes;
        return tell_end();
    }
    // Another node has answered since it was told.
    if (told_.number == 0) return;
    told_.nodes = stopped.report.nodes;
    act(Tell{told_, true});
}

void Life::finish_stop(const StopReport& report) {
    const std::vector<CallNumber> calls = std::move(stopping_->calls);
    last_stop_ = stopping_->number;
    stopping_.reset();
    for (const CallNumber call : calls) act(AnswerStop{call, report});
    const auto moving = std::find_if(report.nodes.begin(), report.nodes.end(), may_move);
    if (next_ && moving != report.nodes.end()) {
        refuse(std::exchange(next_, std::nullopt)->call, "failed", not_at_rest(*moving));
    }
    known_ = std::all_of(report.nodes.begin(), report.nodes.end(), has_stopped);
    if (untold_) untold_->end.nodes = report.nodes;
    if (target_ == Target::World) {
        state_ = State::ComingToRest;
        rest_until_ = now_ + kRollOut;
    } else {
        state_ = State::Ready;
    }
    if (untold_ && plan_ != Plan::Ending) tell_end();
    after_stop();
}

void Life::after_stop() {
    if (!leaves_.empty()) {
        if (next_) refuse(std::exchange(next_, std::nullopt)->call, "failed", kLeft);
        return leave_now();
    }
    start_next();
}

// On a bus: its process still talks. A world is opened again for the next one.
bool Life::plan_is_ending() const {
    return target_ == Target::Bus && untold_ && plan_ == Plan::Ending;
}

// What waited behind a stop: not before the plan that was told to end has done so, and not long
// after it was asked for.
void Life::start_next() {
    if (!next_ || stopping_ || plan_is_ending()) return;
    const Start start = *std::exchange(next_, std::nullopt);
    if (now_ <= next_until_) return start_now(start);
    refuse(start.call, "late", kWaited);
}

// Once: with the plan's result, or without if that does not come.
void Life::tell_end() {
    if (!untold_) return;
    told_ = std::move(untold_->end);
    untold_.reset();
    act(Tell{told_, false});
}

// A plan that another one, or the world alone, takes the place of.
void Life::tell_replaced(const std::string& by) {
    if (plan_ == Plan::Runs) tell_end_by_itself({by, Why::Stop}, {"Interrupted", ""});
}

void Life::tell_end_by_itself(const Cause& cause, const PlanEnded& ended) {
    tell_end();
    told_ = {++ends_, cause, ended.result, ended.message, {}};
    act(Tell{told_, false});
}

void Life::on(const PlanEnded& ended) {
    if (plan_ == Plan::None) return;
    const bool asked_to = std::exchange(plan_, Plan::None) == Plan::Ending;
    const std::string by = std::exchange(plan_stop_by_, "");
    if (asked_to) {
        if (untold_) {
            untold_->end.result = ended.result;
            untold_->end.message = ended.message;
        }
        if (stopping_ && !stopping_->asked) ask_nodes();
        if (untold_ && !stopping_) tell_end();
        return start_next();
    }
    if (into_) refuse(*std::exchange(into_, std::nullopt), "failed", "the plan has ended");
    // Of a recorded plan nothing has to be stopped: whoever opens it looks at how it ended.
    const bool is_past = starting_ && starting_->relives && !starting_->go;
    if (ended.result == "Error" && !is_past) {
        give_up("its plan ended in an error: " + ended.message);
        return begin_stop({"plan", Why::Error}, ended.result, ended.message);
    }
    // Its scripts go on; what it had begun does not.
    const Cause cause = {by.empty() ? "plan" : by, Why::Plan};
    if (target_ != Target::Bus) {
        act(MakeSafe{});
        return tell_end_by_itself(cause, ended);
    }
    tell_end();
    untold_.emplace(
        Untold{{++ends_, cause, ended.result, ended.message, {}}, now_ + kRestReportWithin, true});
    last_stop_ = ++starts_;
    act(MakeSafe{last_stop_});
}

void Life::on(const Died& died) {
    const bool plan = plan_ != Plan::None;
    const bool lived = plan || runner_opens_ || (target_ == Target::World && is_live());
    runner_opens_.reset();
    plan_ = Plan::None;
    world_open_ = false;
    if (stopping_) {
        if (untold_ && plan) untold_->end.result = "Error";
        if (untold_ && plan) untold_->end.message = died.why;
        if (target_ == Target::World) finish_stop({});
        if (target_ == Target::World) state_ = State::Dead;
        return;
    }
    give_up(died.why);
    if (target_ == Target::Bus) {
        if (lived) begin_stop({"plan", Why::Died}, plan ? "Error" : "", died.why);
        return;
    }
    state_ = State::Dead;
    if (lived) tell_end_by_itself({"plan", Why::Died}, {plan ? "Error" : "", died.why});
}

// The wheels have come to rest. A plan that waits for paused nodes is abandoned. A process that
// hangs is left as it is: what it did until then is what people look for.
void Life::come_to_rest(bool silent) {
    if (silent) return;
    if (plan_ != Plan::None) {
        tell_end();
        return reopen_world();
    }
    act(RestRun{});
    state_ = State::Ready;
}

// ---- leaving ----

void Life::on(const Leave& leave) {
    leaves_.push_back(leave);
    if (stopping_ && target_ == Target::Bus) return;
    if (target_ == Target::Bus && (leave.drives || is_live())) {
        return begin_stop(leave.cause, "", "");
    }
    leave_now();
}

void Life::leave_now() {
    give_up(kLeft);
    const bool lived = is_live();
    if (stopping_) finish_stop_unseen();
    if (untold_) {
        tell_end();
    } else if (lived && target_ == Target::World) {
        tell_end_by_itself(leaves_.front().cause, {});
    }
    const std::vector<Leave> leaves = std::exchange(leaves_, {});
    for (const CallNumber call : std::exchange(pauses_, {})) refuse(call, "failed", kLeft);
    act(Disconnect{});
    state_ = State::None;
    target_ = Target::None;
    plan_ = Plan::None;
    world_open_ = known_ = false;
    last_stop_ = 0;
    runner_opens_.reset();
    for (const Leave& leave : leaves) act(GoOnLeaving{leave.call});
}

// The world in which it stops is closed.
void Life::finish_stop_unseen() {
    for (const CallNumber call : stopping_->calls) act(AnswerStop{call, {}});
    stopping_.reset();
}

}  // namespace vagus::serve
