// A plan whose code answers by itself instead of working (run/answers.hpp): for a run without a
// world and without nodes.
//
//     const auto answered = AnsweredPlan::read("Wall.test.json", plan.graph(), true);
//     run::AnsweringCode code(answered.value()->answers());     // for one run
//     options.code_source = &code;
//     run::VirtualTime(answered.value()->graph(), library, options).run();
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "plan/graph.hpp"
#include "run/answers.hpp"

namespace vagus::embed {

class AnsweredPlan {
public:
    // The answers are the key "answers" of a JSON file. `alone`: there is no bus either, so
    // supervisors that need one raise nothing unless they are named, and an actor that needs one
    // and has no answer is an Error. The graph is borrowed.
    static Result<std::unique_ptr<AnsweredPlan>> read(const std::string& path,
                                                      const plan::Graph& graph, bool alone);

    const run::Answers& answers() const { return answers_; }
    // To run with.
    const plan::Graph& graph() const { return graph_; }

private:
    explicit AnsweredPlan(run::Answers answers) : answers_(std::move(answers)) {}

    run::Answers answers_;
    plan::Graph graph_;
};

}  // namespace vagus::embed
