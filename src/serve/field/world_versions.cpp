#include "serve/field/world_versions.hpp"

#include <filesystem>
#include <map>

#include "fleet/topic.hpp"
#include "serve/field/check.hpp"
#include "serve/web/fetch.hpp"
#include "session/known_nodes.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

std::string folder_of(const std::string& project_file) {
    return fs::absolute(project_file).parent_path().string();
}

}  // namespace

WorldVersions::Robot::Robot(WorldVersions& all, size_t index, const std::string& folder)
    : versions(folder_of(all.run_.buses().robots()[index].project.file),
               fs::path(folder) / "versions"),
      starter(all.starter_callbacks(index)),
      deployments(versions, starter, all.callbacks(index)),
      wanted(deployments, all.wanted_callbacks(index, folder)) {}

WorldVersions::WorldVersions(embed::RobotsRun& run, WorldVersionsOptions options,
                             TemporaryFolder folder)
    : run_(run),
      options_(std::move(options)),
      folder_(std::move(folder)),
      worker_(options_.wake),
      fetcher_(options_.wake) {
    const auto& robots = run_.buses().robots();
    for (size_t i = 0; i < robots.size(); ++i) {
        const fs::path own = fs::path(folder_.path()) / fleet::escape(robots[i].name);
        robots_.push_back(std::make_unique<Robot>(*this, i, own.string()));
    }
    run_.deploy_by(
        {.want = [this](size_t robot,
                        const fleet::Want& want) { wants_.emplace_back(robot, want); },
         .stopped =
             [this](size_t robot) {
                 robots_[robot]->starter.give_up();
                 robots_[robot]->deployments.stopped();
             },
         .plan_failed = [this](size_t robot,
                               const std::string& why) { robots_[robot]->starter.failed(why); }});
}

Result<std::unique_ptr<WorldVersions>> WorldVersions::open(embed::RobotsRun& run,
                                                           WorldVersionsOptions options) {
    TemporaryFolder own = TRY(TemporaryFolder::make("world-versions"));
    // make_unique cannot reach the constructor.
    return std::unique_ptr<WorldVersions>(
        new WorldVersions(run, std::move(options), std::move(own)));
}

WorldVersions::~WorldVersions() {
    run_.deploy_by({});
}

// ---- what a robot does for its versions ----

Starter::Callbacks WorldVersions::starter_callbacks(size_t index) {
    return {.missing = [this, index] { return run_.commands(index).missing(); },
            .start = [this, index](auto done) { run_.commands(index).start(std::move(done)); },
            .log = [this, index](const std::string&,
                                 const std::string& text) { run_.say(index, text); }};
}

// Values, for another thread.
Scripts::TargetOf WorldVersions::targets_of(size_t index) const {
    std::map<std::string, aesl::Target> targets;
    const session::SimSession& session = *run_.buses().robots()[index].session;
    for (const session::NodeState& node : session.nodes()) {
        const aesl::Target* const target = session.target(node.id);
        if (target != nullptr) targets[node.name] = *target;
    }
    return [targets = std::move(targets)](const std::string& name, uint16_t) {
        const auto live = targets.find(name);
        return live != targets.end() ? live->second : session::known_node(name);
    };
}

Deployments::Callbacks WorldVersions::callbacks(size_t index) {
    const auto check = [this, index] {
        return [targets = targets_of(index)](const fs::path& folder) {
            return check_project(folder, targets);
        };
    };
    const auto stop = [this, index](std::function<void()> done) {
        run_.commands(index).stop([done = std::move(done)](const auto&) { done(); });
    };
    return {
        .check = check,
        .stop = stop,
        .open = [this, index](
                    const fs::path& folder) { return run_.open_project(index, folder.string()); },
        .log = [this, index](const std::string&,
                             const std::string& text) { run_.say(index, text); },
        .wall_ms = [] { return 0.0; },  // nobody asks a robot of a world when they came
        .plan = [this, index] { return run_.how_plan_is(index); },
        .work = worker_.poster()};
}

Wanted::Callbacks WorldVersions::wanted_callbacks(size_t index, const std::string& folder) {
    const auto fetched = [authority = options_.authority](const std::string& address) {
        return fetch(address, authority, kPackedBytesMax);
    };
    return {.file = (fs::path(folder) / "want.json").string(),
            .fetch = fetched,
            .work = fetcher_.poster(),
            .tell = [this, index](const fleet::Version& version) { run_.deployed(index, version); },
            .log = [this, index](const std::string&,
                                 const std::string& text) { run_.say(index, text); },
            .healthy = [this, index] { return run_.buses().robots()[index].project.fleet.healthy; },
            .read =
                [this, index](const plan::WordFormula::Name& name) {
                    return run_.commands(index).read(name);
                }};
}

// ---- time ----

void WorldVersions::pass(size_t index) {
    Robot& robot = *robots_[index];
    robot.starter.tick(now_);
    robot.deployments.tick(now_);
    robot.wanted.tick(now_);
    run_.commands(index).does_not_start(robot.starter.refused());
}

void WorldVersions::pass(Duration span) {
    now_ += span;
    worker_.tick();
    fetcher_.tick();
    for (const auto& [index, want] : std::exchange(wants_, {})) robots_[index]->wanted.want(want);
    for (size_t i = 0; i < robots_.size(); ++i) pass(i);
}

}  // namespace vagus::serve
