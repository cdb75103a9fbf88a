#include "run/firing.hpp"

#include <fmt/format.h>

#include "plan/model.hpp"

namespace vagus::run {

std::optional<std::string> Firing::see(const plan::TraceEvent& event) {
    if (said_) return std::nullopt;
    if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        const auto caller = running_.find(event.plan.substr(0, event.plan.rfind('/')));
        if (caller != running_.end()) caller->second.is_plan = true;
    } else if (std::holds_alternative<plan::ActorStarted>(event.what)) {
        running_[event.plan] = {.since = event.at};
    } else if (std::holds_alternative<plan::ActorEnded>(event.what) ||
               std::holds_alternative<plan::ActorInterrupted>(event.what)) {
        // The event that ended its work is the first of the new count.
        const auto over = running_.find(event.plan);
        if (over != running_.end() && !over->second.worked) note_work(event.at);
        running_.erase(event.plan);
    } else if (std::holds_alternative<plan::PlanEnded>(event.what)) {
        running_.erase(event.plan);
    } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        note_work(event.at);
        return count(event, *raised);
    }
    return std::nullopt;
}

void Firing::note_work(Time now) {
    for (auto& [plan, actor] : running_) {
        if (actor.is_plan || now - actor.since <= kFiringWorkMin) continue;
        actor.worked = true;
        counts_.clear();
    }
}

std::optional<std::string> Firing::count(const plan::TraceEvent& line,
                                         const plan::EventRaised& raised) {
    const Event event(line.plan, raised.supervisor, raised.event);
    if (++counts_[event] < kFiringsMax) return std::nullopt;
    said_ = true;
    const bool leads = raised.target != plan::kIgnore && raised.target != plan::kTerminate;
    return fmt::format(
        "{}: \"{}\" has raised {} {} times, and meanwhile no actor ran for more than {} ms: the "
        "plan "
        "does nothing but fire. Let {} change what \"{}\" watches for, or give it a longer "
        "period_ms{}",
        line.plan, raised.supervisor, raised.event, kFiringsMax,
        std::chrono::duration_cast<std::chrono::milliseconds>(kFiringWorkMin).count(),
        leads ? fmt::format("\"{}\"", raised.target) : std::string("an actor"), raised.supervisor,
        raised.target == plan::kIgnore ? "" : fmt::format(", or lead {} to @ignore", raised.event));
}

}  // namespace vagus::run
