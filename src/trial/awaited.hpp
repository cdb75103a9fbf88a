// Waits in a run for a condition to come about, asked as those of tests are: after each line of the
// trace, and each kAskedEvery; with a plan from when its first actor starts to its end.
//
//     Awaited awaited(condition, graph, read_world_of(world));
//     awaited.line(event);                           // as it comes
//     awaited.instant();                             // at the end of each instant of the world
//     if (awaited.came()) show(*awaited.came());
#pragma once

#include <optional>

#include "plan/trace.hpp"
#include "trial/condition.hpp"
#include "trial/readings.hpp"

namespace vagus::trial {

class Awaited {
public:
    // All are borrowed; the condition is bound (Condition::bind). A graph whose plan has no actors
    // is that of a world without a plan.
    Awaited(const Condition& condition, const plan::Graph& graph, const ReadWorld& world)
        : condition_(condition),
          readings_(graph, world),
          started_(graph.plans.front().actors.empty()) {}

    void line(const plan::TraceEvent& event);
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
    bool started_;
    bool over_ = false;  // its plan is
};

}  // namespace vagus::trial
