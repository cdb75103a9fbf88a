// Variables that are read before anything wrote them: along which steps one stays unwritten.
#include <algorithm>
#include <deque>
#include <set>

#include "plan/explore_walk.hpp"

namespace vagus::plan {

namespace {

// A variable of one plan that runs.
struct Cell {
    int level = 0;
    int slot = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
};

// A situation in which the variable of the plan at `level` is unwritten.
struct Unwritten {
    SituationId at = 0;
    int level = 0;
    size_t step = Walk::kNoStep;  // that led here
    size_t before = SIZE_MAX;     // index of the one that it led from; none: the plan has begun
    int distance = 0;             // from the start of the run
};

// From each beginning of the plan on, the nearest to the start of the run first.
class Reads {
public:
    Reads(const Walk& walk, int plan, int slot) : walk_(walk), plan_(plan), slot_(slot) {
        find_starts();
    }

    std::optional<UnwrittenRead> first() {
        for (size_t next = 0; take_starts(next), next < met_.size(); ++next) {
            const Unwritten here = met_[next];
            const Stack stack = walk_.stack(here.at);
            if (const std::string* reader = reader_at(stack, {here.level, slot_})) {
                return UnwrittenRead{plan_, slot_, *reader, way_to(next)};
            }
            go_on(stack, here, next);
        }
        return std::nullopt;
    }

private:
    const GraphPlan& made(int plan) const { return walk_.graph().plans[static_cast<size_t>(plan)]; }
    const GraphActor& active(const StackLevel& level) const {
        return made(level.plan).actors[static_cast<size_t>(level.actor)];
    }

    // ---- walking ----

    void find_starts() {
        if (plan_ == 0) starts_.push_back({});
        for (size_t i = 0; i < walk_.steps().size(); ++i) {
            const WalkStep& step = walk_.steps()[i];
            if (step.kind != WalkKind::Call) continue;
            if (walk_.stack(step.to).back().plan != plan_) continue;
            starts_.push_back({.at = step.to,
                               .level = step.level + 1,
                               .step = i,
                               .distance = walk_.distance(step.from) + 1});
        }
    }

    // Beginnings that are as near as what is looked at next.
    void take_starts(size_t next) {
        while (!starts_.empty() &&
               (next >= met_.size() || starts_.front().distance <= met_[next].distance)) {
            enter(starts_.front());
            starts_.pop_front();
        }
    }

    void enter(const Unwritten& one) {
        if (known_.emplace(one.at, one.level).second) met_.push_back(one);
    }

    void go_on(const Stack& stack, const Unwritten& here, size_t index) {
        for (size_t i = walk_.first_step(here.at); i < walk_.last_step(here.at); ++i) {
            const WalkStep& step = walk_.steps()[i];
            const bool stays =
                step.level > here.level || (step.level == here.level && plan_goes_on(stack, step));
            if (!stays || writes(stack, step, {here.level, slot_})) continue;
            enter({step.to, here.level, i, index, here.distance + 1});
        }
    }

    bool plan_goes_on(const Stack& stack, const WalkStep& step) const {
        switch (step.kind) {
            case WalkKind::Call:
            case WalkKind::Skip:
                return true;
            case WalkKind::End:
                return active(stack[step.level]).targets[step.outcome] >= 0;
            case WalkKind::OwnEvent:
            case WalkKind::GlobalEvent:
                return walk_.supervisor(stack, step).targets[step.outcome] >= 0;
            case WalkKind::ActorError:
            case WalkKind::OwnError:
            case WalkKind::GlobalError:
                return false;
        }
        return false;
    }

    std::vector<size_t> way_to(size_t last) const {
        std::vector<size_t> way;
        size_t at = last;
        for (; met_[at].before != SIZE_MAX; at = met_[at].before) way.push_back(met_[at].step);
        if (met_[at].step != Walk::kNoStep) {
            way.push_back(met_[at].step);
            std::vector<size_t> before = walk_.way_to(walk_.steps()[met_[at].step].from);
            way.insert(way.end(), before.rbegin(), before.rend());
        }
        std::reverse(way.begin(), way.end());
        return way;
    }

    // ---- reading and writing ----

    // A variable that a plan shares is one of a plan around it.
    Cell owner(const Stack& stack, Cell cell) const {
        while (cell.level > 0) {
            const auto& shared = active(stack[static_cast<size_t>(cell.level) - 1]).shared;
            const auto found = std::find_if(shared.begin(), shared.end(), [cell](const auto& pair) {
                return pair.first == cell.slot;
            });
            if (found == shared.end()) break;
            cell = {cell.level - 1, found->second};
        }
        return cell;
    }

    bool reads(const Stack& stack, const std::vector<GraphInput>& inputs, Cell cell) const {
        const int level = static_cast<int>(stack.size()) - 1;
        for (const GraphInput& input : inputs) {
            for (const int slot : input.slots) {
                if (owner(stack, {level, slot}) == cell) return true;
            }
        }
        return false;
    }

    // Who reads the variable as this situation begins: supervisors in their first check, then the
    // actor. Those of plans around it did so before.
    const std::string* reader_at(const Stack& stack, Cell cell) const {
        const StackLevel& at = stack.back();
        if (at.ended) return nullptr;
        const auto& globals = made(at.plan).globals;
        for (size_t i = 0; i < globals.size(); ++i) {
            const bool rests =
                std::binary_search(at.resting.begin(), at.resting.end(), static_cast<int>(i));
            if (!rests && reads(stack, globals[i].inputs, cell)) return &globals[i].name;
        }
        const GraphActor& actor = active(at);
        for (const GraphSupervisor& own : actor.supervisors) {
            if (reads(stack, own.inputs, cell)) return &own.name;
        }
        return reads(stack, actor.inputs, cell) ? &actor.name : nullptr;
    }

    bool writes(const Stack& stack, const WalkStep& step, Cell cell) const {
        const StackLevel& at = stack[step.level];
        const auto is_cell = [&](int slot) { return owner(stack, {step.level, slot}) == cell; };
        const auto any_of = [&is_cell](const std::vector<GraphOutput>& outputs) {
            return std::any_of(outputs.begin(), outputs.end(),
                               [&is_cell](const GraphOutput& one) { return is_cell(one.slot); });
        };
        switch (step.kind) {
            case WalkKind::End:
                return at.ended != PlanResult::Error && any_of(active(at).outputs);
            case WalkKind::OwnEvent:
            case WalkKind::GlobalEvent:
                return any_of(walk_.supervisor(stack, step).outputs);
            case WalkKind::Skip: {  // nobody has looked what it writes of what it shares
                const auto& shared = active(at).shared;
                return std::any_of(shared.begin(), shared.end(),
                                   [&is_cell](const auto& pair) { return is_cell(pair.second); });
            }
            case WalkKind::Call:
            case WalkKind::ActorError:
            case WalkKind::OwnError:
            case WalkKind::GlobalError:
                return false;
        }
        return false;
    }

    const Walk& walk_;
    const int plan_;
    const int slot_;
    std::deque<Unwritten> starts_;  // the nearest first, as the steps are
    std::vector<Unwritten> met_;
    std::set<std::pair<SituationId, int>> known_;  // situation and level
};

}  // namespace

std::vector<UnwrittenRead> unwritten_reads(const Walk& walk, const std::vector<bool>& entered) {
    std::vector<UnwrittenRead> found;
    const auto& plans = walk.plans();
    for (size_t p = 0; p < plans.size(); ++p) {
        if (!entered[p]) continue;
        for (size_t v = 0; v < plans[p].configuration.size(); ++v) {
            const Variable& variable = plans[p].configuration[v];
            const bool starts_empty =
                variable.access == Access::Local || variable.access == Access::Out;
            if (!starts_empty || variable.initial) continue;
            auto read = Reads(walk, static_cast<int>(p), static_cast<int>(v)).first();
            if (read) found.push_back(std::move(*read));
        }
    }
    return found;
}

}  // namespace vagus::plan
