#include "serve/runner/try_host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json.hpp"
#include "base/time.hpp"
#include "embed/loaded_plan.hpp"
#include "run/answers.hpp"
#include "run/options.hpp"
#include "run/tried_way.hpp"
#include "run/virtual_time.hpp"
#include "serve/follow/plan_follower.hpp"
#include "serve/json.hpp"
#include "serve/plan_value.hpp"
#include "serve/runner/one_answer.hpp"
#include "session/toolboxes.hpp"
#include "trial/judge.hpp"

namespace vagus::serve {

namespace {

constexpr double kRoomAfterEnd = 10;  // s, of the test of a way that ends the plan

std::vector<run::TriedChoice> way_of(const Json& asked) {
    std::vector<run::TriedChoice> way;
    for (const Json& one : asked["way"]) {
        run::TriedChoice choice{one["path"], one["element"], one["outcome"]};
        for (const Json& output : one.value("out", Json::array())) {
            choice.out.emplace_back(output["name"], plan_value(output["value"]));
        }
        way.push_back(std::move(choice));
    }
    return way;
}

// Those that the plan uses, in the order in which the template declares them.
Json outputs_of(const plan::GraphActor& actor) {
    Json outputs = Json::array();
    for (const plan::OutputDeclaration& one : actor.of->outputs) {
        const auto is_it = [&one](const auto& used) { return used.name == one.name; };
        if (std::ranges::none_of(actor.outputs, is_it)) continue;
        Json output = {{"name", one.name}};
        if (one.type) output["type"] = plan::name_of(*one.type);
        outputs.push_back(std::move(output));
    }
    return outputs;
}

plan::Graph all_checked_in_time(const plan::Graph& graph) {
    return run::with_checks_in_time(graph, [](const plan::GraphSupervisor&) { return true; });
}

// One plan, tried along one way.
class TriedPlan {
public:
    TriedPlan(const embed::LoadedPlan& plan, std::vector<run::TriedChoice> choices)
        : plan_(plan),
          way_(std::move(choices)),
          follower_(std::make_shared<const PlanOutlines>(outlines_of(plan.plans())),
                    [](const std::string& file) { return file; }) {}

    Json run() {
        const plan::Graph graph = all_checked_in_time(plan_.graph());
        const run::RunOptions options = {
            .on_trace = [this](const plan::TraceEvent& event) { see(event); },
            .code_source = &way_};
        run::VirtualTime run(graph, plan_.library(), options);
        way_.at_its_end([this, &run] {
            if (!waits_) tell_where_it_waits(run.now());
            run.abort();
        });
        run.run();
        if (!waits_) {
            document_ = follower_.document(seconds_of(run.now()), false);
            end_ = run.now();
        }
        return answer();
    }

    std::string test(const Json& asked) const {
        const double end = seconds_of(end_);
        std::string order;
        for (const run::TriedWay::Turn& turn : way_.turns()) {
            order += (order.empty() ? "" : ", ") +
                     json_quote(trial::name_in_order(turn.path, turn.actor));
        }
        const std::string path = asked["plan"];
        std::string toolboxes;
        for (const std::string one : asked["toolboxes"]) {
            const auto near = std::filesystem::path(one).lexically_relative(
                std::filesystem::path(path).parent_path());
            toolboxes += (toolboxes.empty() ? "" : ", ") + json_quote(near.generic_string());
        }
        return fmt::format(
            "{{\n  \"format\": \"vagus-test/1\",\n  \"help\": \"Tried by hand.\",\n"
            "  \"plan\": {},\n{}  \"max_time\": {},\n  \"answers\": {},\n  \"expect\": [\n"
            "    {{ \"order\": [{}] }},\n    {{ \"ends\": {} }}\n  ]\n}}\n",
            json_quote(std::filesystem::path(path).filename().string()),
            toolboxes.empty() ? "" : "  \"toolboxes\": [" + toolboxes + "],\n",
            waits_ ? end : std::ceil(end + kRoomAfterEnd), way_.answers(plan_.graph()), order,
            json_quote(waits_ ? "MaxTime" : document_.value("result", "OK")));
    }

    // Whether a run with those answers takes the same way: elements of a plan and its sub-plans may
    // have the same name, and answers go by names.
    Status check_answers() const {
        const JsonValue json = TRY(parse_json(way_.answers(plan_.graph()), "the answers"));
        const auto answers = TRY(run::Answers::read(json, "the answers", plan_.graph()));
        run::AnsweringCode code(answers);
        const plan::Graph graph = answers.checked_in_time(plan_.graph());
        std::vector<std::string> came;
        const run::RunOptions options = {
            .max_time = end_ + Duration{1},
            .on_trace =
                [&came](const plan::TraceEvent& event) {
                    const auto* started = std::get_if<plan::ActorStarted>(&event.what);
                    if (started) came.push_back(event.plan + "/" + std::string(started->actor));
                },
            .code_source = &code};
        run::VirtualTime(graph, plan_.library(), options).run();
        if (came == came_) return Status::done();
        return Error{Code::Refused,
                     "this way cannot be kept as a test: answers go by the names of actors and "
                     "supervisors, and some of the plan and its sub-plans have the same name; "
                     "rename them"};
    }

private:
    void see(const plan::TraceEvent& event) {
        if (waits_) return;  // what follows is the end of the try
        follower_.see(event);
        if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
            came_.push_back(event.plan + "/" + std::string(started->actor));
        }
    }

    void tell_where_it_waits(Time now) {
        waits_ = true;
        end_ = now;
        document_ = follower_.document(seconds_of(now), true);
        for (const PlanFollower::Watching& one : follower_.watching()) {
            raises_.push_back(
                {{"path", one.path}, {"supervisor", one.name}, {"events", events_of(one)}});
        }
    }

    Json events_of(const PlanFollower::Watching& watching) const {
        Json events = Json::array();
        const auto add = [&](const std::vector<plan::GraphSupervisor>& all) {
            for (const plan::GraphSupervisor& one : all) {
                if (one.name != watching.name || !events.empty()) continue;
                for (const plan::Outcome& event : one.of->outcomes) events.push_back(event.name);
            }
        };
        const plan::GraphPlan* const at = plan_at(watching.path);
        if (at == nullptr) return events;
        if (watching.global) add(at->globals);
        if (watching.global) return events;
        for (const plan::GraphActor& actor : at->actors) add(actor.supervisors);
        return events;
    }

    // By the names of its callers: "Hall/call".
    const plan::GraphPlan* plan_at(const std::string& path) const {
        const plan::Graph& graph = plan_.graph();
        const plan::GraphPlan* at = &graph.plans.front();
        for (size_t from = path.find('/'); from != std::string::npos;) {
            const size_t to = path.find('/', from + 1);
            const int actor = plan::find_actor(*at, path.substr(from + 1, to - from - 1));
            if (actor < 0) return nullptr;
            at = &graph.plans[static_cast<size_t>(at->actors[static_cast<size_t>(actor)].sub_plan)];
            from = to;
        }
        return at;
    }

    Json answer() const {
        Json turns = Json::array();
        for (const run::TriedWay::Turn& turn : way_.turns()) {
            Json one = {
                {"path", turn.path}, {"actor", turn.actor}, {"from", seconds_of(turn.started)}};
            if (turn.ended) one["to"] = seconds_of(*turn.ended);
            if (turn.ended) one["end"] = turn.by.empty() ? turn.state : turn.by;
            if (!turn.by.empty()) one["interrupted"] = true;
            turns.push_back(std::move(one));
        }
        Json answer = {{"plan", document_},
                       {"raises", raises_},
                       {"turns", std::move(turns)},
                       {"taken", Json::array()},
                       {"left", way_.left()}};
        for (const Time at : way_.taken()) answer["taken"].push_back(seconds_of(at));
        if (waits_) {
            answer["waits"] = {{"path", way_.waits()->path},
                               {"actor", way_.waits()->actor},
                               {"states", way_.waits_of()->states},
                               {"outputs", outputs_of(*way_.waits_of())}};
        }
        return answer;
    }

    const embed::LoadedPlan& plan_;
    run::TriedWay way_;
    PlanFollower follower_;
    Json document_;
    Json raises_ = Json::array();
    Time end_{};
    bool waits_ = false;
    std::vector<std::string> came_;  // paths of actors
};

Result<Json> tried(const Json& asked) {
    const toolbox::Parts parts;
    run::CodeLibrary library;
    TRY(session::add_toolboxes(library, parts, asked["toolboxes"].get<std::vector<std::string>>()));
    const auto plan = embed::LoadedPlan::from_texts(
        asked["plan"], asked["texts"].get<std::map<std::string, std::string>>(), library);
    if (!plan.ok()) return Error{Code::BadInput, plan.report()};
    TriedPlan plan_tried(plan, way_of(asked));
    Json answer = plan_tried.run();
    if (asked.value("keep", false)) {
        TRY(plan_tried.check_answers());
        answer["test"] = plan_tried.test(asked);
    }
    return answer;
}

}  // namespace

std::string answer_try(const std::string& question) {
    const Json asked = Json::parse(question, nullptr, false);
    if (!asked.is_object() || !asked.contains("plan") || !asked.contains("way")) return "";
    const auto answer = tried(asked);
    const Json told = answer.ok() ? answer.value() : Json{{"error", answer.error().what}};
    return json_text(told);
}

int run_try(Pipe pipe) {
    return answer_one(std::move(pipe), {kTryAsked, kTryAnswered}, answer_try);
}

}  // namespace vagus::serve
