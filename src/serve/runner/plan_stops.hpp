// The breakpoints that pages have set, in the debugger of the plan that runs: added, changed and
// removed as the list says, and how often each was hit.
//
//     PlanStops stops;
//     stops.want(list);    // the whole list, each time it changes
//     stops.tend(*talk);   // now and then
//     if (const auto list = stops.news()) tell(*list);
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "serve/runner/plan_talk.hpp"
#include "serve/talk/news.hpp"
#include "serve/talk/orders.hpp"

namespace vagus::serve {

class PlanStops {
public:
    // What the server told.
    void want(std::vector<talk::BreakpointOrder> list) { wanted_ = std::move(list); }
    // Posts what differs, and asks for the hits, once what was asked before is answered.
    void tend(PlanTalk& talk);
    // A run has begun or ended: nothing is set.
    void forget();

    // What became of them, if that is another thing than what was given before.
    std::optional<std::vector<talk::BreakpointNow>> news();
    // Numbers of the pages for those of the debugger.
    std::vector<uint64_t> numbers(const std::vector<int>& ids) const;

private:
    struct Known {
        talk::BreakpointOrder wanted;  // as it was posted
        std::optional<int> id;         // at the debugger, once it is set
        std::string why;               // why it is not, or why its condition cannot be evaluated
        uint64_t hits = 0;
    };
    void post_differences(PlanTalk& talk);
    void add(PlanTalk& talk, const talk::BreakpointOrder& wanted);
    void drop(PlanTalk& talk, const Known& known);
    void ask_for_hits(PlanTalk& talk);
    void note(const std::vector<run::Breakpoint>& list);

    std::vector<talk::BreakpointOrder> wanted_, posted_;
    std::optional<std::vector<talk::BreakpointNow>> told_;
    std::map<uint64_t, Known> known_;
    int waiting_ = 0;  // answers
};

}  // namespace vagus::serve
