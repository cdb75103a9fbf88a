// The situations that a plan can get into, and the steps between them. Only explore*.cpp include
// this; what it means is in explore.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "plan/explore.hpp"
#include "plan/graph.hpp"

namespace vagus::plan {

// One plan of a situation.
struct StackLevel {
    int plan = 0;
    int actor = 0;                    // the active one
    std::optional<PlanResult> ended;  // its sub-plan has ended so; its state is to follow
    std::vector<int> resting;         // global supervisors, ascending
};
using Stack = std::vector<StackLevel>;  // the outermost first

using SituationId = uint32_t;
constexpr SituationId kNoSituation = UINT32_MAX;

enum class WalkKind : uint8_t {
    End,
    OwnEvent,
    GlobalEvent,
    Call,
    ActorError,
    OwnError,
    GlobalError,
    Skip,
};

struct WalkStep {
    SituationId from = 0;
    SituationId to = 0;
    int32_t element = 0;   // supervisor among its kind; of an actor: itself
    uint16_t outcome = 0;  // state, event, or result of what is skipped
    uint8_t level = 0;     // of the element
    WalkKind kind = WalkKind::End;
    bool timeless = false;  // no time passes
    bool is_way = true;     // counts as a way to the end
};

class Walk {
public:
    // Both are borrowed.
    Walk(const std::vector<Plan>& plans, const Graph& graph, const ExploreOptions& options);

    const std::vector<Plan>& plans() const { return plans_; }
    const Graph& graph() const { return graph_; }
    // In the order in which they were met, the start first. Those at which the run is over are
    // among them.
    SituationId count() const { return static_cast<SituationId>(keys_.size()); }
    bool is_over(SituationId situation) const { return (*keys_[situation])[0] == kOver; }
    Stack stack(SituationId situation) const;
    // All of them, in the order of the situations that they leave.
    const std::vector<WalkStep>& steps() const { return steps_; }
    // Those that leave the situation: from, and one behind the last.
    size_t first_step(SituationId situation) const { return first_step_[situation]; }
    size_t last_step(SituationId situation) const { return first_step_[situation + 1]; }
    // The number of the step by which the situation was met first; none of the start.
    static constexpr size_t kNoStep = SIZE_MAX;
    size_t met_by(SituationId situation) const { return met_by_[situation]; }
    int distance(SituationId situation) const { return distance_[situation]; }

    bool complete() const { return complete_; }
    bool skipped() const { return skipped_; }

    // The numbers of the steps from the start.
    std::vector<size_t> way_to(SituationId situation) const;
    ExploreStep in_words(const WalkStep& step) const;

    const GraphSupervisor& supervisor(const Stack& stack, const WalkStep& step) const;

private:
    using Key = std::vector<uint32_t>;
    struct HashKey {
        size_t operator()(const Key& key) const;
    };
    static constexpr uint32_t kOver = UINT32_MAX;

    // ---- made once ----
    struct Watcher {
        std::vector<bool> beaten;  // by its event: one before it in its list raises it too
        int look = -1;             // equal for those of period 0 that look at the same; -1: none
    };
    struct Watchers {
        std::vector<Watcher> globals;
        std::vector<std::vector<Watcher>> own;  // by actor
    };
    void find_watchers();
    std::vector<Watcher> watchers_of(const std::vector<Supervisor>& written,
                                     const std::vector<GraphSupervisor>& made);
    int look_of(const GraphSupervisor& supervisor);

    // ---- walking ----
    void walk();
    void leave(SituationId situation);
    void add_events(const Stack& stack);
    void add_events_of(const Stack& stack, int level, WalkKind kind, int index);
    void add_errors(const Stack& stack);
    void add_of_actor(const Stack& stack);
    void add_call(const Stack& stack);
    void add(WalkStep step, SituationId to);
    bool is_beaten(const Watcher& watcher, size_t event) const;
    const Watcher& watcher(const StackLevel& level, WalkKind kind, int index) const;

    // ---- situations ----
    SituationId meet(Key key);
    SituationId meet(const Stack& stack);
    SituationId follow(Stack stack, int level, int target, PlanResult at_terminate, int raised);
    SituationId end_plan(Stack stack, int level, PlanResult result);
    void activate(StackLevel& level, int actor, int raised) const;
    StackLevel started(int plan) const;
    bool is_computation(int plan, int actor) const;
    const GraphPlan& plan_of(const StackLevel& level) const;
    const GraphActor& actor_of(const StackLevel& level) const;

    const std::vector<Plan>& plans_;
    const Graph& graph_;
    const ExploreOptions options_;
    std::vector<Watchers> watchers_;  // by plan
    std::unordered_map<std::string, int> looks_;
    std::vector<std::pair<int, size_t>> raised_before_;  // looks and events of those that rank
                                                         // before, while steps are added

    std::unordered_map<Key, SituationId, HashKey> ids_;
    std::vector<const Key*> keys_;
    std::vector<WalkStep> steps_;
    std::vector<size_t> first_step_;
    std::vector<size_t> met_by_;
    std::vector<int> distance_;
    SituationId leaving_ = 0;
    bool complete_ = true;
    bool skipped_ = false;
};

// A loop in which no time passes: the situation on it that is nearest to the start, and the
// numbers of the steps from it back to it, as few as can be.
struct TimelessLoop {
    SituationId at = 0;
    std::vector<size_t> steps;
    bool leaves = false;  // some state leads out of it, or of a loop that shares a situation
};
std::vector<TimelessLoop> timeless_loops(const Walk& walk);

// A variable without an initial value that an element can read before anything wrote it.
struct UnwrittenRead {
    int plan = 0;
    int slot = 0;
    std::string reader;
    std::vector<size_t> way;  // numbers of steps from the start, as few as can be
};
// Of the plans that can be entered, by their indices.
std::vector<UnwrittenRead> unwritten_reads(const Walk& walk, const std::vector<bool>& entered);

}  // namespace vagus::plan
