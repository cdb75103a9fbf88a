#include "serve/field/service.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "base/project_border.hpp"
#include "base/time.hpp"
#include "fleet/topic.hpp"
#include "net/service_manager.hpp"
#include "serve/field/check.hpp"
#include "serve/field/deploy_commands.hpp"
#include "serve/field/deployments.hpp"
#include "serve/field/fleet_robot.hpp"
#include "serve/field/metrics.hpp"
#include "serve/field/starter.hpp"
#include "serve/field/stop_only.hpp"
#include "serve/field/wanted.hpp"
#include "serve/process.hpp"
#include "serve/web/fetch.hpp"
#include "serve/workbench/server_loop.hpp"
#include "serve/worker.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

// By other commands than those that protocol.json marks, who can reach this page could reach every
// folder of the robot, and change what it starts with at its next boot.
constexpr const char* kServesOneProject =
    "this robot serves one project on one target, from its boot on; `vagus deploy` sends it "
    "another "
    "version, `vagus serve` starts it with another project";

class Service {
public:
    Service(const ServiceOptions& options, const ServiceTalk& talk)
        : options_(options),
          talk_(talk),
          manager_(net::ServiceManager::from_environment()),
          starter_({.missing = [this] { return bench().missing_nodes(); },
                    .start = [this](auto done) { bench().start_run(std::move(done)); },
                    .log = talk.log}),
          versions_(fs::absolute(options.project)),
          deployments_(versions_, starter_, callbacks()),
          wanted_(deployments_, wanted_callbacks()) {}

    Status run() {
        TRY(begin());
        server_.run({.next_tick = [this](Time) { return next_tick(); },
                     .tick = [this](Time now) { tick(now); },
                     .before_end = [this] { manager_.tell("STOPPING=1\nSTATUS=stopping"); }});
        talk_.log("note", "stopped");
        return Status::done();
    }

private:
    Status begin() {
        const fs::path data = user_data_folder(options_.data);
        const auto warn = [this](const std::string& note) { talk_.log("warning", note); };
        TRY(server_.open(options_.door, data, warn, places(data)));
        bench().on_line(talk_.log);
        bench().on_stop([this] {
            starter_.give_up();
            deployments_.stopped();
        });
        bench().on_end([this](const life::End& end) {
            if (end.cause.why == life::Why::Error) starter_.failed(end.message);
        });
        bench().on_death([this] { starter_.died(server_.links().now()); });
        server_.desk().allow_only_on_robot(kServesOneProject);
        declare_deploy_commands(server_.desk(), versions_, deployments_);
        TRY(check_folder());
        TRY(deployments_.boot(options_.start, server_.links().now()));
        adopt_want();
        tell_address();
        TRY(join_fleet());
        return Status::done();
    }

    fs::path own_folder() const { return fs::absolute(options_.project) / ".vagus"; }

    // Earlier versions kept one file for all robots of a folder. It is about the one of them that
    // may be given versions.
    void adopt_want() {
        const fs::path before = own_folder() / "want.json";
        std::error_code failed;
        const bool is_there = !options_.fleet.target.empty() && fs::is_regular_file(before, failed);
        if (is_there && versions_.hold().ok()) wanted_.adopt(before.string());
    }

    Status join_fleet() {
        if (options_.fleet.target.empty()) return Status::done();
        robot_ = TRY(FleetRobot::join(bench(), options_.fleet,
                                      {.wake = [this] { server_.links().wake(); },
                                       .log = talk_.log,
                                       .studio = server_.door().address(),
                                       .want = [this](auto& want) { wanted_.want(want); }},
                                      server_.links().now()));
        if (wanted_.last()) robot_->deployed(*wanted_.last());
        return Status::done();
    }

    // Another version may send and hear something else, or have another name: it joins again, as
    // another instance.
    void tick_fleet(Time now) {
        if (!robot_) return;
        if (bench().project() && !robot_->is_of(*bench().project())) {
            robot_.reset();
            const Status joined = join_fleet();
            if (!joined.ok()) return talk_.log("error", joined.error().what);
        }
        wanted_.tick(now);
        robot_->read_condition(wanted_.lacks_health());
        robot_->does_not_start(starter_.refused());
        robot_->tick(now);
    }

    // Other versions of a single file would have no place.
    Status check_folder() const {
        std::error_code failed;
        if (fs::is_directory(options_.project, failed)) return Status::done();
        return Error{Code::BadInput, options_.project +
                                         ": expected the folder of a project (with a vagus.json), "
                                         "or an empty one for the first `vagus deploy`"};
    }

    Deployments::Callbacks callbacks() {
        return {.check =
                    [this] {
                        return [targets = bench().targets_now()](const fs::path& folder) {
                            return check_project(folder, targets);
                        };
                    },
                .stop =
                    [this](auto done) {
                        bench().stop_run({"the server", life::Why::Version}, std::move(done));
                    },
                .open = [this](const fs::path& folder) -> Status {
                    // What a robot begins with at its start is said by a file, never guessed.
                    std::error_code failed;
                    if (!fs::is_regular_file(folder / kProjectFileName, failed)) {
                        return no_project_file_in(folder.string());
                    }
                    return bench().open(folder.string(), server_.links().now());
                },
                .log = talk_.log,
                .wall_ms = [this] { return server_.desk().wall_ms(); },
                .plan = [this] { return bench().how_plan_is(); },
                .work = [this](Worker::Work work) { worker_.post(std::move(work)); }};
    }

    Wanted::Callbacks wanted_callbacks() {
        const auto fetched = [authority = options_.fleet.ca](const std::string& address) {
            return fetch(address, authority, kPackedBytesMax);
        };
        const std::string file = fleet::escape(robot_name(options_.fleet)) + ".json";
        return {.file = (own_folder() / "want" / file).string(),
                .fetch = fetched,
                .work = [this](Worker::Work work) { fetcher_.post(std::move(work)); },
                .tell =
                    [this](const fleet::Version& version) {
                        if (robot_) robot_->deployed(version);
                    },
                .log = talk_.log,
                .healthy =
                    [this] {
                        const auto& project = bench().project();
                        return project ? project->fleet.healthy : std::nullopt;
                    },
                .read = [this](const plan::WordFormula::Name& name) -> vagus::Result<plan::Value> {
                    if (robot_) return robot_->read(name);
                    return Error{Code::Unavailable, "the robot is in no fleet"};
                }};
    }

    WorkbenchPlaces places(const fs::path& data) const {
        const fs::path config = user_config_folder(options_.config);
        return {.library = {data, share_folder() / "examples"},
                .settings = (config / "settings.json").string(),
                .program = kThisProgram,
                .home = "/",
                .target = options_.target,
                .serves = true};
    }

    // The token stays out of the log, which more people may read.
    void tell_address() {
        talk_.print("serve " + server_.door().address());
        talk_.log("note", "the token is in " + server_.door().token_file());
        if (server_.door().is_open_and_plain()) talk_.log("warning", kPlainWords);
    }

    Time next_tick() const {
        Time next = std::min({starter_.next_tick(), deployments_.next_tick(), figures_at_});
        if (robot_) next = std::min({next, robot_->next_tick(), wanted_.next_tick()});
        if (manager_.watchdog_every()) next = std::min(next, watchdog_at_);
        return next;
    }

    void tick(Time now) {
        worker_.tick();
        fetcher_.tick();
        starter_.tick(now);
        deployments_.tick(now);
        tick_fleet(now);
        tell_manager(now);
        show_figures(now);
    }

    // Everything runs that should: what waits for its first project, or was stopped by a person,
    // has nothing to start.
    bool ready() const {
        if (!bench().project()) return true;
        const Starter::State state = starter_.state();
        return options_.start ? state == Starter::State::Started || state == Starter::State::Idle
                              : bench().missing_nodes().empty();
    }

    // It is ready once; what it does later is its status.
    void tell_manager(Time now) {
        if (!manager_.listens()) return;
        if (manager_.watchdog_every() && now >= watchdog_at_) {
            manager_.tell("WATCHDOG=1");
            watchdog_at_ = now + *manager_.watchdog_every();
        }
        const std::string status = status_line();
        if (status == told_) return;
        told_ = status;
        was_ready_ = was_ready_ || ready();
        manager_.tell((was_ready_ ? "READY=1\nSTATUS=" : "STATUS=") + status);
    }

    std::string status_line() const {
        const Starter::State state = starter_.state();
        const bool says_why = state == Starter::State::Waiting || state == Starter::State::Failed;
        if (says_why) return starter_.why();
        return ready() ? "ready" : "starting";
    }

    void show_figures(Time now) {
        if (now < figures_at_) return;
        figures_at_ = now + kFiguresEvery;
        const DeployCounts& counts = deployments_.counts();
        const ServiceFigures service{.version = VAGUS_VERSION,
                                     .ready = ready(),
                                     .missing = bench().missing_nodes().size(),
                                     .late_worst = seconds_of(server_.take_late_worst()),
                                     .deployed = versions_.current(),
                                     .deployments = counts.started,
                                     .refused = counts.refused,
                                     .rolled_back = counts.rolled_back};
        server_.door().web().publish_metrics(metrics_text(bench().figures(), service));
        const bool failed = starter_.state() == Starter::State::Failed;
        server_.door().web().publish_health(failed ? starter_.why() : "");
    }

    Workbench& bench() { return server_.bench(); }
    const Workbench& bench() const { return server_.bench(); }

    const ServiceOptions& options_;
    const ServiceTalk& talk_;
    net::ServiceManager manager_;
    ServerLoop server_;
    Starter starter_;
    Versions versions_;
    Deployments deployments_;
    Wanted wanted_;
    Worker worker_{[this] { server_.links().wake(); }};  // ends before what its work uses
    Worker fetcher_{[this] { server_.links().wake(); }};
    std::unique_ptr<FleetRobot> robot_;  // ends before the server
    bool was_ready_ = false;
    std::string told_;
    Time figures_at_{}, watchdog_at_{};
};

}  // namespace

Status run_service(const ServiceOptions& options, const ServiceTalk& talk) {
    if (options.stop_only) return stop_only(options, talk);
    return Service(options, talk).run();
}

}  // namespace vagus::serve
