#include "trial/script_trial.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>

#include "base/diagnostic.hpp"
#include "base/file.hpp"
#include "base/nearest.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "embed/prepared_run.hpp"
#include "embed/robots_run.hpp"
#include "record/sim_recording.hpp"
#include "trial/script_counter.hpp"
#include "trial/trial_errors.hpp"

namespace vagus::trial {

namespace {

// Scripts of all buses, each counted by the one that knows its program.
class ScriptCounters final : public sim::Witness {
public:
    explicit ScriptCounters(const session::WorldBuses& buses) : buses_(buses) {
        buses.each([this](const session::SimSession& one) { counters_.try_emplace(&one, one); });
    }
    void executes(const sim::WitnessedNode& node, uint16_t pc) override {
        counters_.at(&buses_.of(sim::RobotId{node.robot})).executes(node, pc);
    }
    Coverage coverage() const {
        Coverage all;
        for (const auto& [session, counter] : counters_) all.add(counter.coverage());
        return all;
    }

private:
    const session::WorldBuses& buses_;
    std::map<const session::SimSession*, ScriptCounter> counters_;
};

// Whose signals the conditions read.
Result<sim::RobotId> choose_robot(const TestFile& test, const sim::World& world) {
    const sim::WorldDefinition& definition = world.definition();
    if (!test.robot.empty()) {
        const auto found = world.find_robot(test.robot);
        if (found) return *found;
        return Error{Code::NotFound,
                     test.path + ": " + sim::no_robot(definition, test.robot, " in " + test.world)};
    }
    if (definition.robots.size() == 1) return sim::RobotId{1};
    if (definition.robots.empty()) {
        return Error{Code::NotFound,
                     fmt::format("{}: the world {} has no robot, and conditions are about one",
                                 test.path, test.world)};
    }
    std::vector<std::string> names;
    for (const sim::RobotDefinition& robot : definition.robots) names.push_back(robot.name);
    return Error{
        Code::Refused,
        fmt::format("{}: conditions are about one robot, and {} has {}; choose one, as "
                    "\"robot\": \"{}\"; {}",
                    test.path, test.world, names.size(), names.front(), known_instead("", names))};
}

// The Error says which scripts do not run, and why.
Status check_scripts(const std::string& world, const session::WorldBuses& buses) {
    std::string mistakes;
    for (const Diagnostic& one : buses.mistakes()) mistakes += report_of(one);
    if (mistakes.ends_with('\n')) mistakes.pop_back();
    if (!mistakes.empty()) return Error{Code::BadInput, mistakes};
    const std::vector<std::string> missing = buses.without_script();
    if (missing.empty()) return Status::done();
    return Error{Code::Refused, fmt::format("{}: without the script that is meant for them: {}",
                                            world, list_of({missing.begin(), missing.end()}))};
}

std::vector<std::string> events_of(const aesl::CommonDefinitions& common) {
    std::vector<std::string> names;
    for (const aesl::GlobalEvent& event : common.events) names.push_back(event.name);
    return names;
}

class ScriptTrial {
public:
    ScriptTrial(const TestFile& test, uint64_t seed, const TrialOptions& options)
        : test_(test), options_(options) {
        outcome_.seed = seed;
        no_plan_.plans.emplace_back();
        if (!options.record.empty()) files_.emplace();
    }

    Result<Outcome> run() {
        const Status opened = open();
        if (!opened.ok()) return in_test(test_, opened.error());
        TRY(load());
        TRY(begin_recording());
        bind_listeners();
        TRY(robots_->start());
        const Time end = from_seconds(test_.max_time);
        while (buses().now() < end) robots_->step(sim::kNodeStep);
        run::Ended ended;
        ended.timed_out = true;
        outcome_.verdicts = judge_->end(ended);
        outcome_.end = buses().now();
        outcome_.ended = kEndsMaxTime;
        if (scripts_) outcome_.coverage = scripts_->coverage();
        if (recording_) TRY(recording_->end());
        return std::move(outcome_);
    }

private:
    session::WorldBuses& buses() const { return robots_->buses(); }
    std::string seed() const { return std::to_string(outcome_.seed); }

    Status open() {
        if (test_.starts) outcome_.poses.push_back(TRY(draw_start(test_, outcome_.seed)));
        embed::RobotsOptions options{.world = test_.world};
        options.sim.world = TRY(embed::world_options({seed(), outcome_.poses, options_.chaos}));
        if (options_.chaos.empty()) options.sim.world.chaos = test_.chaos;
        robots_ = TRY(embed::RobotsRun::open(options));
        for (const std::string& path : test_.scripts) {
            buses().common().load(path, TRY(read_file(path)));
        }
        robot_ = TRY(choose_robot(test_, buses().world()));
        outcome_.faults = buses().world().chaos();
        return Status::done();
    }

    // From their first lines on.
    void count_scripts() {
        if (!options_.scripts) return;
        scripts_.emplace(buses());
        buses().world().watch(&*scripts_);
    }

    // At time 0 the scripts run, and what conditions name is known.
    Status load() {
        count_scripts();
        (void)buses().settle();
        TRY(check_scripts(test_.world, buses()));
        session::SimSession& session = session_of_robot();
        judge_.emplace(test_, no_plan_, ReadWorld{&session, robot_, &buses()});
        const std::vector<std::string> events = events_of(session.common());
        for (const Expectation& one : test_.expect) {
            if (!one.condition) continue;
            for (const Status& good : {one.condition->check_events(events), judge_->check(one)}) {
                if (!good.ok()) return at_expectation(test_, one, good.error().what);
            }
        }
        return Status::done();
    }

    Status begin_recording() {
        if (!files_) return Status::done();
        record::RunFile about;
        about.verb = record::kTestVerb;
        about.world = test_.world;
        about.loads = test_.scripts;
        about.seed = seed();
        about.poses = outcome_.poses;
        recording_ = TRY(record::SimRecording::begin(options_.record, about, *files_, *robots_,
                                                     record::Pace::Waits));
        return Status::done();
    }

    session::SimSession& session_of_robot() const {
        for (session::RobotBus& one : buses().robots()) {
            if (one.id == robot_) return *one.session;
        }
        return buses().common();
    }

    void bind_listeners() {
        session::SimSession& session = session_of_robot();
        hear_events(session, [this](Time at, const auto& name) { judge_->event(at, name); });
        session.on_instant([this] { judge_->instant(); });
    }

    const TestFile& test_;
    TrialOptions options_;
    Outcome outcome_;
    std::optional<FilesRead> files_;
    plan::Graph no_plan_;
    std::unique_ptr<embed::RobotsRun> robots_;
    sim::RobotId robot_;
    std::optional<Judge> judge_;
    std::optional<ScriptCounters> scripts_;
    std::unique_ptr<record::SimRecording> recording_;
};

}  // namespace

Result<Outcome> run_script_trial(const TestFile& test, uint64_t seed, const TrialOptions& options) {
    return ScriptTrial(test, seed, options).run();
}

}  // namespace vagus::trial
