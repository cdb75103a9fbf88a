#include "serve/host/plan_talk.hpp"

#include <utility>

namespace vagus::serve {

// What a debugger does not take has no effect, and what it refuses was so already.
void PlanTalk::hold() {
    stepping_ = false;
    (void)debugger_.post(run::Pause{}).ok();
}

void PlanTalk::go_on() {
    if (stepping_) hold();  // a debugger ends a step by a pause only
    (void)debugger_.post(run::Continue{}).ok();
}

void PlanTalk::step() {
    hold();  // a debugger steps from a pause
    (void)debugger_.post(run::Step{}).ok();
    stepping_ = true;
}

void PlanTalk::abort() {
    (void)debugger_.post(run::Abort{}).ok();
}

void PlanTalk::set(uint64_t request, Write write, Then then) {
    hold();
    const auto posted = debugger_.post(
        run::SetVariable{write.level, std::move(write.variable), std::move(write.value)});
    if (posted.ok()) {
        asked_[posted.value()] = request;
    } else {
        refused_.push_back({request, posted.error().what});
    }
    if (then == Then::GoOn) go_on();
}

// A debugger takes it while the plan runs and while it is held.
void PlanTalk::take_version(uint64_t request, plan::NewVersion next, bool only_ask) {
    const auto posted = debugger_.post(run::TakeVersion{std::move(next), only_ask});
    if (posted.ok()) {
        asked_[posted.value()] = request;
    } else {
        refused_.push_back({request, posted.error().what});
    }
}

PlanTalk::Heard PlanTalk::hear() {
    Heard heard{std::exchange(refused_, {}), std::nullopt};
    while (const auto report = debugger_.wait_report(Duration{})) {
        if (const auto* stopped = std::get_if<run::Stopped>(&*report)) {
            const bool at_actor = stopped->why == run::Stopped::Why::Step;
            if (at_actor && std::exchange(stepping_, false)) heard.stepped = stopped->where;
            continue;
        }
        const auto* answer = std::get_if<run::Answer>(&*report);
        const auto asked = answer ? asked_.find(answer->request) : asked_.end();
        if (asked == asked_.end()) continue;
        PlanTalk::Answered answered{asked->second, "", {}};
        if (!answer->reply.ok()) answered.why = answer->reply.error().what;
        const auto* change =
            answer->reply.ok() ? std::get_if<run::Change>(&answer->reply.value()) : nullptr;
        if (change) answered.reasons = change->reasons;
        heard.answers.push_back(std::move(answered));
        asked_.erase(asked);
    }
    return heard;
}

std::vector<PlanTalk::Answered> PlanTalk::forget() {
    std::vector<Answered> left = hear().answers;
    for (const auto& [number, request] : std::exchange(asked_, {})) {
        left.push_back({request, "the plan has ended"});
    }
    return left;
}

}  // namespace vagus::serve
