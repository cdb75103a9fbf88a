// Events of the bus that wait while the plan is paused, as pages see and handle them: the document
// of the topic held, and the three acts.
//
//     PlanHeld held;
//     held.tend(*talk);                        // now and then
//     held.tell(paused_since, document);       // true: the document is news
//     held.act(*talk, order, answered);
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "run/held_events.hpp"
#include "serve/json.hpp"
#include "serve/runner/plan_talk.hpp"
#include "serve/talk/orders.hpp"

namespace vagus::serve {

constexpr size_t kHeldShownMax = 200;  // those behind them are only counted
// Why there is nothing to act on.
constexpr const char* kPlanDoesNotStand =
    "events wait for a plan only while it is paused at a breakpoint; it is not";

class PlanHeld {
public:
    // Asks what waits, once what was asked before is answered.
    void tend(PlanTalk& talk);
    // No plan runs.
    void forget();
    // `since`: the plan is paused, since that second of the run's clock.
    bool tell(std::optional<double> since, Json& document);
    // For a paused plan; without a number it is the first that steps, and all that go or are
    // dropped.
    static void act(PlanTalk& talk, const talk::HandleHeld& order, PlanTalk::Answered answered);

private:
    run::HeldNow now_;
    bool asked_ = false;
    Json told_;
};

}  // namespace vagus::serve
