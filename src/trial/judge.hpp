// Holds a run against what its test expects. At one instant first the lines of the trace are taken,
// in their order, then the world as it is when bodies have moved. In a world without a plan user
// events are what lines are beside one.
//
//     Judge judge(test, graph, world);
//     judge.line(event);                             // as it comes
//     judge.instant();                               // at the end of each instant of the world
//     for (const Verdict& verdict : judge.end(ended)) show(verdict);
#pragma once

#include <string>
#include <vector>

#include "plan/trace.hpp"
#include "run/options.hpp"
#include "trial/readings.hpp"
#include "trial/test_file.hpp"

namespace vagus::trial {

// Of one expectation.
struct Verdict {
    bool as_expected = true;
    Time at{};              // when it was known that it is not
    std::string what = {};  // why not: the values then
    friend bool operator==(const Verdict&, const Verdict&) = default;
};

class Judge {
public:
    // All are borrowed; conditions are bound (Condition::bind).
    Judge(const TestFile& test, const plan::Graph& graph, const ReadWorld& world);

    // The first word of a node that its condition names and that is not there.
    Status check(const Expectation& one) const;
    void line(const plan::TraceEvent& event);
    void event(Time at, std::string_view name);
    void instant();
    // One for each expectation, in their order.
    std::vector<Verdict> end(const run::Ended& ended);

    Time now() const { return readings_.now(); }
    // The supervisor whose event ended the outermost plan; empty if none did.
    const std::string& ended_by() const { return ended_by_; }

private:
    struct Case {
        const Expectation* expectation;
        bool decided = false;
        Verdict verdict = {};
        size_t came_to = 0;  // of an order
        Time came_at{};
    };

    void ask();
    void ask(Case& one);
    void follow_order(const plan::TraceEvent& event, const plan::ActorStarted& started);
    void fail(Case& one, Time at, std::string what);
    std::string how_it_ended(const run::Ended& ended, Time now) const;
    void end(Case& one, const run::Ended& ended);
    std::string values_of(const Condition& condition) const;

    Readings readings_;
    std::vector<Case> cases_;
    std::string ended_by_;
};

// An actor as `order` names it: with the actors of the plans around it, "calibrate/turn". `plan` is
// the path of its own, "Hall/calibrate".
std::string name_in_order(std::string_view plan, std::string_view actor);
// "MaxTime", or the name of the result.
std::string_view way_of(const run::Ended& ended);

}  // namespace vagus::trial
