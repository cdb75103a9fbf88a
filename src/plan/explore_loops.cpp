// Loops in which no time passes: circles of steps that take none.
#include <algorithm>
#include <unordered_map>

#include "plan/explore_walk.hpp"

namespace vagus::plan {

namespace {

// By situation, a number: equal for those that lead to each other without time. Tarjan's way,
// with a stack of its own.
std::vector<uint32_t> timeless_components(const Walk& walk) {
    struct Visit {
        SituationId at;
        size_t step;
    };
    constexpr uint32_t kNone = UINT32_MAX;
    std::vector<uint32_t> index(walk.count(), kNone);
    std::vector<uint32_t> low(walk.count());
    std::vector<uint32_t> component(walk.count(), kNone);
    std::vector<SituationId> open;
    uint32_t next = 0;
    uint32_t components = 0;
    for (SituationId root = 0; root < walk.count(); ++root) {
        if (index[root] != kNone) continue;
        std::vector<Visit> visits = {{root, walk.first_step(root)}};
        while (!visits.empty()) {
            Visit& visit = visits.back();
            const SituationId at = visit.at;
            if (index[at] == kNone) {
                index[at] = low[at] = next++;
                open.push_back(at);
            }
            if (visit.step < walk.last_step(at)) {
                const WalkStep& step = walk.steps()[visit.step++];
                if (!step.timeless) continue;
                if (index[step.to] == kNone) {
                    visits.push_back({step.to, walk.first_step(step.to)});
                } else if (component[step.to] == kNone) {
                    low[at] = std::min(low[at], index[step.to]);
                }
                continue;
            }
            visits.pop_back();
            if (!visits.empty()) {
                uint32_t& above = low[visits.back().at];
                above = std::min(above, low[at]);
            }
            if (low[at] != index[at]) continue;
            for (SituationId one = kNoSituation; one != at;) {
                one = open.back();
                open.pop_back();
                component[one] = components;
            }
            ++components;
        }
    }
    return component;
}

// The steps from the situation back to it, inside its component; empty: there are none.
std::vector<size_t> timeless_loop(const Walk& walk, SituationId start,
                                  const std::vector<uint32_t>& component) {
    std::unordered_map<SituationId, size_t> met_by;
    std::vector<SituationId> open = {start};
    for (size_t next = 0; next < open.size() && !met_by.contains(start); ++next) {
        const SituationId at = open[next];
        for (size_t i = walk.first_step(at); i < walk.last_step(at); ++i) {
            const WalkStep& step = walk.steps()[i];
            if (!step.timeless || component[step.to] != component[start]) continue;
            if (met_by.emplace(step.to, i).second) open.push_back(step.to);
        }
    }
    std::vector<size_t> loop;
    if (!met_by.contains(start)) return loop;
    SituationId at = start;
    do {
        loop.push_back(met_by.at(at));
        at = walk.steps()[loop.back()].from;
    } while (at != start);
    std::reverse(loop.begin(), loop.end());
    return loop;
}

bool leaves_loop(const Walk& walk, const std::vector<uint32_t>& component, uint32_t loop) {
    return std::any_of(walk.steps().begin(), walk.steps().end(),
                       [&component, loop](const WalkStep& step) {
                           return step.kind == WalkKind::End && component[step.from] == loop &&
                                  component[step.to] != loop;
                       });
}

}  // namespace

std::vector<TimelessLoop> timeless_loops(const Walk& walk) {
    const std::vector<uint32_t> component = timeless_components(walk);
    std::vector<TimelessLoop> loops;
    std::vector<bool> done(walk.count());  // by component
    for (SituationId i = 0; i < walk.count(); ++i) {
        if (done[component[i]]) continue;
        TimelessLoop loop{.at = i, .steps = timeless_loop(walk, i, component)};
        if (loop.steps.empty()) continue;
        done[component[i]] = true;
        loop.leaves = leaves_loop(walk, component, component[i]);
        loops.push_back(std::move(loop));
    }
    return loops;
}

}  // namespace vagus::plan
