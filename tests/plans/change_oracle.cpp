#include "tests/plans/change_oracle.hpp"

#include <algorithm>

namespace vagus {

using Json = ChangeOracle::Json;

namespace {

Json part(const Json& of, const char* key) {
    return of.contains(key) ? of[key] : Json::object();
}

std::set<std::string> names(const Json& object) {
    std::set<std::string> found;
    for (const auto& [name, value] : object.items()) found.insert(name);
    return found;
}

bool is_computation(const Json& actor) {
    static const std::set<std::string> kComputations = {"Assign", "Compare", "For", "Random"};
    return actor.contains("template") && kComputations.contains(actor["template"]);
}

// Core's supervisors check every 10 ms (P22), but OnEvent, which waits.
int period(const Json& supervisor) {
    const int usual = supervisor["template"] == "OnEvent" ? 0 : 10;
    return supervisor.value("period_ms", usual);
}

bool same_supervisor(const Json& now, const Json& next) {
    return now["template"] == next["template"] && period(now) == period(next) &&
           names(part(now, "in")) == names(part(next, "in"));
}

bool all_there(const Json& now, const Json& next) {
    for (const auto& [name, supervisor] : now.items()) {
        if (!next.contains(name) || !same_supervisor(supervisor, next[name])) return false;
    }
    return true;
}

std::string text_of(const Json& variable) {
    if (variable.contains("initial")) {
        const Json& initial = variable["initial"];
        return initial.is_string() ? initial.get<std::string>() : initial.dump();
    }
    const std::string type = variable["type"];
    return type == "string" ? "" : type == "bool" ? "false" : "0";
}

}  // namespace

void ChangeOracle::activate(Level& level, const std::string& actor) {
    level.actor = actor;
    level.started = plan(level)["actors"][actor];
    level.on_its_way.clear();
    level.resting.clear();  // those start again
    if (is_computation(level.started)) return;
    level.resting = std::exchange(level.remedy, {});
}

void ChangeOracle::see(const plan::TraceEvent& event) {
    const auto depth = static_cast<size_t>(std::count(event.plan.begin(), event.plan.end(), '/'));
    if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        levels_.resize(depth);
        Level level;
        level.path = event.plan;
        level.file = "main.plan.json";
        if (depth > 0) level.file = levels_.back().started["plan"];
        activate(level, plan(level)["start"]["actor"]);
        levels_.push_back(std::move(level));
        return;
    }
    Level& level = levels_[depth];
    if (std::holds_alternative<plan::PlanEnded>(event.what)) {
        levels_.resize(depth);
    } else if (const auto* end = std::get_if<plan::ActorEnded>(&event.what)) {
        if (end->target != "@terminate") activate(level, std::string(end->target));
    } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        if (raised->target == "@ignore") return;
        if (raised->global) level.remedy.insert(std::string(raised->supervisor));
        if (raised->target != "@terminate") level.on_its_way = raised->target;
        for (size_t inner = depth + 1; inner < levels_.size(); ++inner) {
            levels_[inner].ends = true;
            levels_[inner].on_its_way.clear();
        }
    } else if (const auto* error = std::get_if<plan::ErrorFound>(&event.what)) {
        level.on_its_way.clear();
        level.failed.insert(std::string(error->element));
        for (size_t inner = depth + 1; inner < levels_.size(); ++inner) levels_[inner].ends = true;
    } else if (std::holds_alternative<plan::ActorInterrupted>(event.what)) {
        const std::string next = level.on_its_way;
        if (!next.empty()) activate(level, next);
    }
}

bool ChangeOracle::watches(const Level& level, const std::string& global) const {
    return !level.ends && !level.remedy.contains(global) && !level.resting.contains(global) &&
           !level.failed.contains(global);
}

bool ChangeOracle::accepts(const Texts& next) const {
    return std::all_of(levels_.begin(), levels_.end(),
                       [&](const Level& level) { return accepts(level, next.at(level.file)); });
}

bool ChangeOracle::accepts(const Level& level, const Json& next) const {
    const Json variables = part(plan(level), "configuration");
    for (const auto& [name, variable] : variables.items()) {
        if (!next["configuration"].contains(name)) continue;
        const Json& other = next["configuration"][name];
        if (other["type"] != variable["type"]) return false;
        if (other.value("access", "") != variable.value("access", "")) return false;
    }
    const Json& actors = next["actors"];
    if (!level.on_its_way.empty() && !actors.contains(level.on_its_way)) return false;
    if (!actors.contains(level.actor)) return false;
    const Json& actor = actors[level.actor];
    if (actor.value("template", "") != level.started.value("template", "")) return false;
    if (actor.value("plan", "") != level.started.value("plan", "")) return false;
    if (names(part(actor, "in")) != names(part(level.started, "in"))) return false;
    if (!all_there(part(level.started, "supervisors"), part(actor, "supervisors"))) return false;
    Json watching = Json::object();
    const Json globals = part(plan(level)["start"], "supervisors");
    for (const auto& [name, global] : globals.items()) {
        if (watches(level, name)) watching[name] = global;
    }
    return all_there(watching, part(next["start"], "supervisors"));
}

std::vector<std::string> ChangeOracle::accept(const Texts& next, const std::string& changed) {
    std::vector<std::string> lines;
    for (Level& level : levels_) {
        if (level.file != changed) continue;
        lines.push_back(level.path + " change");
        const Json before = part(plan(level), "configuration");
        for (const auto& [name, variable] : next.at(changed)["configuration"].items()) {
            if (before.contains(name)) continue;
            lines.push_back(level.path + " " + name + " = " + text_of(variable));
        }
        const Json globals = part(next.at(changed)["start"], "supervisors");
        for (auto* set : {&level.remedy, &level.resting, &level.failed}) {
            std::erase_if(*set, [&](const std::string& name) { return !globals.contains(name); });
        }
    }
    if (lines.empty()) lines.push_back(levels_.front().path + " change");
    newest_ = next;
    return lines;
}

}  // namespace vagus
