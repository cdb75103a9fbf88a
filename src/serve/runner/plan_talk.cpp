#include "serve/runner/plan_talk.hpp"

#include <utility>

namespace vagus::serve {

Result<uint64_t> PlanTalk::post(run::Request request) {
    const run::Request told = request;
    const auto posted = debugger_.post(std::move(request));
    if (posted.ok()) told_(told);
    return posted;
}

// What a debugger does not take has no effect, and what it refuses was so already.
void PlanTalk::hold() {
    stepping_ = false;
    (void)post(run::Pause{}).ok();
}

void PlanTalk::go_on() {
    if (stepping_) hold();  // a debugger ends a step by a pause only
    paused_ = false;
    (void)post(run::Continue{}).ok();
}

void PlanTalk::step() {
    hold();  // a debugger steps from a pause
    (void)post(run::Step{}).ok();
    stepping_ = true;
    paused_ = false;
}

void PlanTalk::step_event(std::optional<uint64_t> number, Answered answered) {
    ask(run::StepEvent{number},
        [this, answered = std::move(answered)](const Result<run::Reply>& reply) {
            if (reply.ok()) {
                stepping_ = true;
                paused_ = false;
            }
            answered(reply);
        });
}

void PlanTalk::give_up_step() {
    if (stepping_) go_on();
}

void PlanTalk::abort() {
    paused_ = false;
    (void)post(run::Abort{}).ok();
}

void PlanTalk::ask(run::Request request, Answered answered) {
    const auto posted = post(std::move(request));
    if (!posted.ok()) return answered(posted.error());
    asked_[posted.value()] = std::move(answered);
}

void PlanTalk::ask_again(const run::Request& request) {
    const bool steps = std::holds_alternative<run::Step>(request) ||
                       std::holds_alternative<run::StepEvent>(request);
    if (steps || std::holds_alternative<run::Continue>(request)) paused_ = false;
    if (steps || std::holds_alternative<run::Pause>(request)) stepping_ = steps;
    (void)post(request).ok();
}

void PlanTalk::ask_held(run::Request request, Answered answered, Then then) {
    const bool steps = stepping_;
    if (!paused_) hold();
    ask(std::move(request), std::move(answered));
    if (paused_ || then == Then::Hold) return;
    if (steps) return step();
    // It may have come to a breakpoint meanwhile: then it stays there.
    (void)post(run::Continue{.from_met = false}).ok();
}

PlanTalk::Heard PlanTalk::hear() {
    Heard heard;
    while (const auto report = debugger_.wait_report(Duration{})) {
        if (const auto* stopped = std::get_if<run::Stopped>(&*report)) {
            if (stopped->why == run::Stopped::Why::Step && std::exchange(stepping_, false)) {
                heard.stepped = stopped->where;
                paused_ = true;
            } else if (stopped->why == run::Stopped::Why::Breakpoint) {
                heard.broken = *stopped;
                stepping_ = false;
                paused_ = true;
            }
            continue;
        }
        const auto* answer = std::get_if<run::Answer>(&*report);
        const auto asked = answer ? asked_.find(answer->request) : asked_.end();
        if (asked == asked_.end()) continue;
        const Answered answered = std::move(asked->second);
        asked_.erase(asked);
        answered(answer->reply);
    }
    return heard;
}

void PlanTalk::forget() {
    (void)hear();
    for (const auto& [number, answered] : std::exchange(asked_, {})) {
        answered(Error{Code::Unavailable, "the plan has ended"});
    }
}

}  // namespace vagus::serve
