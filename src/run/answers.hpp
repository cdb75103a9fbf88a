// Answers instead of work: actors that end by themselves, supervisors that raise at a time, for
// runs without a world and without nodes (docs/explore.md).
//
//     "answers": { "Forward": [{ "after": 2, "state": "LaneNotFree" }, { "state": "Done" }],
//                  "measure": [{ "state": "Done", "out": { "distance": 30 } }],
//                  "sonar.near": [{ "at": 3.5 }] }
//
// A name with a dot is SUPERVISOR.EVENT, all others an actor, or a template for all its actors that
// are not named themselves. The first running takes the first answer, and so on; the last holds for
// all that follow. A supervisor raises at its first check at or after each `at` (s since the start
// of the run), if it watches then; apart from that a named one raises nothing.
//
//     const Answers answers = Answers::read(json, "hall.test.json", graph).value();
//     AnsweringCode code(answers);                     // for one run
//     const plan::Graph to_run = answers.checked_in_time(graph);
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "base/result.hpp"
#include "run/code_source.hpp"

namespace vagus::run {

constexpr size_t kAnswersMax = 10'000;     // together
constexpr double kAnswerSecondsMax = 1e9;  // of `after` and `at`

// Of an actor or template.
struct ActorAnswer {
    Duration after{};
    std::string state;  // empty: the first
    std::vector<std::pair<std::string, plan::Value>> out;
};

struct Answers {
    std::map<std::string, std::vector<ActorAnswer>> actors;  // by name of actor or template
    std::map<std::string, std::vector<Time>> events;         // by SUPERVISOR.EVENT, ascending

    // The Error says FILE:LINE:COL, and names what the plans of the graph do not have.
    static Result<Answers> read(const JsonValue& json, const std::string& file,
                                const plan::Graph& graph);
    bool name(const plan::GraphSupervisor& supervisor) const;
    // To run with: those of period 0 that are named are checked in time (code_source.hpp).
    plan::Graph checked_in_time(plan::Graph graph) const;
};

class AnsweringCode final : public CodeSource {
public:
    // Borrowed for the run.
    explicit AnsweringCode(const Answers& answers) : answers_(answers) {}

    std::unique_ptr<Actor> make_actor(const plan::GraphActor& of, const std::string& path,
                                      Time now) override;
    std::unique_ptr<Supervisor> make_supervisor(const plan::GraphSupervisor& of,
                                                const std::string& path, Time now) override;

private:
    class AnsweringActor;
    class AnsweringSupervisor;

    const Answers& answers_;
    std::map<std::string, size_t> runnings_;  // by name, so far
    std::map<std::string, size_t> raised_;    // by SUPERVISOR.EVENT, so far
};

}  // namespace vagus::run
