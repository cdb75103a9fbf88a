// A plan tried by hand: whoever tries it chooses how each actor ends and which supervisor raises, a
// second after what came before; computations compute as ever. The same choices give the same way,
// so a way is taken again from its beginning for each choice that is added.
//
//     TriedWay way({{"Hall", "forward", "LaneNotFree"}, {"Hall", "near", "Near"}});
//     const plan::Graph to_run = with_checks_in_time(graph, [](const auto&) { return true; });
//     options.code_source = &way;
//     VirtualTime run(to_run, library, options);
//     way.at_its_end([&run] { run.abort(); });
//     run.run();
//     const std::string answers = way.answers(graph);     // for a test that takes the same way
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "run/code_source.hpp"

namespace vagus::run {

constexpr size_t kTriedMax = 1'000;  // choices of a way

struct TriedChoice {
    std::string path;     // of the plan: "Hall/call"
    std::string element;  // the actor that ends, or the supervisor that raises
    std::string outcome;  // its state, or its event
    // Of an actor: outputs by name. Those that are missing write nothing.
    std::vector<std::pair<std::string, plan::Value>> out = {};
};

class TriedWay final : public CodeSource {
public:
    explicit TriedWay(std::vector<TriedChoice> way) : way_(std::move(way)) {}

    // Called when nothing is left to do but what nobody has chosen yet, or when the next choice
    // cannot be taken: it is another one's turn. Not if the plan ended.
    void at_its_end(std::function<void()> end) { end_ = std::move(end); }
    // The number of choices that were not taken; 0: the run went all the way.
    size_t left() const { return way_.size() - next_; }

    // What an actor did, in their order; computations are left out.
    struct Turn {
        std::string path;
        std::string actor;
        Time started{};
        std::optional<Time> ended = {};
        std::string state = {};  // in which it ended by itself, with these outputs; else
        std::vector<std::pair<std::string, plan::Value>> out = {};
        std::string by = {};  // SUPERVISOR.EVENT that interrupted it
    };
    const std::vector<Turn>& turns() const { return turns_; }
    // When each choice was taken.
    const std::vector<Time>& taken() const { return taken_; }
    // The actor that waits to be told how it ends; nullptr: none does.
    const Turn* waits() const { return waits_ ? &turns_.back() : nullptr; }
    // Its part of the graph: states, and the outputs that the plan uses.
    const plan::GraphActor* waits_of() const { return waits_ ? &waits_of_ : nullptr; }

    // The member "answers" of a test (run/answers.hpp) as JSON: with it a run takes this way, and
    // what was not chosen never comes.
    std::string answers(const plan::Graph& graph) const;

    std::unique_ptr<Actor> make_actor(const plan::GraphActor& of, const std::string& path,
                                      Time now) override;
    std::unique_ptr<Supervisor> make_supervisor(const plan::GraphSupervisor& of,
                                                const std::string& path, Time now) override;

private:
    class TriedActor;
    class TriedSupervisor;

    // The next choice, if it is this one's.
    const TriedChoice* turn_of(const std::string& path, const std::string& element) const;
    void take(Time now);
    bool over() const { return next_ == way_.size(); }

    std::vector<TriedChoice> way_;
    size_t next_ = 0;
    Time due_ = std::chrono::seconds(1);  // of the next choice
    std::vector<Time> taken_;
    std::vector<Turn> turns_;
    bool waits_ = false;
    plan::GraphActor waits_of_;
    std::map<std::string, std::vector<Time>> raised_;  // by SUPERVISOR.EVENT
    std::string last_raised_;
    std::function<void()> end_ = [] {};
};

}  // namespace vagus::run
