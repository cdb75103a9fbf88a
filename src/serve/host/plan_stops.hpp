// The breakpoints that pages have set, in the debugger of the plan that runs: added, changed and
// removed as the list says, and how often each was hit.
//
//     PlanStops stops;
//     stops.want(list);    // the whole list, each time it changes
//     stops.tend(*talk);   // now and then
//     stops.tell(list);    // true: [{number, hits, set, why}] is news
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "serve/host/plan_talk.hpp"

namespace vagus::serve {

class PlanStops {
public:
    using Json = nlohmann::json;

    // What the server told: by number, with the path of the plan's file as `plan`.
    void want(const Json& list) { wanted_ = list; }
    // Posts what differs, and asks for the hits, once what was asked before is answered.
    void tend(PlanTalk& talk);
    // A run has begun or ended: nothing is set.
    void forget();

    bool tell(Json& list);
    // Numbers of the pages for those of the debugger.
    std::vector<uint64_t> numbers(const std::vector<int>& ids) const;

private:
    struct Known {
        Json wanted;            // as it was posted
        std::optional<int> id;  // at the debugger, once it is set
        std::string why;        // why it is not, or why its condition cannot be evaluated
        uint64_t hits = 0;
    };
    void post_differences(PlanTalk& talk);
    void add(PlanTalk& talk, const Json& wanted);
    void drop(PlanTalk& talk, const Known& known);
    void ask_for_hits(PlanTalk& talk);
    void note(const std::vector<run::Breakpoint>& list);

    Json wanted_ = Json::array();
    Json posted_ = Json::array();
    Json told_;
    std::map<uint64_t, Known> known_;
    int waiting_ = 0;  // answers
};

}  // namespace vagus::serve
