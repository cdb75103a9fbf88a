#include "cli/plan/story.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "plan/value.hpp"

namespace vagus::cli {

namespace {

constexpr Duration kFreshFor = std::chrono::milliseconds(1500);

std::string shown_value(const plan::Value& value) {
    const Result<plan::Value> text = plan::convert(value, plan::Type::String);
    if (!text.ok()) return "an object";
    return text.value().string().substr(0, kStoryValueMax);
}

std::string inputs_of(const plan::ActorStarted& started) {
    std::string text;
    for (const auto& [name, value] : started.in) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, shown_value(value));
    }
    return text.empty() ? "" : ": " + text;
}

std::string target_text(std::string_view target) {
    if (target == plan::kTerminate) return "the plan ends";
    if (target == plan::kIgnore) return "ignored";
    return std::string(target);
}

struct Say {
    std::optional<std::string> operator()(const plan::PlanStarted&) { return std::nullopt; }
    std::optional<std::string> operator()(const plan::PlanEnded& ended) {
        return fmt::format("the plan is over: {}", plan::name_of(ended.result));
    }
    std::optional<std::string> operator()(const plan::ActorStarted& started) {
        return fmt::format("{} begins{}", started.actor, inputs_of(started));
    }
    std::optional<std::string> operator()(const plan::ActorEnded& ended) {
        return fmt::format("{}: {} → {}", ended.actor, ended.state, target_text(ended.target));
    }
    std::optional<std::string> operator()(const plan::EventRaised& raised) {
        return fmt::format("{}: {} → {}", raised.supervisor, raised.event,
                           target_text(raised.target));
    }
    std::optional<std::string> operator()(const plan::ActorInterrupted&) { return std::nullopt; }
    std::optional<std::string> operator()(const plan::VariableWritten& written) {
        if (written.by == "initial") return std::nullopt;
        return fmt::format("{} = {}", written.variable, shown_value(written.value));
    }
    std::optional<std::string> operator()(const plan::CheckLate&) { return std::nullopt; }
    std::optional<std::string> operator()(const plan::TextLogged& logged) {
        return fmt::format("{}: {}", logged.actor, logged.text.substr(0, kStoryValueMax));
    }
    std::optional<std::string> operator()(const plan::ErrorFound& found) {
        return "error: " + found.message;
    }
    std::optional<std::string> operator()(const plan::PlanChanged&) {
        return "a new version of the plan runs";
    }
};

}  // namespace

std::optional<std::string> sentence_of(const plan::TraceEvent& event) {
    std::optional<std::string> text = std::visit(Say(), event.what);
    if (text) text = visible(*text);  // one line, whatever plans and nodes say
    return text;
}

// ---- following ----

void PlanStory::see(const plan::TraceEvent& event) {
    const auto depth = static_cast<size_t>(run::level_of(event));
    // What the variables held at the end stays to be seen.
    if (depth > 0 || !std::holds_alternative<plan::PlanEnded>(event.what)) variables_.see(event);
    if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        levels_.resize(depth);
        levels_.push_back({event.plan, "", event.at, {}, {}});
    } else if (const auto* over = std::get_if<plan::PlanEnded>(&event.what)) {
        levels_.resize(std::max<size_t>(depth, 1));
        if (depth == 0) ended_ = plan::name_of(over->result);
        failed_ = depth == 0 && over->result == plan::PlanResult::Error;
    }
    if (depth >= levels_.size()) return;
    if (const auto* changed = std::get_if<plan::PlanChanged>(&event.what)) {
        graph_ = changed->graph.get();
        levels_[depth].changed.clear();
    }
    Level& level = levels_[depth];
    if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        start_actor(depth, started->actor, event.at);
    } else if (const auto* stopped = std::get_if<plan::ActorInterrupted>(&event.what)) {
        if (!stopped->ran)
            start_actor(depth, stopped->actor, event.at);  // it was active all the same
        level.actor.clear();
    } else if (std::holds_alternative<plan::ActorEnded>(event.what)) {
        level.actor.clear();
    } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
        const bool rests = raised->global && raised->target != plan::kIgnore;
        if (rests) level.resting[std::string(raised->supervisor)] = Rest::BeforeRemedy;
    } else if (const auto* written = std::get_if<plan::VariableWritten>(&event.what)) {
        const auto& known = variables_.plan_at(static_cast<int>(depth)).variables;
        for (size_t slot = 0; slot < known.size(); ++slot) {
            const bool is_it = known[slot].name == written->variable && written->by != "initial";
            if (is_it) level.changed[static_cast<int>(slot)] = event.at;
        }
    }
    note(event);
}

void PlanStory::start_actor(size_t depth, std::string_view actor, Time at) {
    Level& level = levels_[depth];
    level.actor = actor;
    level.since = at;
    std::erase_if(level.resting, [](const auto& one) { return one.second == Rest::Remedy; });
    const plan::GraphActor* const begun = active(depth);
    const bool computes = begun && begun->of && begun->of->kind == plan::Kind::Computation;
    if (computes) return;
    for (auto& [name, rest] : level.resting) rest = Rest::Remedy;
}

// Beginnings and writes are in lists of their own.
void PlanStory::note(const plan::TraceEvent& event) {
    if (std::holds_alternative<plan::ActorStarted>(event.what)) return;
    if (std::holds_alternative<plan::VariableWritten>(event.what)) return;
    const auto sentence = sentence_of(event);
    if (!sentence) return;
    happenings_.push_front({event.at, *sentence, false});
    if (happenings_.size() <= kHappeningsKept) return;
    happenings_.pop_back();
    ++forgotten_;
}

// ---- showing ----

const plan::GraphActor* PlanStory::active(size_t level) const {
    if (level >= levels_.size() || level >= static_cast<size_t>(variables_.depth())) return nullptr;
    for (const plan::GraphActor& actor : variables_.plan_at(static_cast<int>(level)).actors) {
        if (actor.name == levels_[level].actor) return &actor;
    }
    return nullptr;
}

PlanPanelView PlanStory::panel(Time now) const {
    PlanPanelView panel;
    panel.name = graph_->plans.front().name;
    panel.state = ended_.empty() ? "running" : ended_;
    panel.wrong = failed_;
    add_actors(panel, now);
    if (ended_.empty()) add_watching(panel);
    add_variables(panel, now);
    panel.over = !ended_.empty();
    panel.forgotten = forgotten_;
    for (HappeningView one : happenings_) {
        one.fresh = now - one.at < kFreshFor;
        panel.happenings.push_back(std::move(one));
    }
    return panel;
}

void PlanStory::add_actors(PlanPanelView& panel, Time now) const {
    for (const plan::GraphActor& actor : graph_->plans.front().actors) {
        const bool is_active = active(0) == &actor;
        const Duration since = is_active ? now - levels_[0].since : Duration{};
        panel.actors.push_back({actor.name, 0, is_active, since});
        for (size_t level = 1; is_active && level < levels_.size(); ++level) {
            const plan::GraphActor* const inner = active(level);
            if (inner == nullptr) break;
            panel.actors.push_back(
                {inner->name, static_cast<int>(level), true, now - levels_[level].since});
        }
    }
}

void PlanStory::add_watching(PlanPanelView& panel) const {
    const auto add = [&panel](const plan::GraphSupervisor& supervisor, bool global) {
        std::string events;
        for (const plan::Outcome& event : supervisor.of->outcomes) {
            events += (events.empty() ? "" : ", ") + event.name;
        }
        panel.watching.push_back({supervisor.name, events, global});
    };
    for (size_t level = 0; level < levels_.size(); ++level) {
        if (level >= static_cast<size_t>(variables_.depth())) return;
        for (const auto& global : variables_.plan_at(static_cast<int>(level)).globals) {
            if (!levels_[level].resting.contains(global.name)) add(global, true);
        }
        if (const plan::GraphActor* const actor = active(level)) {
            for (const auto& supervisor : actor->supervisors) add(supervisor, false);
        }
    }
}

void PlanStory::add_variables(PlanPanelView& panel, Time now) const {
    if (variables_.depth() == 0) return;
    const auto& known = variables_.plan_at(0).variables;
    for (size_t slot = 0; slot < known.size(); ++slot) {
        const auto changed = levels_[0].changed.find(static_cast<int>(slot));
        const bool fresh = changed != levels_[0].changed.end() && now - changed->second < kFreshFor;
        const plan::Value& value = variables_.value(0, static_cast<int>(slot));
        // Of one that a new version brought (P31) the first knows none.
        const int known_before = plan::find_variable(*plan_, known[slot].name);
        const std::string unit =
            known_before < 0 ? "" : plan_->configuration[static_cast<size_t>(known_before)].unit;
        panel.variables.push_back({known[slot].name, shown_value(value), unit, fresh});
    }
}

}  // namespace vagus::cli
