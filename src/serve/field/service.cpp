#include "serve/field/service.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "net/network.hpp"
#include "net/service_manager.hpp"
#include "serve/field/check.hpp"
#include "serve/field/deploy_commands.hpp"
#include "serve/field/deployments.hpp"
#include "serve/field/metrics.hpp"
#include "serve/field/starter.hpp"
#include "serve/process.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr Duration kLastWords = 500ms;  // for what was sent before the end

// Who can reach this page could reach every folder of the robot by them, and change what it starts
// with at its next boot.
constexpr const char* kOtherProjects[] = {"project.example", "project.open",   "project.new",
                                          "project.close",   "project.forget", "folder.list",
                                          "target.choose",   "target.leave"};

double seconds(Duration duration) {
    return std::chrono::duration<double>(duration).count();
}

class Service {
public:
    Service(const ServiceOptions& options, const ServiceTalk& talk)
        : options_(options),
          talk_(talk),
          manager_(net::ServiceManager::from_environment()),
          starter_({.missing = [this] { return bench_->missing_nodes(); },
                    .start = [this](auto done) { bench_->start_run(std::move(done)); },
                    .log = talk.log}),
          versions_(fs::absolute(options.project)),
          deployments_(versions_, starter_, robot()) {}

    Status run() {
        TRY(network_.watch_signals());
        TRY(begin());
        while (!ended_) {
            const Time due = next_tick();
            for (const net::Event& event : network_.poll(due)) hear(event);
            turn();
            late_worst_ = std::max(late_worst_, network_.now() - due);
        }
        end();
        return Status::done();
    }

private:
    Status begin() {
        const fs::path data = user_data_folder(options_.data);
        door_.emplace(TRY(Door::open(options_.door, data, [this] { network_.wake(); })));
        desk_ = std::make_unique<Desk>(door_->access(), door_->outside([this](const auto& note) {
            talk_.log("warning", note);
        }));
        bench_ = std::make_unique<Workbench>(network_, *desk_, places(data));
        bench_->on_line(talk_.log);
        bench_->on_stop([this] {
            starter_.give_up();
            deployments_.stopped();
        });
        bench_->on_death([this] { starter_.died(network_.now()); });
        refuse_other_projects();
        declare_deploy_commands(*desk_, versions_, deployments_);
        TRY(check_folder());
        TRY(deployments_.boot(options_.start, network_.now()));
        tell_address();
        return Status::done();
    }

    // Other versions of a file that stands alone would have no place.
    Status check_folder() const {
        std::error_code failed;
        if (fs::is_directory(options_.project, failed)) return Status::done();
        return Error{Code::BadInput, options_.project +
                                         ": expected the folder of a project (with a vagus.json), "
                                         "or an empty one for the first `vagus deploy`"};
    }

    Deployments::Robot robot() {
        return {.check =
                    [this](const fs::path& folder) {
                        return check_project(folder, [this](const auto& name, uint16_t id) {
                            return bench_->target_of(name, id);
                        });
                    },
                .stop = [this](auto done) { bench_->stop_run(std::move(done)); },
                .open =
                    [this](const fs::path& folder) {
                        return bench_->open(folder.string(), network_.now());
                    },
                .log = talk_.log,
                .wall_ms = [this] { return desk_->wall_ms(); }};
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

    void refuse_other_projects() {
        for (const char* command : kOtherProjects) {
            desk_->command(command, [](const Call& call) {
                call.fail("not_allowed",
                          "this robot serves one project on one target, from its boot on; "
                          "`vagus deploy` sends it another version, `vagus serve` starts it with "
                          "another project");
            });
        }
    }

    // The token stays out of the log, which more people may read.
    void tell_address() {
        talk_.print("serve " + door_->address());
        talk_.log("note", "the token is in " + door_->token_file());
        if (door_->is_open_and_plain()) talk_.log("warning", kPlainWords);
    }

    void hear(const net::Event& event) {
        if (event.kind == net::EventKind::Signal) {
            ended_ = true;
        } else {
            bench_->hear(event);
        }
    }

    Time next_tick() const {
        const Time now = network_.now();
        Time next = std::min(
            {bench_->next_tick(now), desk_->next_tick(now), starter_.next_tick(), figures_at_});
        if (manager_.watchdog_every()) next = std::min(next, watchdog_at_);
        return next;
    }

    void turn() {
        const Time now = network_.now();
        for (const WebEvent& event : door_->web().take()) desk_->hear(event, now);
        bench_->tick(now);
        starter_.tick(now);
        deployments_.tick(now);
        desk_->tick(now);
        tell_manager(now);
        show_figures(now);
    }

    // Everything runs that should: what waits for its first project, or was stopped by a person,
    // has nothing to start.
    bool ready() const {
        if (!bench_->project()) return true;
        const Starter::State state = starter_.state();
        return options_.start ? state == Starter::State::Started || state == Starter::State::Idle
                              : bench_->missing_nodes().empty();
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
        if (starter_.state() == Starter::State::Waiting) return starter_.why();
        return ready() ? "ready" : "starting";
    }

    void show_figures(Time now) {
        if (now < figures_at_) return;
        figures_at_ = now + kFiguresEvery;
        const DeployCounts& counts = deployments_.counts();
        const ServiceFigures service{.version = VAGUS_VERSION,
                                     .ready = ready(),
                                     .missing = bench_->missing_nodes().size(),
                                     .late_worst = seconds(std::exchange(late_worst_, {})),
                                     .deployed = versions_.current(),
                                     .deployments = counts.started,
                                     .refused = counts.refused,
                                     .rolled_back = counts.rolled_back};
        door_->web().publish_metrics(metrics_text(bench_->figures(), service));
    }

    // Nothing goes on without its server.
    void end() {
        manager_.tell("STOPPING=1\nSTATUS=stopping");
        bench_->stop_everything();
        const Time until = network_.now() + kLastWords;
        while (network_.now() < until && network_.has_unwritten()) (void)network_.poll(until);
        bench_->close();
        desk_->tick(network_.now());
        talk_.log("note", "stopped");
    }

    const ServiceOptions& options_;
    const ServiceTalk& talk_;
    net::ServiceManager manager_;
    net::Network network_;
    std::optional<Door> door_;
    std::unique_ptr<Desk> desk_;
    std::unique_ptr<Workbench> bench_;
    Starter starter_;
    Versions versions_;
    Deployments deployments_;
    bool ended_ = false, was_ready_ = false;
    std::string told_;
    Time figures_at_{}, watchdog_at_{};
    Duration late_worst_{};
};

}  // namespace

Status run_service(const ServiceOptions& options, const ServiceTalk& talk) {
    return Service(options, talk).run();
}

}  // namespace vagus::serve
