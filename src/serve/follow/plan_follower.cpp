#include "serve/follow/plan_follower.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/plan_value.hpp"

namespace vagus::serve {

namespace {

std::string shortened(std::string_view text) {
    if (text.size() <= kShownTextMax) return std::string(text);
    return std::string(utf8_prefix(text, kShownTextMax)) + "…";
}

const PlanOutline::Actor* actor_of(const PlanOutline* plan, std::string_view name) {
    for (size_t i = 0; plan && i < plan->actors.size(); ++i) {
        if (plan->actors[i].name == name) return &plan->actors[i];
    }
    return nullptr;
}

// What a person can read.
Json shown(const plan::Value& value) {
    if (value.type() == plan::Type::String) return shortened(value.string());
    if (value.type() == plan::Type::Object) return value.object() ? "(an object)" : "(none)";
    return json_of(value);
}

}  // namespace

PlanFollower::PlanFollower(Plans plans, std::function<std::string(const std::string&)> doc_of)
    : plans_(std::move(plans)), doc_of_(std::move(doc_of)) {}

void PlanFollower::happen(double t, const char* kind, const std::string& text) {
    story_.push_back({{"number", lines_++}, {"t", t}, {"kind", kind}, {"text", shortened(text)}});
    if (story_.size() > kStoryKept) story_.pop_front();
}

// The plan of the outermost level, or that which the active actor of `outer` stands for.
const PlanOutline* PlanFollower::plan_inside(const Level* outer) const {
    if (!outer) return &plans_->front();
    if (!outer->actor || !outer->actor->file) return nullptr;
    for (const PlanOutline& one : *plans_) {
        if (one.file == *outer->actor->file) return &one;
    }
    return nullptr;
}

// Instance paths get longer by one name for each level.
PlanFollower::Level& PlanFollower::level_at(const std::string& path) {
    const auto depth = static_cast<size_t>(std::count(path.begin(), path.end(), '/'));
    while (levels_.size() > depth + 1) levels_.pop_back();
    if (levels_.size() <= depth) {
        Level level;
        level.path = path;
        level.plan = plan_inside(levels_.empty() ? nullptr : &levels_.back());
        levels_.push_back(std::move(level));
    }
    return levels_.back();
}

void PlanFollower::enter(Level& level, std::string_view actor, uint64_t activation, double t) {
    level.actor = actor_of(level.plan, actor);
    level.activation = activation;
    level.since = t;
    level.inputs = Json::object();
}

void PlanFollower::stand_at(const run::Where& where) {
    for (const run::LevelNow& now : where.levels) {
        Level& level = level_at(now.path);
        if (level.activation == now.activation) continue;
        enter(level, now.actor, now.activation, seconds_of(where.at));
    }
}

void PlanFollower::change(Plans plans) {
    const Plans before = std::exchange(plans_, std::move(plans));  // levels still point into it
    for (Level& level : levels_) {
        if (!level.plan) continue;
        const std::string file = level.plan->file;
        const std::string actor = level.actor ? level.actor->name : "";
        level.plan = nullptr;
        for (const PlanOutline& one : *plans_) {
            if (one.file == file) level.plan = &one;
        }
        level.actor = actor_of(level.plan, actor);
    }
}

void PlanFollower::see(const plan::TraceEvent& event) {
    const double t = seconds_of(event.at);
    Level& level = level_at(event.plan);
    counts_.see(event);
    if (const auto* start = std::get_if<plan::ActorStarted>(&event.what)) {
        enter(level, start->actor, start->activation, t);
        for (const auto& [name, value] : start->in) level.inputs[std::string(name)] = shown(value);
        for (auto& [name, left] : level.resting) --left;
        std::erase_if(level.resting, [](const auto& entry) { return entry.second <= 0; });
    } else if (const auto* end = std::get_if<plan::ActorEnded>(&event.what)) {
        happen(t, "note", fmt::format("{}: {} → {}", end->actor, end->state, end->target));
    } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        happen(t, "warning",
               fmt::format("{}: {} → {}", raised->supervisor, raised->event, raised->target));
        if (raised->global && raised->target != "@ignore") {
            level.resting[std::string(raised->supervisor)] = 2;
        }
    } else if (const auto* written = std::get_if<plan::VariableWritten>(&event.what)) {
        level.values[std::string(written->variable)] = shown(written->value);
    } else if (const auto* late = std::get_if<plan::CheckLate>(&event.what)) {
        happen(
            t, "warning",
            fmt::format("{}: a check was {} ms late", late->supervisor, late->by.count() / 1000));
    } else if (const auto* logged = std::get_if<plan::TextLogged>(&event.what)) {
        happen(t, "log", logged->text);
    } else if (const auto* error = std::get_if<plan::ErrorFound>(&event.what)) {
        happen(t, "error", fmt::format("{}: {}", error->element, error->message));
    } else if (std::holds_alternative<plan::PlanChanged>(event.what)) {
        happen(t, "note", fmt::format("{}: the new version runs", event.plan));
    } else if (const auto* over = std::get_if<plan::PlanEnded>(&event.what)) {
        happen(t, over->result == plan::PlanResult::Error ? "error" : "note",
               fmt::format("{} is over: {}", event.plan, plan::name_of(over->result)));
        if (levels_.size() > 1) return levels_.pop_back();
        // What it has counted and written can still be looked at.
        level.actor = nullptr;
        result_ = plan::name_of(over->result);
        message_ = over->message;
    } else {
        return;
    }
}

std::vector<PlanFollower::Watching> PlanFollower::watching() const {
    std::vector<Watching> found;
    if (result_) return found;
    for (const Level& level : levels_) {
        if (!level.plan) continue;
        for (const PlanOutline::Supervisor& one : level.plan->globals) {
            if (!level.resting.contains(one.name)) found.push_back({level.path, one.name, true});
        }
        if (!level.actor) continue;
        for (const PlanOutline::Supervisor& one : level.actor->supervisors) {
            found.push_back({level.path, one.name, false});
        }
    }
    return found;
}

Json PlanFollower::level_json(const Level& level) const {
    Json variables = Json::array();
    Json supervisors = Json::array();
    const auto add = [&](const PlanOutline::Supervisor& one, bool global) {
        supervisors.push_back({{"name", one.name},
                               {"global", global},
                               {"watching", !result_ && !level.resting.contains(one.name)},
                               {"events", one.events}});
    };
    if (level.plan) {
        for (const PlanOutline::Variable& variable : level.plan->configuration) {
            const auto value = level.values.find(variable.name);
            variables.push_back({{"name", variable.name},
                                 {"type", variable.type},
                                 {"value", value == level.values.end() ? Json("") : value->second},
                                 {"unit", variable.unit}});
        }
        for (const PlanOutline::Supervisor& one : level.plan->globals) add(one, true);
    }
    if (level.actor) {
        for (const PlanOutline::Supervisor& one : level.actor->supervisors) add(one, false);
    }
    Json json = {{"path", level.path},
                 {"doc", level.plan ? doc_of_(level.plan->file) : ""},
                 {"actor", level.actor ? level.actor->name : ""},
                 {"template", level.actor ? level.actor->template_name : ""},
                 {"activation", level.activation},
                 {"since", level.since},
                 {"inputs", level.inputs},
                 {"variables", std::move(variables)},
                 {"supervisors", std::move(supervisors)},
                 {"counts", counts_.counts(level.path)}};
    if (Json taken = counts_.taken(level.path); !taken.is_null()) json["taken"] = std::move(taken);
    return json;
}

Json PlanFollower::document(double now, bool paused) const {
    Json levels = Json::array();
    for (const Level& level : levels_) levels.push_back(level_json(level));
    Json document = {{"state", result_  ? "ended"
                               : paused ? "paused"
                                        : "running"},
                     {"doc", doc_of_(plans_->front().file)},
                     {"t", now},
                     {"levels", std::move(levels)},
                     {"story", Json(std::vector<Json>(story_.begin(), story_.end()))}};
    if (result_) document["result"] = *result_;
    if (!message_.empty()) document["message"] = shortened(message_);
    return document;
}

}  // namespace vagus::serve
