#include "serve/follow/plan_counts.hpp"

#include "base/time.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

void PlanCounts::see(const plan::TraceEvent& event) {
    const double t = seconds_of(event.at);
    Instance& one = instances_[event.plan];
    if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        one.active.clear();
        one.taken = nullptr;
    } else if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        if (one.taken.is_null()) take(one, "start", "", "", started->actor);
        begin(one, started->actor, t);
    } else if (const auto* ended = std::get_if<plan::ActorEnded>(&event.what)) {
        end(one, t);
        take(one, "state", ended->actor, ended->state, ended->target);
    } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        ++one.supervisors[std::string(raised->supervisor)].times;
        take(one, "event", raised->supervisor, raised->event, raised->target);
    } else if (std::holds_alternative<plan::ActorInterrupted>(event.what) ||
               std::holds_alternative<plan::PlanEnded>(event.what)) {
        end(one, t);
    }
}

void PlanCounts::begin(Instance& one, std::string_view actor, double t) {
    one.active = actor;
    one.since = t;
    ++one.actors[one.active].times;
}

// Also of one whose plan ends by an error.
void PlanCounts::end(Instance& one, double t) {
    if (one.active.empty()) return;
    Count& count = one.actors[one.active];
    count.last = t - one.since;
    count.seconds += count.last;
    one.active.clear();
}

// The number tells a page that the same arrow was taken again.
void PlanCounts::take(Instance& one, const char* is, std::string_view element,
                      std::string_view outcome, std::string_view target) {
    one.taken = {{"number", ++arrows_},
                 {"is", is},
                 {"element", element},
                 {"outcome", outcome},
                 {"target", target}};
}

Json PlanCounts::counts(const std::string& path) const {
    Json list = Json::array();
    const auto found = instances_.find(path);
    if (found == instances_.end()) return list;
    const auto add = [&](const char* is, const std::map<std::string, Count>& all) {
        for (const auto& [name, count] : all) {
            list.push_back({{"is", is},
                            {"name", name},
                            {"times", count.times},
                            {"seconds", count.seconds},
                            {"last", count.last}});
        }
    };
    add("actor", found->second.actors);
    add("supervisor", found->second.supervisors);
    return list;
}

Json PlanCounts::taken(const std::string& path) const {
    const auto found = instances_.find(path);
    return found == instances_.end() ? Json() : found->second.taken;
}

}  // namespace vagus::serve
