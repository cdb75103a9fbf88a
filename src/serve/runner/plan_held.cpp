#include "serve/runner/plan_held.hpp"

#include "base/time.hpp"
#include "serve/json.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace vagus::serve {

namespace {

Json json_of(const run::HeldEvent& one, double since) {
    const double after = seconds_of(one.after);
    return {{"number", one.number},   {"t", since},
            {"after", after},         {"node", one.event.from},
            {"name", one.event.name}, {"args", one.event.arguments}};
}

}  // namespace

void PlanHeld::tend(PlanTalk& talk) {
    if (std::exchange(asked_, true)) return;
    talk.ask(run::ListHeld{}, [this](const Result<run::Reply>& reply) {
        asked_ = false;
        if (reply.ok()) now_ = std::get<run::HeldNow>(reply.value());
    });
}

void PlanHeld::forget() {
    now_ = {};
    asked_ = false;
}

bool PlanHeld::tell(std::optional<double> since, Json& document) {
    const size_t shown = std::min(now_.events.size(), kHeldShownMax);
    Json events = Json::array();
    for (size_t i = 0; i < shown; ++i) events.push_back(json_of(now_.events[i], since.value_or(0)));
    document = {{"stands", since.has_value()},
                {"events", std::move(events)},
                {"more", now_.events.size() - shown},
                {"dropped", now_.dropped}};
    if (document == told_) return false;
    told_ = document;
    return true;
}

void PlanHeld::act(PlanTalk& talk, const talk::HandleHeld& order, PlanTalk::Answered answered) {
    switch (order.act) {
        case talk::HeldAct::Go:
            return talk.ask(run::LetGo{order.number}, std::move(answered));
        case talk::HeldAct::Step:
            return talk.step_event(order.number, std::move(answered));
        case talk::HeldAct::Drop:
            return talk.ask(run::DropHeld{order.number}, std::move(answered));
    }
}

}  // namespace vagus::serve
