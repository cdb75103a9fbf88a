// What pages see of a run: its clock, its plan, what is in its world.
#include "serve/run/run.hpp"

#include "serve/json.hpp"
#include "serve/plan_value.hpp"

namespace vagus::serve {

void Run::declare_topics() {
    Topics& topics = desk_.topics();
    topics.document("clock", [this](const Json&) { return clock_document(); });
    topics.document("plan", [this](const Json&) { return plan_document(); });
    topics.document("held", [this](const Json&) { return held_; });
    topics.document("scene", [this](const Json&) { return scene_document(); });
}

Json Run::clock_document() const {
    static constexpr const char* kNames[] = {"none", "running", "paused", "hanging", "dead"};
    Json clock = {
        {"t", t_},
        {"wall", desk_.wall_ms()},
        {"state", rests_ && state_ == State::Paused ? "none" : kNames[static_cast<size_t>(state_)]},
        {"speed", speed_},
        {"real", real_}};
    if (!why_.empty()) clock["why"] = why_;
    return clock;
}

std::string Run::actor() const {
    if (!plan_runs() || !plan_ || plan_->levels.empty()) return "";
    return plan_->levels.back().document.json.value("actor", "");
}

vagus::Result<plan::Value> Run::variable(const std::string& name) const {
    if (!plan_runs() || !plan_ || plan_->levels.empty()) {
        return Error{Code::Unavailable, "no plan runs, which has its variables"};
    }
    const Json& outermost = plan_->levels.front().document.json;
    for (const Json& one : outermost.value("variables", Json::array())) {
        if (one["name"] == name) return plan_value(one["value"]);
    }
    return Error{Code::NotFound, "the plan that runs has no variable " + name};
}

Json Run::plan_document() const {
    if (!plan_) {
        return {{"state", "none"}, {"t", t_}, {"levels", Json::array()}, {"story", Json::array()}};
    }
    Json levels = Json::array();
    for (const talk::PlanLevel& level : plan_->levels) {
        levels.push_back(level.document.json);
        levels.back()["doc"] = doc_of_(level.file);
    }
    Json plan = {{"state", talk::word_of(plan_->state)},
                 {"doc", doc_of_(plan_->file)},
                 {"t", plan_->t},
                 {"levels", std::move(levels)},
                 {"story", plan_->story.json}};
    if (plan_->result) plan["result"] = *plan_->result;
    if (!plan_->message.empty()) plan["message"] = plan_->message;
    if (!plan_->stands_at.empty()) plan["stands_at"] = plan_->stands_at;
    if (!change_.is_null()) plan["change"] = change_;
    return plan;
}

Json Run::scene_document() const {
    if (scene_) {
        Json scene = scene_->document.json;
        scene["opening"] = opened_order_;
        return scene;
    }
    return {{"name", ""},          {"size", {1, 1}},          {"open", true},
            {"ground", {1, 1, 1}}, {"robots", Json::array()}, {"objects", Json::array()}};
}

}  // namespace vagus::serve
