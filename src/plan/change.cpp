#include "plan/change.hpp"

#include <fmt/format.h>

#include <set>

namespace vagus::plan {

namespace {

constexpr std::string_view kWait =
    "put it back, or save again when the run has gone on, or stop the run and start it again";
constexpr std::string_view kOrAnew = "or stop the run and start it again";

std::string_view name_of(Access access) {
    switch (access) {
        case Access::Local:
            return "none";
        case Access::In:
            return "in";
        case Access::Out:
            return "out";
        case Access::InOut:
            return "inout";
        case Access::Shared:
            break;
    }
    return "shared";
}

// Which inputs the plan feeds, in no order.
std::set<std::string> fed_names(const std::vector<GraphInput>& inputs) {
    std::set<std::string> names;
    for (const GraphInput& input : inputs) {
        if (input.fed) names.insert(input.name);
    }
    return names;
}

std::string listed(const std::set<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "none" : list;
}

class Comparison {
public:
    Comparison(const Underway& underway, const GraphPlan& next) : now_(underway), next_(next) {}

    std::vector<std::string> reasons() {
        for (const GraphVariable& variable : now_.plan->variables) compare(variable);
        if (now_.actor) compare_active(*now_.actor);
        for (const GraphSupervisor* const one : now_.watching) {
            compare("the global supervisor", *one, next_.globals);
        }
        const std::string_view follows = now_.on_its_way_to;
        if (!follows.empty() && find_actor(next_, follows) < 0) {
            say("the actor \"{}\" follows the one that is being stopped now, and the new version "
                "has none of that name; {}",
                follows, kWait);
        }
        return std::move(reasons_);
    }

private:
    template <typename... Parts>
    void say(fmt::format_string<Parts...> format, Parts&&... parts) {
        reasons_.push_back(
            fmt::format("{}: {}", now_.path, fmt::format(format, std::forward<Parts>(parts)...)));
    }

    void compare(const GraphVariable& now) {
        const int slot = find_variable(next_, now.name);
        if (slot < 0) return;
        const GraphVariable& next = next_.variables[static_cast<size_t>(slot)];
        if (next.type != now.type) {
            say("the variable \"{}\" holds a value of the type {}, and the new version says {}; "
                "give it a new name, {}",
                now.name, name_of(now.type), name_of(next.type), kOrAnew);
        }
        if (next.access != now.access) {
            say("the variable \"{}\" runs with the access {}, and the new version says {}; give "
                "it a new name, {}",
                now.name, name_of(now.access), name_of(next.access), kOrAnew);
        }
    }

    void compare_active(const GraphActor& now) {
        const int index = find_actor(next_, now.name);
        if (index < 0) {
            say("the actor \"{}\" is active, and the new version has none of that name; {}",
                now.name, kWait);
            return;
        }
        const GraphActor& next = next_.actors[static_cast<size_t>(index)];
        if (next.of != now.of || next.sub_plan_file != now.sub_plan_file) {
            say("the actor \"{}\" is active as {}, and the new version makes it {}; {}", now.name,
                kind_of(now), kind_of(next), kWait);
        }
        compare_inputs("the actor", now.name, now.inputs, next.inputs);
        for (const GraphSupervisor& one : now.supervisors) {
            compare("the supervisor", one, next.supervisors);
        }
    }

    void compare(std::string_view what, const GraphSupervisor& now,
                 const std::vector<GraphSupervisor>& among) {
        const int index = find_supervisor(among, now.name);
        if (index < 0) {
            say("{} \"{}\" watches, and in the new version there is none of that name at its "
                "place; {}",
                what, now.name, kWait);
            return;
        }
        const GraphSupervisor& next = among[static_cast<size_t>(index)];
        if (next.of != now.of) {
            say("{} \"{}\" watches as {}, and the new version makes it {}; {}", what, now.name,
                now.of->name, next.of->name, kWait);
        }
        if (next.period_us != now.period_us) {
            say("{} \"{}\" watches with period_ms {}, and the new version says {}; {}", what,
                now.name, now.period_us / 1000, next.period_us / 1000, kWait);
        }
        compare_inputs(what, now.name, now.inputs, next.inputs);
    }

    void compare_inputs(std::string_view what, const std::string& name,
                        const std::vector<GraphInput>& now, const std::vector<GraphInput>& next) {
        const std::set<std::string> fed = fed_names(now);
        const std::set<std::string> fed_next = fed_names(next);
        if (fed == fed_next) return;
        say("{} \"{}\" works with the inputs {}, and the new version feeds {}; {}", what, name,
            listed(fed), listed(fed_next), kWait);
    }

    static std::string kind_of(const GraphActor& actor) {
        return actor.of ? actor.of->name : "the plan " + actor.sub_plan_file;
    }

    const Underway& now_;
    const GraphPlan& next_;
    std::vector<std::string> reasons_;
};

}  // namespace

std::vector<std::string> reasons_against(const Underway& underway, const GraphPlan& next) {
    return Comparison(underway, next).reasons();
}

}  // namespace vagus::plan
