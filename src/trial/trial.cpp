#include "trial/trial.hpp"

#include <fmt/format.h>

#include <memory>

#include "base/file.hpp"
#include "base/nearest.hpp"
#include "base/seconds.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/prepared_run.hpp"
#include "record/plan_recording.hpp"
#include "session/plan_world.hpp"
#include "session/toolboxes.hpp"
#include "sim/chaos_file.hpp"
#include "trial/plan_names.hpp"
#include "trial/script_counter.hpp"
#include "trial/script_trial.hpp"
#include "trial/trial_errors.hpp"

namespace vagus::trial {

namespace {

// ---- one run ----

class Trial {
public:
    Trial(const TestFile& test, uint64_t seed, const TrialOptions& options)
        : test_(test), options_(options) {
        outcome_.seed = seed;
        if (!options.record.empty()) files_.emplace();
    }

    Result<Outcome> run() {
        TRY(load());
        TRY(prepare());
        bind_listeners();
        TRY(begin_recording());
        const run::Ended ended = TRY(prepared_->run());
        outcome_.verdicts = judge_->end(ended);
        outcome_.end = judge_->now();
        outcome_.ended = way_of(ended);
        outcome_.message = ended.message;
        outcome_.coverage = plans_->coverage();
        if (scripts_) outcome_.coverage.add(scripts_->coverage());
        if (recording_) TRY(recording_->end());
        return std::move(outcome_);
    }

private:
    Status load() {
        TRY(session::add_toolboxes(library_, parts_, test_.toolboxes));
        plan_ = embed::LoadedPlan::from_file(test_.plan, library_);
        if (!plan_->ok()) {
            std::string report = plan_->report();
            if (report.ends_with('\n')) report.pop_back();
            return Error{Code::BadInput, report};
        }
        for (Expectation& one : test_.expect) {
            TRY(check_names(one));
            if (!one.condition) continue;
            const Status bound = one.condition->bind(plan_->graph(), !test_.world.empty());
            if (!bound.ok()) return at_expectation(test_, one, bound.error().what);
        }
        return Status::done();
    }

    // Of actors and supervisors: what is misspelt would never come.
    Status check_names(const Expectation& one) {
        const std::vector<std::string> actors = actors_of(plan_->graph());
        std::vector<std::string> supervisors;
        const plan::GraphPlan& outermost = plan_->graph().plans.front();
        for (const auto& global : outermost.globals) supervisors.push_back(global.name);
        for (const plan::GraphActor& actor : outermost.actors) {
            for (const auto& own : actor.supervisors) supervisors.push_back(own.name);
        }
        for (const std::string& name : one.order) {
            const std::string last = name.substr(name.rfind('/') + 1);
            if (std::ranges::find(actors, last) != actors.end()) continue;
            return at_expectation(
                test_, one,
                fmt::format("the plan has no actor \"{}\"; {}", last, known_instead(last, actors)));
        }
        if (one.by.empty() || std::ranges::find(supervisors, one.by) != supervisors.end()) {
            return Status::done();
        }
        return at_expectation(test_, one,
                              fmt::format("the plan has no supervisor \"{}\"; {}", one.by,
                                          known_instead(one.by, supervisors)));
    }

    Status prepare() {
        words_.world = test_.world;
        words_.toolboxes = test_.toolboxes;
        words_.set = test_.set;
        words_.robot = test_.robot;
        words_.seed = std::to_string(outcome_.seed);
        words_.max_time = plan::text_of(test_.max_time);
        words_.clock = "virtual";
        if (test_.answers) words_.answers = test_.path;
        words_.chaos = options_.chaos;
        if (words_.chaos.empty() && !test_.chaos.faults.empty()) words_.chaos = test_.path;
        if (test_.starts) words_.poses.push_back(TRY(draw_start(test_, outcome_.seed)));
        outcome_.poses = words_.poses;
        auto prepared = embed::PreparedRun::prepare(*plan_, words_, parts_);
        if (!prepared.ok()) return in_test(test_, prepared.error());
        prepared_ = std::move(prepared.value());
        prepared_->tell([](const std::string&) {});
        session::PlanWorld* const world = prepared_->world();
        if (world != nullptr) outcome_.faults = world->session().world().chaos();
        judge_.emplace(test_, plan_->graph(), read_world_of(world));
        return world != nullptr ? check_words() : Status::done();
    }

    // Of nodes: they are known where the robot is.
    Status check_words() const {
        for (const Expectation& one : test_.expect) {
            const Status there = judge_->check(one);
            if (!there.ok()) return at_expectation(test_, one, there.error().what);
        }
        return Status::done();
    }

    void bind_listeners() {
        plans_.emplace(plan_->graph());
        prepared_->listen([this](const plan::TraceEvent& event) {
            plans_->see(event);
            judge_->line(event);
        });
        session::PlanWorld* const world = prepared_->world();
        if (world == nullptr) return;
        world->session().on_instant([this] { judge_->instant(); });
        if (!options_.scripts) return;
        scripts_.emplace(world->session());
        world->session().world().watch(&*scripts_);
    }

    Status begin_recording() {
        if (!files_) return Status::done();
        record::RunFile about;
        about.verb = "plan run";
        about.plan = test_.plan;
        about.world = words_.world;
        about.toolboxes = words_.toolboxes;
        about.set = words_.set;
        about.seed = words_.seed;
        about.max_time = words_.max_time;
        about.robot = words_.robot;
        about.poses = words_.poses;
        about.answers = words_.answers;
        recording_ = TRY(record::PlanRecording::begin(options_.record, about, files_->all(),
                                                      *prepared_, record::Pace::Waits));
        return Status::done();
    }

    TestFile test_;  // its conditions are bound to this plan
    TrialOptions options_;
    Outcome outcome_;
    std::optional<FilesRead> files_;
    toolbox::Parts parts_;  // before the library, whose code looks at them
    run::CodeLibrary library_;
    std::optional<embed::LoadedPlan> plan_;
    embed::RunWords words_;
    std::optional<Judge> judge_;
    std::optional<PlanCounter> plans_;
    std::optional<ScriptCounter> scripts_;
    std::unique_ptr<embed::PreparedRun> prepared_;
    std::unique_ptr<record::PlanRecording> recording_;
};

}  // namespace

Time Outcome::failed_at() const {
    Time first = Time::max();
    for (const Verdict& one : verdicts) {
        if (!one.as_expected) first = std::min(first, one.at);
    }
    return first;
}

Result<Outcome> run_trial(const TestFile& test, uint64_t seed, const TrialOptions& options) {
    if (test.plan.empty()) return run_script_trial(test, seed, options);
    return Trial(test, seed, options).run();
}

// ---- through a pipe ----

namespace {

std::string verdict_json(const Verdict& verdict) {
    return fmt::format("[{},{},{}]", verdict.as_expected, verdict.at.count(),
                       json_quote(verdict.what));
}

std::string list_json(const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) text += (text.empty() ? "" : ",") + item;
    return "[" + text + "]";
}

}  // namespace

std::string format_outcome(const Outcome& outcome) {
    std::vector<std::string> verdicts, poses;
    for (const Verdict& one : outcome.verdicts) verdicts.push_back(verdict_json(one));
    for (const std::string& one : outcome.poses) poses.push_back(json_quote(one));
    return fmt::format(
        R"({{"seed":{},"verdicts":{},"end":{},"ended":{},"message":{},"poses":{},"chaos":{},)"
        R"("coverage":{}}})",
        outcome.seed, list_json(verdicts), outcome.end.count(), json_quote(outcome.ended),
        json_quote(outcome.message), list_json(poses), sim::format_chaos(outcome.faults),
        format_coverage(outcome.coverage));
}

Outcome read_outcome(std::string_view text) {
    const auto read = read_json(text);
    const JsonValue& json = std::get<JsonValue>(read);
    Outcome outcome;
    outcome.seed = static_cast<uint64_t>(json.find("seed")->integer);
    for (const JsonValue& one : json.find("verdicts")->items) {
        outcome.verdicts.push_back({.as_expected = one.items[0].boolean,
                                    .at = Time(one.items[1].integer),
                                    .what = one.items[2].text});
    }
    outcome.end = Time(json.find("end")->integer);
    outcome.ended = json.find("ended")->text;
    outcome.message = json.find("message")->text;
    for (const JsonValue& one : json.find("poses")->items) outcome.poses.push_back(one.text);
    sim::Chaos chaos;
    Complaints none;
    sim::read_chaos(*json.find("chaos"), chaos, none);
    outcome.faults = std::move(chaos.faults);
    outcome.coverage = read_coverage(*json.find("coverage"));
    return outcome;
}

}  // namespace vagus::trial
