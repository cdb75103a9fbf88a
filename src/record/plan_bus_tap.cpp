#include "record/plan_bus_tap.hpp"

#include <algorithm>
#include <chrono>

namespace vagus::record {

namespace {

int64_t steady_us() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

}  // namespace

void PlanBusTap::sees(const plan::TraceEvent& event) {
    if (began_us_ == 0) began_us_ = steady_us() - event.at.count();
}

Time PlanBusTap::now() const {
    const int64_t began = began_us_;
    return began == 0 ? Time{} : std::max(Time{}, Time(steady_us() - began));
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

// Once: more than one may ask for it.
void PlanBusTap::aborts(const std::string& by) {
    if (!aborted_.exchange(true)) recorder_.input_at(now(), Aborted{by});
}

}  // namespace vagus::record
