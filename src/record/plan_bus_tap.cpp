#include "record/plan_bus_tap.hpp"

#include <algorithm>
#include <utility>

namespace vagus::record {

void PlanBusTap::begin(const aesl::CommonDefinitions& common, std::function<Time()> clock) {
    bus_.begin(common);
    clock_ = std::move(clock);
}

void PlanBusTap::sees(const plan::TraceEvent& event) {
    if (began_us_ < 0) began_us_ = std::max(int64_t{0}, (clock_() - event.at).count());
}

Time PlanBusTap::now() const {
    const int64_t began = began_us_;
    return began < 0 ? Time{} : std::max(Time{}, clock_() - Time(began));
}

void PlanBusTap::node(const std::string& name, toolbox::BusNodes::Change change) {
    recorder_.input_at(now(), NodeChanged{name, change});
}

uint32_t PlanBusTap::frame(const wire::Frame& frame, const run::BusEvent* sent) {
    if (sent == nullptr) return bus_.frame(now(), {.frame = frame});
    return bus_.frame(now(), {.frame = frame, .cause = sent->cause, .by = sent->by});
}

void PlanBusTap::hears(const run::BusEvent& event, Time at) {
    Heard heard{.frame = event.frame};
    if (heard.frame == 0) {
        heard.name = event.name;
        heard.from = event.from;
    }
    recorder_.input_at(at, std::move(heard));
}

void PlanBusTap::asked(const run::Request& request, Time at) {
    const bool goes_on = std::holds_alternative<run::Continue>(request) ||
                         std::holds_alternative<run::Step>(request) ||
                         std::holds_alternative<run::StepEvent>(request);
    if (goes_on && began_us_ >= 0) began_us_ = (clock_() - at).count();
    recorder_.input_at(at, request);
}

// Once: more than one may ask for it.
void PlanBusTap::aborts(const std::string& by) {
    if (!aborted_.exchange(true)) recorder_.input_at(now(), Aborted{by});
}

}  // namespace vagus::record
