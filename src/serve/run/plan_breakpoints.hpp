// Breakpoints of plans as the project keeps them: on an actor, a state, an event or a condition,
// whether the plan runs or not, until a person removes them. The run's own are made from these.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "serve/json.hpp"
#include "serve/talk/news.hpp"
#include "serve/talk/orders.hpp"

namespace vagus::serve {

constexpr size_t kPlanBreakpointsMax = 1000;

struct PlanBreakpoint {
    uint64_t number = 0;  // never used twice in a session
    std::string doc;
    std::string kind;  // actor, state, event, condition
    std::string element;
    std::string outcome;  // of a state or event; empty: any
    std::string condition;
    uint64_t stop_at = 1;  // it stops at this hit and each after it
    bool enabled = true;
    // ---- of this run ----
    uint64_t hits = 0;
    bool set = false;  // the debugger of the plan said so
    std::string why;   // why it is not, or why its condition cannot be evaluated
};

class PlanBreakpoints {
public:
    const std::vector<PlanBreakpoint>& all() const { return all_; }
    // A new one, or the one there is: by its number, else by place (a condition by its text).
    Result<PlanBreakpoint*> set(const PlanBreakpoint& wanted);
    // Whether one is at that place already: what is there may have been deleted since.
    bool stands_at(const PlanBreakpoint& place) const;
    // Whether the one that is meant has that condition already.
    bool has_condition(const PlanBreakpoint& wanted) const;
    // Without a number all of the document, without a document all.
    void clear(std::optional<uint64_t> number, const std::optional<std::string>& doc);
    // A file has another name.
    void rename(const std::string& from, const std::string& to);

    // What the runner is told; `path_of` gives the file of a document.
    std::vector<talk::BreakpointOrder> orders(
        const std::function<std::string(const std::string& doc)>& path_of) const;
    // What it told; those that are not in the list are not set any more, and keep their hits. True
    // if that is news.
    bool note(const std::vector<talk::BreakpointNow>& list);
    // [PlanBreakpoint] of the protocol.
    Json list() const;

    // What state.json keeps.
    Json to_json() const;
    void from_json(const Json& kept);

private:
    PlanBreakpoint* find(const PlanBreakpoint& wanted);

    std::vector<PlanBreakpoint> all_;
    uint64_t last_ = 0;
};

}  // namespace vagus::serve
