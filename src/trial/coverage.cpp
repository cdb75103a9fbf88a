#include "trial/coverage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/json.hpp"
#include "run/traced_variables.hpp"

namespace vagus::trial {

namespace {

void add_counts(PlanCoverage::Counts& to, const PlanCoverage::Counts& from) {
    for (const auto& [name, count] : from) to[name] += count;
}

std::string pair_of(std::string_view from, std::string_view to) {
    return fmt::format("{}, {}", from, to);
}

// Where it leads is an actor: the two can follow each other.
void add_pair(PlanCoverage& to, const plan::GraphPlan& plan, std::string_view from, int target) {
    if (target < 0) return;
    to.pairs[pair_of(from, plan.actors[static_cast<size_t>(target)].name)];
}

void add_supervisor(PlanCoverage& to, const plan::GraphSupervisor& supervisor,
                    const std::string& name) {
    to.supervisors[name];
    for (const plan::Outcome& event : supervisor.of->outcomes) {
        to.events[name + ": " + event.name];
    }
}

// Everything that the plan has, with 0.
PlanCoverage all_of(const plan::GraphPlan& plan) {
    PlanCoverage all;
    for (const plan::GraphSupervisor& global : plan.globals) {
        add_supervisor(all, global, global.name);
    }
    for (const plan::GraphActor& actor : plan.actors) {
        all.actors[actor.name];
        for (const std::string& state : actor.states) all.states[actor.name + ": " + state];
        for (const int target : actor.targets) add_pair(all, plan, actor.name, target);
        for (const plan::GraphSupervisor& own : actor.supervisors) {
            add_supervisor(all, own, actor.name + "." + own.name);
            for (const int target : own.targets) add_pair(all, plan, actor.name, target);
        }
        for (const plan::GraphSupervisor& global : plan.globals) {
            for (const int target : global.targets) add_pair(all, plan, actor.name, target);
        }
    }
    return all;
}

}  // namespace

void Coverage::add(const Coverage& other) {
    for (const auto& [file, from] : other.plans) {
        PlanCoverage& to = plans[file];
        for (const CoverageKind& kind : coverage_kinds()) {
            add_counts(to.*kind.counts, from.*kind.counts);
        }
    }
    for (const auto& [file, from] : other.scripts) {
        const auto [at, is_new] = scripts.try_emplace(file);
        ScriptCoverage& to = at->second;
        to.only_told = from.only_told && (is_new || to.only_told);
        for (const auto& [line, count] : from.lines) to.lines[line] += count;
        for (const auto& [branch, counts] : from.branches) {
            for (size_t i = 0; i < counts.size(); ++i) to.branches[branch][i] += counts[i];
        }
    }
}

const std::vector<CoverageKind>& coverage_kinds() {
    static const std::vector<CoverageKind> kKinds = {{"actors", &PlanCoverage::actors},
                                                     {"states", &PlanCoverage::states},
                                                     {"supervisors", &PlanCoverage::supervisors},
                                                     {"events", &PlanCoverage::events},
                                                     {"pairs", &PlanCoverage::pairs}};
    return kKinds;
}

// ---- counting ----

PlanCounter::PlanCounter(const plan::Graph& graph) : graph_(graph) {
    for (const plan::GraphPlan& plan : graph.plans) counts_.push_back(all_of(plan));
}

void PlanCounter::start(size_t level, std::string_view actor) {
    Level& here = levels_[level];
    PlanCoverage& counts = counts_of(level);
    ++counts.actors[std::string(actor)];
    if (!here.actor.empty()) ++counts.pairs[pair_of(here.actor, actor)];
    here.actor = actor;
    const plan::GraphPlan& plan = graph_.plans[here.plan];
    const int index = plan::find_actor(plan, actor);
    here.sub_plan = index < 0 ? -1 : plan.actors[static_cast<size_t>(index)].sub_plan;
}

std::string PlanCounter::name_of(size_t level, const plan::EventRaised& raised) const {
    return raised.global ? std::string(raised.supervisor)
                         : fmt::format("{}.{}", levels_[level].actor, raised.supervisor);
}

bool PlanCounter::fits(const plan::TraceEvent& event) const {
    const auto level = static_cast<size_t>(run::level_of(event));
    if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        return level == 0 || (level <= levels_.size() && levels_[level - 1].sub_plan >= 0);
    }
    if (level >= levels_.size()) return false;
    const PlanCoverage& counts = counts_[levels_[level].plan];
    if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        return counts.actors.contains(std::string(started->actor));
    }
    if (const auto* ended = std::get_if<plan::ActorEnded>(&event.what)) {
        return counts.states.contains(fmt::format("{}: {}", ended->actor, ended->state));
    }
    if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        return counts.events.contains(
            fmt::format("{}: {}", name_of(level, *raised), raised->event));
    }
    return true;
}

void PlanCounter::see(const plan::TraceEvent& event) {
    const auto level = static_cast<size_t>(run::level_of(event));
    if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        const size_t plan = level == 0 ? 0 : static_cast<size_t>(levels_[level - 1].sub_plan);
        levels_.resize(level);
        levels_.push_back({.plan = plan});
    } else if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        start(level, started->actor);
    } else if (const auto* ended = std::get_if<plan::ActorEnded>(&event.what)) {
        ++counts_of(level).states[fmt::format("{}: {}", ended->actor, ended->state)];
    } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        const std::string name = name_of(level, *raised);
        ++counts_of(level).supervisors[name];
        ++counts_of(level).events[fmt::format("{}: {}", name, raised->event)];
    }
}

Coverage PlanCounter::coverage() const {
    Coverage coverage;
    for (size_t i = 0; i < counts_.size(); ++i) {
        coverage.plans.emplace(graph_.plans[i].file, counts_[i]);
    }
    return coverage;
}

// ---- for people ----

namespace {

template <typename Map, typename Taken>
std::string share(const Map& map, Taken taken) {
    const auto count = std::count_if(map.begin(), map.end(), taken);
    return fmt::format("{} of {}", count, map.size());
}

std::string branches_taken(const ScriptCoverage& script) {
    size_t taken = 0;
    for (const auto& [branch, counts] : script.branches) {
        for (const uint64_t count : counts) taken += count > 0 ? 1 : 0;
    }
    return fmt::format("{} of {}", taken, script.branches.size() * 2);
}

}  // namespace

std::string format_table(const Coverage& coverage) {
    std::string text;
    for (const auto& [file, plan] : coverage.plans) {
        text += file + "\n";
        for (const CoverageKind& kind : coverage_kinds()) {
            const auto taken = [](const auto& one) { return one.second > 0; };
            text += fmt::format("  {:<12} {}\n", kind.name, share(plan.*kind.counts, taken));
        }
    }
    for (const auto& [file, script] : coverage.scripts) {
        const auto taken = [](const auto& one) { return one.second > 0; };
        if (script.only_told) {
            text += fmt::format("{}\n  {:<12} {} that frames tell of\n", file, "lines",
                                script.lines.size());
            continue;
        }
        text += fmt::format("{}\n  {:<12} {}\n  {:<12} {}\n", file, "lines",
                            share(script.lines, taken), "branches", branches_taken(script));
    }
    return text;
}

std::string format_missing(const PlanCoverage& coverage) {
    std::string text;
    for (const CoverageKind& kind : coverage_kinds()) {
        for (const auto& [name, count] : coverage.*kind.counts) {
            if (count == 0) text += fmt::format("  {:<12} {}\n", kind.name, name);
        }
    }
    return text;
}

std::string format_told(const ScriptCoverage& coverage) {
    std::string text;
    for (const auto& [line, count] : coverage.lines) {
        text += fmt::format("  {:<12} {}: {}\n", "line", line, count);
    }
    return text;
}

std::string format_lcov(const Coverage& coverage) {
    std::string text;
    for (const auto& [file, script] : coverage.scripts) {
        if (script.only_told) continue;
        text += fmt::format("{}{}\n", kLcovBegins, file);
        for (const auto& [branch, counts] : script.branches) {
            const auto [line, number] = branch;
            const bool reached = counts[0] + counts[1] > 0;
            for (size_t way = 0; way < counts.size(); ++way) {
                text += fmt::format("BRDA:{},{},{},{}\n", line, number, way,
                                    reached ? std::to_string(counts[way]) : "-");
            }
        }
        const auto hit = [](const auto& one) { return one.second > 0; };
        size_t branches_hit = 0;
        for (const auto& [branch, counts] : script.branches) {
            for (const uint64_t count : counts) branches_hit += count > 0 ? 1 : 0;
        }
        text += fmt::format("BRF:{}\nBRH:{}\n", script.branches.size() * 2, branches_hit);
        for (const auto& [line, count] : script.lines)
            text += fmt::format("DA:{},{}\n", line, count);
        text += fmt::format("LF:{}\nLH:{}\nend_of_record\n", script.lines.size(),
                            std::count_if(script.lines.begin(), script.lines.end(), hit));
    }
    return text;
}

// ---- through a pipe ----

namespace {

std::string counts_json(const PlanCoverage::Counts& counts) {
    std::string text = "{";
    for (const auto& [name, count] : counts) {
        text += fmt::format("{}{}:{}", text.size() > 1 ? "," : "", json_quote(name), count);
    }
    return text + "}";
}

PlanCoverage::Counts read_counts(const JsonValue& json) {
    PlanCoverage::Counts counts;
    for (const JsonMember& one : json.members) {
        counts[one.key] = static_cast<uint64_t>(one.value.integer);
    }
    return counts;
}

std::string script_json(const ScriptCoverage& script) {
    std::string text = "[";
    const auto add = [&text](int line, int branch, uint64_t a, uint64_t b) {
        text += fmt::format("{}[{},{},{},{}]", text.size() > 1 ? "," : "", line, branch, a, b);
    };
    for (const auto& [line, count] : script.lines) add(line, -1, count, 0);
    for (const auto& [branch, counts] : script.branches) {
        add(branch.first, branch.second, counts[0], counts[1]);
    }
    return text + "]";
}

ScriptCoverage read_script(const JsonValue& json) {
    ScriptCoverage script;
    for (const JsonValue& one : json.items) {
        const auto number = [&one](size_t i) { return one.items[i].integer; };
        const int line = static_cast<int>(number(0));
        const int branch = static_cast<int>(number(1));
        const auto count = [&](size_t i) { return static_cast<uint64_t>(number(i)); };
        if (branch < 0) {
            script.lines[line] = count(2);
        } else {
            script.branches[{line, branch}] = {count(2), count(3)};
        }
    }
    return script;
}

}  // namespace

std::string format_coverage(const Coverage& coverage) {
    std::string plans, scripts;
    for (const auto& [file, plan] : coverage.plans) {
        std::string kinds;
        for (const CoverageKind& kind : coverage_kinds()) {
            kinds += fmt::format("{}{}:{}", kinds.empty() ? "" : ",", json_quote(kind.name),
                                 counts_json(plan.*kind.counts));
        }
        plans += fmt::format("{}{}:{{{}}}", plans.empty() ? "" : ",", json_quote(file), kinds);
    }
    for (const auto& [file, script] : coverage.scripts) {
        scripts += fmt::format("{}{}:{}", scripts.empty() ? "" : ",", json_quote(file),
                               script_json(script));
    }
    return fmt::format("{{\"plans\":{{{}}},\"scripts\":{{{}}}}}", plans, scripts);
}

Coverage read_coverage(const JsonValue& json) {
    Coverage coverage;
    for (const JsonMember& one : json.find("plans")->members) {
        PlanCoverage& plan = coverage.plans[one.key];
        for (const CoverageKind& kind : coverage_kinds()) {
            plan.*kind.counts = read_counts(*one.value.find(kind.name));
        }
    }
    for (const JsonMember& one : json.find("scripts")->members) {
        coverage.scripts[one.key] = read_script(one.value);
    }
    return coverage;
}

}  // namespace vagus::trial
