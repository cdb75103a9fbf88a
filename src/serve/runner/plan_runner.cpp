#include "serve/runner/plan_runner.hpp"

#include <utility>

#include "plan/trace.hpp"
#include "serve/json.hpp"
#include "serve/runner/bus_clock.hpp"

namespace vagus::serve {

namespace {

Error no_plan_runs() {
    return {Code::Unavailable, "no plan runs"};
}

talk::PlanState state_of(const Json& document) {
    if (document["state"] == "ended") return talk::PlanState::Ended;
    return document["state"] == "paused" ? talk::PlanState::Paused : talk::PlanState::Running;
}

std::map<std::string, std::string> texts_of(const std::vector<plan::Plan>& plans) {
    std::map<std::string, std::string> texts;
    size_t bytes = 0;
    for (const plan::Plan& one : plans) {
        if (one.text.empty() || !texts.emplace(one.file, one.text).second) continue;
        bytes += one.text.size();
        if (bytes > kRunningTextsMax) return {};
    }
    return texts;
}

}  // namespace

// ---- its life ----

void PlanRunner::begin(const embed::LoadedPlan& plan, const std::string& path, On on) {
    on_ = on;
    plans_ = std::make_shared<const PlanOutlines>(outlines_of(plan.plans()));
    texts_ = texts_of(plan.plans());
    version_ = nullptr;
    number_ = 1;
    follower_.emplace(plans_, [](const std::string& file) { return file; });
    talk_.emplace(plan.graph());
    change_.emplace(plan, path, *talk_,
                    [this](const talk::Answer& answer) { teller_.tell(answer); });
    talk_->on_asked(asked_);
    change_->on_read(changed_);
    stops_.tend(*talk_);
}

void PlanRunner::tell_version() {
    teller_.tell(talk::PlanVersion{number_, *plans_, texts_});
}

void PlanRunner::end_talk() {
    talk_->forget();
    change_.reset();
    talk_.reset();
    stops_.forget();
    held_.forget();
    tell_stops();
    broken_at_.clear();
}

void PlanRunner::forget() {
    follower_.reset();
}

// ---- what it does ----

void PlanRunner::see(const plan::TraceEvent& event) {
    const auto* changed = std::get_if<plan::PlanChanged>(&event.what);
    const bool fresh = changed && changed->graph.get() != version_;
    if (fresh) take_version(*changed->graph);
    follower_->see(event);
    talk::Traced traced{.line = plan::format_trace(event)};
    if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        traced.actor = started->actor;
    }
    traced.late = std::holds_alternative<plan::CheckLate>(event.what);
    teller_.tell(std::move(traced));
    if (fresh) tell_version();
}

// A plan that runs twice, at two levels, changes at both by one version.
void PlanRunner::take_version(const plan::Graph& graph) {
    version_ = &graph;
    ++number_;
    const std::vector<plan::Plan>& taken = change_->took(graph);
    plans_ = std::make_shared<const PlanOutlines>(outlines_of(taken));
    texts_ = texts_of(taken);
    follower_->change(plans_);
}

void PlanRunner::hear() {
    if (!talk_) return;
    const PlanTalk::Heard heard = talk_->hear();
    tend_stops();
    if (heard.stepped) stand_at(*heard.stepped, {});
    if (heard.broken) stand_at(heard.broken->where, stops_.numbers(heard.broken->breakpoints));
}

void PlanRunner::stand_at(const run::Where& where, std::vector<uint64_t> breakpoints) {
    follower_->stand_at(where);
    broken_at_ = std::move(breakpoints);
    pacer_.set(true, pacer_.speed(), clocks_.wall());
    haste_ = true;
}

void PlanRunner::tell() {
    if (follower_) teller_.tell(plan_now());
}

talk::PlanNow PlanRunner::plan_now() const {
    const Json document = follower_->document(clocks_.run(), pacer_.held());
    talk::PlanNow now;
    now.state = state_of(document);
    now.t = document["t"];
    now.file = document["doc"];
    for (const Json& level : document["levels"]) now.levels.push_back({level["doc"], {level}});
    now.story.json = document["story"];
    if (document.contains("result")) now.result = document["result"];
    now.message = document.value("message", "");
    if (!follower_->over()) now.stands_at = broken_at_;
    return now;
}

void PlanRunner::tend_stops() {
    if (!talk_) return;
    stops_.tend(*talk_);
    if (!relives_) held_.tend(*talk_);
    tell_stops();
}

void PlanRunner::tell_stops() {
    if (auto list = stops_.news()) teller_.tell(talk::BreakpointsNow{std::move(*list)});
    std::optional<double> since;
    if (talk_ && is_held()) since = clocks_.run();
    talk::HeldNow held;
    if (held_.tell(since, held.document.json)) teller_.tell(std::move(held));
}

// ---- what it is told ----

void PlanRunner::want(std::vector<talk::BreakpointOrder> breakpoints) {
    stops_.want(std::move(breakpoints));
}

void PlanRunner::pace() {
    if (!pacer_.held()) broken_at_.clear();
    if (!talk_) return;
    if (!is_on_bus()) return talk_->give_up_step();  // the clock holds the plan of a world
    pacer_.held() ? talk_->hold() : talk_->go_on();
}

void PlanRunner::go_on() {
    broken_at_.clear();
    talk_->go_on();
}

void PlanRunner::ask_again(const run::Request& request) {
    broken_at_.clear();
    if (talk_) talk_->ask_again(request);
}

void PlanRunner::step() {
    if (talk_) talk_->step();
    let_time_pass();
}

void PlanRunner::let_time_pass() {
    broken_at_.clear();
    pacer_.set(false, pacer_.speed(), clocks_.wall());
}

// By its debugger, not by the clock of its world.
bool PlanRunner::is_held() const {
    return talk_->is_paused() || (is_on_bus() && pacer_.held());
}

// A run answers between two decisions.
void PlanRunner::let_an_instant_pass() {
    if (!is_on_bus() && !talk_->is_paused() && pacer_.paused()) {
        pacer_.step(std::chrono::milliseconds(1));
    }
}

void PlanRunner::ask_held(uint64_t request, run::Request asked) {
    if (!talk_) return teller_.answer(request, Status(no_plan_runs()));
    const bool stays = is_on_bus() && pacer_.held();
    talk_->ask_held(
        std::move(asked),
        [this, request](const Result<run::Reply>& reply) {
            teller_.answer(request, reply.ok() ? Status::done() : Status(reply.error()));
        },
        stays ? PlanTalk::Then::Hold : PlanTalk::Then::GoOn);
    let_an_instant_pass();
}

void PlanRunner::obey(const talk::SetVariable& order) {
    ask_held(order.request,
             run::SetVariable{static_cast<int>(order.level), order.name, order.value});
}

void PlanRunner::obey(const talk::RaiseEvent& order) {
    run::RaiseEvent event{order.supervisor, order.event, {}};
    event.outputs.assign(order.outputs.begin(), order.outputs.end());
    ask_held(order.request, std::move(event));
}

void PlanRunner::obey(const talk::HandleHeld& order) {
    if (!talk_) return teller_.answer(order.request, Status(no_plan_runs()));
    if (!is_held()) {
        return teller_.answer(order.request, Status(Error{Code::Refused, kPlanDoesNotStand}));
    }
    const bool steps = order.act == talk::HeldAct::Step;
    PlanHeld::act(*talk_, order,
                  [this, request = order.request, steps](const Result<run::Reply>& reply) {
                      teller_.answer(request, reply.ok() ? Status::done() : Status(reply.error()));
                      if (steps && reply.ok()) let_time_pass();
                  });
    haste_ = true;  // the answer is heard at once
}

void PlanRunner::obey(const talk::ChangePlan& order) {
    if (!change_) return teller_.answer(order.request, Status(no_plan_runs()));
    change_->take(order);
    let_an_instant_pass();
}

void PlanRunner::obey(const talk::CheckPlan& order) {
    if (!change_) return teller_.answer(order.request, Status(no_plan_runs()));
    using Ask = PlanChange::Ask;
    change_->check(order, is_on_bus() ? Ask::ByTheTalk : Ask::AtOnce);
}

}  // namespace vagus::serve
