#include "run/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/nearest.hpp"

namespace vagus::run {

namespace {

constexpr std::string_view kKeys[] = {"after", "state", "out"};

Error wrong(const std::string& file, Place at, const std::string& sentence) {
    return Error{Code::BadInput, at_place(file, at, sentence)};
}

// What the plans have of a name: the interface that its answers must keep to.
struct Answerer {
    std::vector<std::string> states;
    const plan::Template* of = nullptr;
};

class Reader {
public:
    Reader(const std::string& file, const plan::Graph& graph) : file_(file) {
        for (const plan::GraphPlan& plan : graph.plans) {
            for (const plan::GraphSupervisor& one : plan.globals) add(one);
            for (const plan::GraphActor& actor : plan.actors) {
                if (actor.of) {
                    actors_.emplace(actor.name, Answerer{actor.states, actor.of});
                    actors_.emplace(actor.of->name, Answerer{actor.states, actor.of});
                }
                for (const plan::GraphSupervisor& one : actor.supervisors) add(one);
            }
        }
    }

    Result<Answers> read(const JsonValue& json) {
        TRY(expect(json, JsonKind::Object, "the answers"));
        for (const JsonMember& member : json.members) {
            TRY(expect(member.value, JsonKind::Array, fmt::format("\"{}\"", member.key)));
            count_ += member.value.items.size();
            if (count_ > kAnswersMax) {
                return wrong(file_, member.at,
                             fmt::format("more than {} answers; leave some out", kAnswersMax));
            }
            const bool is_event = member.key.find('.') != std::string::npos;
            TRY(is_event ? read_events(member) : read_actor(member));
        }
        return std::move(answers_);
    }

private:
    void add(const plan::GraphSupervisor& supervisor) {
        for (const plan::Outcome& event : supervisor.of->outcomes) {
            events_.push_back(supervisor.name + "." + event.name);
        }
    }

    Status expect(const JsonValue& value, JsonKind kind, const std::string& what) const {
        if (value.kind == kind) return Status::done();
        return wrong(
            file_, value.at,
            fmt::format("{} must be {}, but is {}", what, name_of(kind), name_of(value.kind)));
    }

    Result<Duration> seconds(const JsonValue& value, std::string_view key) const {
        if (!value.is_number() || value.number < 0 || value.number > kAnswerSecondsMax) {
            return wrong(file_, value.at,
                         fmt::format("\"{}\" must be a number of seconds from 0 to {}", key,
                                     kAnswerSecondsMax));
        }
        return Duration{std::llround(value.number * 1e6)};
    }

    Status read_events(const JsonMember& member) {
        if (std::find(events_.begin(), events_.end(), member.key) == events_.end()) {
            return wrong(file_, member.at,
                         fmt::format("no supervisor's event is called \"{}\"{}", member.key,
                                     meant(member.key, {events_.begin(), events_.end()})));
        }
        std::vector<Time>& times = answers_.events[member.key];
        for (const JsonValue& item : member.value.items) {
            TRY(expect(item, JsonKind::Object, "an answer"));
            const JsonValue* const at = item.find("at");
            if (!at || item.members.size() != 1) {
                return wrong(file_, item.at,
                             "the answer of a supervisor is { \"at\": SECONDS }, and no more");
            }
            times.push_back(TRY(seconds(*at, "at")));
        }
        std::sort(times.begin(), times.end());
        return Status::done();
    }

    Status read_actor(const JsonMember& member) {
        const auto found = actors_.find(member.key);
        if (found == actors_.end()) {
            std::vector<std::string_view> names;
            for (const auto& [name, answerer] : actors_) names.push_back(name);
            return wrong(file_, member.at,
                         fmt::format("no actor and no template of one is called \"{}\"{}",
                                     member.key, meant(member.key, names)));
        }
        if (member.value.items.empty()) {
            return wrong(
                file_, member.value.at,
                fmt::format("\"{}\" has no answer; write one, or leave it out", member.key));
        }
        for (const JsonValue& item : member.value.items) {
            answers_.actors[member.key].push_back(TRY(read_answer(item, found->second)));
        }
        return Status::done();
    }

    Result<ActorAnswer> read_answer(const JsonValue& item, const Answerer& by) const {
        TRY(expect(item, JsonKind::Object, "an answer"));
        ActorAnswer answer;
        for (const JsonMember& member : item.members) {
            if (member.key == "after") {
                answer.after = TRY(seconds(member.value, "after"));
            } else if (member.key == "state") {
                TRY(expect(member.value, JsonKind::String, "\"state\""));
                answer.state = member.value.text;
                if (std::find(by.states.begin(), by.states.end(), answer.state) ==
                    by.states.end()) {
                    return wrong(
                        file_, member.value.at,
                        fmt::format("it has no state \"{}\"{}", answer.state,
                                    meant(answer.state, {by.states.begin(), by.states.end()})));
                }
            } else if (member.key == "out") {
                answer.out = TRY(read_outputs(member.value, by));
            } else {
                return wrong(file_, member.at,
                             fmt::format("an answer has no \"{}\"{}", member.key,
                                         meant(member.key, {std::begin(kKeys), std::end(kKeys)})));
            }
        }
        return answer;
    }

    Result<std::vector<std::pair<std::string, plan::Value>>> read_outputs(
        const JsonValue& json, const Answerer& by) const {
        TRY(expect(json, JsonKind::Object, "\"out\""));
        std::vector<std::pair<std::string, plan::Value>> outputs;
        for (const JsonMember& member : json.members) {
            if (plan::find_output(*by.of, member.key) < 0) {
                std::vector<std::string_view> names;
                for (const auto& one : by.of->outputs) names.push_back(one.name);
                return wrong(
                    file_, member.at,
                    fmt::format("it has no output \"{}\"{}", member.key, meant(member.key, names)));
            }
            outputs.emplace_back(member.key, TRY(value_of(member.value)));
        }
        return outputs;
    }

    Result<plan::Value> value_of(const JsonValue& json) const {
        switch (json.kind) {
            case JsonKind::Bool:
                return plan::Value(json.boolean);
            case JsonKind::Int:
                return plan::Value(json.integer);
            case JsonKind::Float:
                return plan::Value(json.number);
            case JsonKind::String:
                return plan::Value(json.text);
            case JsonKind::Null:
            case JsonKind::Array:
            case JsonKind::Object:
                break;
        }
        return wrong(file_, json.at, "an output is a number, true, false or a text");
    }

    static std::string meant(std::string_view typed, const std::vector<std::string_view>& known) {
        const std::string name = nearest(typed, known);
        return name.empty() ? "" : fmt::format("; did you mean \"{}\"?", name);
    }

    const std::string& file_;
    std::map<std::string, Answerer> actors_;  // by name of actor or template
    std::vector<std::string> events_;
    Answers answers_;
    size_t count_ = 0;
};

}  // namespace

Result<Answers> Answers::read(const JsonValue& json, const std::string& file,
                              const plan::Graph& graph) {
    return Reader(file, graph).read(json);
}

bool Answers::name(const plan::GraphSupervisor& supervisor) const {
    const auto& all = supervisor.of->outcomes;
    return std::any_of(all.begin(), all.end(), [this, &supervisor](const plan::Outcome& event) {
        return events.contains(supervisor.name + "." + event.name);
    });
}

plan::Graph Answers::checked_in_time(plan::Graph graph) const {
    return with_checks_in_time(std::move(graph),
                               [this](const plan::GraphSupervisor& one) { return name(one); });
}

class AnsweringCode::AnsweringActor final : public Actor {
public:
    AnsweringActor(const ActorAnswer& answer, const plan::GraphActor& of)
        : answer_(answer), of_(of) {}

    void run(ActorContext& context) override {
        if (answer_.after > Duration{0}) context.sleep(answer_.after);
        for (const auto& [name, value] : answer_.out) {
            context.out(static_cast<size_t>(plan::find_output(*of_.of, name)), value);
        }
        const auto state = std::find(of_.states.begin(), of_.states.end(), answer_.state);
        context.end(answer_.state.empty() ? 0 : static_cast<int>(state - of_.states.begin()));
    }

private:
    const ActorAnswer& answer_;
    const plan::GraphActor& of_;
};

class AnsweringCode::AnsweringSupervisor final : public Supervisor {
public:
    AnsweringSupervisor(AnsweringCode& code, const plan::GraphSupervisor& of, Time started)
        : code_(code), of_(of), started_(started) {}

    std::optional<plan::Given> check(const Check& check) override {
        const Time now = started_ + check.since_start;
        for (size_t event = 0; event < of_.of->outcomes.size(); ++event) {
            if (is_due(of_.name + "." + of_.of->outcomes[event].name, now)) {
                return plan::Given{static_cast<int>(event), {}};
            }
        }
        return std::nullopt;
    }

private:
    // What came before it watched is over.
    bool is_due(const std::string& name, Time now) {
        const auto found = code_.answers_.events.find(name);
        if (found == code_.answers_.events.end()) return false;
        size_t& next = code_.raised_[name];
        const std::vector<Time>& times = found->second;
        while (next < times.size() && times[next] < started_) ++next;
        if (next == times.size() || times[next] > now) return false;
        ++next;
        return true;
    }

    AnsweringCode& code_;
    const plan::GraphSupervisor& of_;
    const Time started_;
};

std::unique_ptr<Actor> AnsweringCode::make_actor(const plan::GraphActor& of, const std::string&,
                                                 Time) {
    auto found = answers_.actors.find(of.name);
    if (found == answers_.actors.end() && of.of) found = answers_.actors.find(of.of->name);
    if (found == answers_.actors.end() || of.states.empty()) return nullptr;
    const std::vector<ActorAnswer>& all = found->second;
    const size_t running = runnings_[found->first]++;
    return std::make_unique<AnsweringActor>(all[std::min(running, all.size() - 1)], of);
}

std::unique_ptr<Supervisor> AnsweringCode::make_supervisor(const plan::GraphSupervisor& of,
                                                           const std::string&, Time now) {
    if (!answers_.name(of)) return nullptr;
    return std::make_unique<AnsweringSupervisor>(*this, of, now);
}

}  // namespace vagus::run
