// A condition of a test: a formula (docs/formulas.md) over signals, variables of the plan and words
// of nodes.
//
//     Condition near = TRY(Condition::parse("contact < 2 and node('drive', 'token') > 0"));
//     TRY(near.bind(graph, true));
//     const Result<bool> holds = near.holds(values);     // one Value for each of names()
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "plan/graph.hpp"
#include "plan/word_formula.hpp"
#include "trial/signals.hpp"

namespace vagus::trial {

class Condition {
public:
    // What a name in it stands for; bind() knows which of the unknown ones are signals.
    struct Name : plan::WordFormula::Name {
        const Signal* signal = nullptr;
        int slot = -1;  // of the plan's variable
    };

    // The Error says what is wrong with the text, without a place in a file.
    static Result<Condition> parse(std::string_view text);
    // Which variables, actors and events the plan has, and whether there is a world. The Error
    // names what is unknown, and the nearest that is not.
    Status bind(const plan::Graph& graph, bool has_world);
    // In a world without a plan: there are no variables, actors and supervisors then, and `event`
    // is one of the robot's bus.
    Status bind_without_plan();
    // Then, once the scripts run: which user events there are on that bus. The Error as of bind().
    Status check_events(const std::vector<std::string>& known) const;

    const std::string& text() const { return formula_.text(); }
    const std::vector<Name>& names() const { return names_; }
    bool uses(SignalId signal) const;
    // With the values of names(), in that order.
    Result<bool> holds(std::span<const plan::Value> values) const { return formula_.holds(values); }

private:
    explicit Condition(plan::WordFormula formula) : formula_(std::move(formula)) {}
    Status bind_names(const plan::GraphPlan* plan, bool has_world);
    Status check_texts(const plan::Graph& graph) const;

    plan::WordFormula formula_;
    std::vector<Name> names_;
};

}  // namespace vagus::trial
