#include "trial/awaited.hpp"

namespace vagus::trial {

void Awaited::line(const plan::TraceEvent& event) {
    if (readings_.over()) return;
    readings_.line(event);
    if (readings_.are_asked()) ask();
}

void Awaited::event(Time at, std::string_view name) {
    readings_.event(at, name);
    ask();
}

void Awaited::instant() {
    if (readings_.over()) return;
    readings_.instant();
    if (readings_.are_asked_now()) ask();
}

void Awaited::ask() {
    if (is_over()) return;
    const Result<bool> now = holds();
    if (!now.ok()) {
        trouble_ = now.error();
    } else if (now.value()) {
        came_ = readings_.now();
    }
}

Result<bool> Awaited::holds() const {
    const std::vector<plan::Value> values = TRY(readings_.values(condition_));
    return condition_.holds(values);
}

}  // namespace vagus::trial
