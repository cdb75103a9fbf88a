// Waits in a run for a condition to become true. It is asked when those of tests are
// (readings.hpp).
//
//     Awaited awaited(condition, graph, read_world_of(world));
//     awaited.line(event);                           // as it comes
//     awaited.instant();                             // at the end of each instant of the world
//     if (awaited.came()) show(*awaited.came());
#pragma once

#include <optional>
#include <string_view>

#include "plan/trace.hpp"
#include "trial/condition.hpp"
#include "trial/readings.hpp"

namespace vagus::trial {

class Awaited {
public:
    // All are borrowed; the condition is bound (Condition::bind).
    Awaited(const Condition& condition, const plan::Graph& graph, const ReadWorld& world)
        : condition_(condition), readings_(graph, world) {}

    void line(const plan::TraceEvent& event);
    void event(Time at, std::string_view name);
    void instant();

    // When it first held.
    const std::optional<Time>& came() const { return came_; }
    // What it names that is not there.
    const Status& trouble() const { return trouble_; }
    // No more is to be learnt.
    bool is_over() const { return came_.has_value() || !trouble_.ok(); }

private:
    void ask();
    Result<bool> holds() const;

    const Condition& condition_;
    Readings readings_;
    std::optional<Time> came_;
    Status trouble_ = Status::done();
};

}  // namespace vagus::trial
