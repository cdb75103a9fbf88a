#include "run/tried_way.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/json.hpp"
#include "base/time.hpp"

namespace vagus::run {

using namespace std::chrono_literals;

namespace {

constexpr Duration kBetweenChoices = 1s;
constexpr Duration kTriedLookEvery = 100ms;
// A choice that nobody takes so long after it is due is none of this situation.
constexpr Duration kTakenWithin = 30s;
constexpr int kNeverSeconds = 1'000'000;  // what was not chosen

// Seconds, with all of their six digits where they have them.
std::string number(Time time) {
    return fmt::format("{}", seconds_of(time));
}

std::string literal(const plan::Value& value) {
    if (value.type() == plan::Type::String) return json_quote(value.string());
    return plan::text_of(value).value();
}

// The end of an actor as one of its answers.
std::string answer_of(const TriedWay::Turn& turn) {
    if (!turn.by.empty() || !turn.ended) return fmt::format("{{ \"after\": {} }}", kNeverSeconds);
    std::string outputs;
    for (const auto& [name, value] : turn.out) {
        outputs +=
            fmt::format("{}{}: {}", outputs.empty() ? "" : ", ", json_quote(name), literal(value));
    }
    return fmt::format("{{ \"after\": {}, \"state\": {}{} }}", number(*turn.ended - turn.started),
                       json_quote(turn.state),
                       outputs.empty() ? "" : ", \"out\": { " + outputs + " }");
}

}  // namespace

class TriedWay::TriedActor final : public Actor {
public:
    TriedActor(TriedWay& way, const plan::GraphActor& of, std::string path)
        : way_(way), of_(of), path_(std::move(path)) {}

    void run(ActorContext& context) override {
        const size_t turn = way_.turns_.size();
        way_.turns_.push_back({.path = path_, .actor = of_.name, .started = context.now()});
        try {
            wait_for_turn(context);
        } catch (const Stop&) {
            if (!way_.waits_) end(turn, context.now()).by = way_.last_raised_;
            throw;
        }
        const TriedChoice choice = *way_.turn_of(path_, of_.name);
        const auto state = std::find(of_.states.begin(), of_.states.end(), choice.outcome);
        way_.take(context.now());
        Turn& ended = end(turn, context.now());
        ended.state = choice.outcome;
        ended.out = choice.out;
        for (const auto& [name, value] : choice.out) {
            context.out(static_cast<size_t>(plan::find_output(*of_.of, name)), value);
        }
        context.end(static_cast<int>(state - of_.states.begin()));
    }

private:
    void wait_for_turn(ActorContext& context) {
        while (!is_turn(context.now())) {
            // By then, everything else that happens at the instant of its start has happened.
            context.sleep(kTriedLookEvery);
            const bool is_stuck = context.now() >= way_.due_ + kTakenWithin;
            if (!way_.over() && !is_stuck) continue;
            way_.waits_ = true;
            way_.waits_of_ = of_;
            way_.end_();
        }
    }

    Turn& end(size_t turn, Time now) {
        way_.turns_[turn].ended = now;
        return way_.turns_[turn];
    }

    bool is_turn(Time now) const {
        const TriedChoice* const choice = way_.turn_of(path_, of_.name);
        return choice && now >= way_.due_ && fits(*choice);
    }

    bool fits(const TriedChoice& choice) const {
        return std::ranges::find(of_.states, choice.outcome) != of_.states.end() &&
               std::ranges::all_of(choice.out, [this](const auto& output) {
                   return plan::find_output(*of_.of, output.first) >= 0;
               });
    }

    TriedWay& way_;
    const plan::GraphActor& of_;
    const std::string path_;
};

class TriedWay::TriedSupervisor final : public Supervisor {
public:
    TriedSupervisor(TriedWay& way, const plan::GraphSupervisor& of, std::string path, Time started)
        : way_(way), of_(of), path_(std::move(path)), started_(started) {}

    std::optional<plan::Given> check(const Check& check) override {
        const Time now = started_ + check.since_start;
        const TriedChoice* const choice = way_.turn_of(path_, of_.name);
        if (!choice || now < way_.due_) return std::nullopt;
        const int event = plan::find_outcome(*of_.of, choice->outcome);
        if (event < 0) return std::nullopt;
        way_.last_raised_ = of_.name + "." + choice->outcome;
        way_.raised_[way_.last_raised_].push_back(now);
        way_.take(now);
        return plan::Given{event, {}};
    }

private:
    TriedWay& way_;
    const plan::GraphSupervisor& of_;
    const std::string path_;
    const Time started_;
};

const TriedChoice* TriedWay::turn_of(const std::string& path, const std::string& element) const {
    if (over() || waits_) return nullptr;
    const TriedChoice& next = way_[next_];
    return next.path == path && next.element == element ? &next : nullptr;
}

void TriedWay::take(Time now) {
    ++next_;
    taken_.push_back(now);
    due_ = now + kBetweenChoices;
}

std::unique_ptr<Actor> TriedWay::make_actor(const plan::GraphActor& of, const std::string& path,
                                            Time) {
    if (of.of->kind == plan::Kind::Computation) return nullptr;
    return std::make_unique<TriedActor>(*this, of, path);
}

std::unique_ptr<Supervisor> TriedWay::make_supervisor(const plan::GraphSupervisor& of,
                                                      const std::string& path, Time now) {
    return std::make_unique<TriedSupervisor>(*this, of, path, now);
}

std::string TriedWay::answers(const plan::Graph& graph) const {
    std::map<std::string, std::vector<std::string>> members;
    for (const Turn& turn : turns_) members[turn.actor].push_back(answer_of(turn));
    const auto add = [&](const plan::GraphSupervisor& supervisor) {
        for (const plan::Outcome& event : supervisor.of->outcomes) {
            std::vector<std::string>& times = members[supervisor.name + "." + event.name];
            const auto found = raised_.find(supervisor.name + "." + event.name);
            if (found == raised_.end() || !times.empty()) continue;
            for (const Time at : found->second) {
                times.push_back(fmt::format("{{ \"at\": {} }}", number(at)));
            }
        }
    };
    for (const plan::GraphPlan& plan : graph.plans) {
        for (const plan::GraphSupervisor& one : plan.globals) add(one);
        for (const plan::GraphActor& actor : plan.actors) {
            for (const plan::GraphSupervisor& one : actor.supervisors) add(one);
            const bool waits = actor.of && actor.of->kind != plan::Kind::Computation;
            if (!waits || members.contains(actor.name)) continue;
            members[actor.name] = {fmt::format("{{ \"after\": {} }}", kNeverSeconds)};
        }
    }
    std::string text = "{";
    for (const auto& [name, list] : members) {
        text += fmt::format("{}\n    {}: [{}]", text.size() > 1 ? "," : "", json_quote(name),
                            fmt::join(list, ", "));
    }
    return text + (members.empty() ? "}" : "\n  }");
}

}  // namespace vagus::run
