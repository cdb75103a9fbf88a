// Plays one way through a plan: each actor ends, each supervisor raises as the way says, a second
// after what came before (computations at once). For paths that exploration has found
// (plan/explore.hpp).
//
//     const plan::Graph graph = with_checks_in_time(found, [](const auto&) { return true; });
//     PlayedPath path(finding.path);
//     options.code_source = &path;
//     VirtualTime run(graph, library, options);
//     path.at_its_end([&run] { run.abort(); });
//     run.run();
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plan/explore.hpp"
#include "run/code_source.hpp"

namespace vagus::run {

class PlayedPath final : public CodeSource {
public:
    // Without a step of the kind Skip: nobody knows what happens in it.
    explicit PlayedPath(const std::vector<plan::ExploreStep>& path);

    // Called, once or more often, when all steps have been taken and the code of the actor starts
    // to which they led. Not if they ended the run.
    void at_its_end(std::function<void()> end) { end_ = std::move(end); }
    // The number of steps that were not taken; 0: the run went all the way.
    size_t left() const { return moves_.size() - next_; }

    std::unique_ptr<Actor> make_actor(const plan::GraphActor& of, const std::string& path,
                                      Time now) override;
    std::unique_ptr<Supervisor> make_supervisor(const plan::GraphSupervisor& of,
                                                const std::string& path, Time now) override;

private:
    class PlayedActor;
    class PlayedSupervisor;
    struct Who {
        std::string path;
        std::string element;
        bool operator==(const Who&) const = default;
    };
    struct Move {
        Who who;
        std::string outcome;  // empty: fails
    };

    // The next move, if it is this one's.
    const Move* turn_of(const Who& who) const;
    void take(Time now);
    bool over() const { return next_ == moves_.size(); }

    std::vector<Move> moves_;
    size_t next_ = 0;
    Time due_;  // of the next move
    std::function<void()> end_;
};

}  // namespace vagus::run
