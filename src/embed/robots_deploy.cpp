// Robots of a world that a fleet gives another project, starts and stops: what RobotsRun does for
// them while the world goes on.
#include "base/file.hpp"
#include "embed/robots_run.hpp"

namespace vagus::embed {

using session::RobotBus;

namespace {

// What a host that has just come would hear of who is there.
std::vector<debug::Event> who_is_there(session::SimSession& session) {
    std::vector<debug::Event> events;
    for (const session::NodeState& node : session.nodes()) {
        const debug::NodeView* const view = session.network().node(node.id);
        if (view == nullptr || !view->connected || !view->described) continue;
        events.push_back({session.clock(), node.id, debug::NodeDescribed{view->name}});
        events.push_back(
            {session.clock(), node.id, debug::StateChanged{.state = view->state, .at = {}}});
    }
    return events;
}

}  // namespace

void RobotsRun::add_commands(size_t index) {
    const auto stopped = [this, index] {
        if (deployer_.stopped) deployer_.stopped(index);
    };
    const auto failed = [this, index](const std::string& why) {
        if (deployer_.plan_failed) deployer_.plan_failed(index, why);
    };
    versions_.emplace_back();
    commands_.push_back(std::make_unique<RobotCommands>(
        buses_->robots()[index], plans_[index],
        RobotCommands::Calls{.begin_plan = [this, index] { return begin_plan_again(index); },
                             .stopped = stopped,
                             .plan_failed = failed}));
}

// Later than at time 0.
Status RobotsRun::begin_plan_again(size_t index) {
    RobotBus& robot = buses_->robots()[index];
    RobotPlan& plan = *plans_[index];
    TRY(plan.begin(seed_ + robot.id.number, who_is_there(*robot.session), told_by_plan(index),
                   buses_->now()));
    return plan.join(fleet_->asked_by(robot.id));
}

Status RobotsRun::open_project(size_t index, const std::string& folder) {
    RobotBus& robot = buses_->robots()[index];
    const session::ProjectFile project = TRY(session::open_project(folder));
    plans_[index].reset();  // it is over; what it still has to say is for the project before
    robot.project = project;
    robot.session->hold_scripts();
    robot.session->forget_scripts();
    for (const std::string& named : project.scripts) {
        const std::string path = project.path_of(named);
        const std::string text = TRY(read_file(path));
        robot.session->load_for(robot.id, path, text);
    }
    if (!project.plan.empty()) plans_[index] = TRY(RobotPlan::load(robot));
    commands_[index]->project_changed();
    TRY(fleet_->join_again(robot, asks_fleet(index)));
    tell_version(index);
    return Status::done();
}

void RobotsRun::deployed(size_t index, const fleet::Version& version) {
    versions_[index] = version;
    tell_version(index);
}

// Also to those who hear this member for the first time.
void RobotsRun::tell_version(size_t index) {
    if (fleet_ && versions_[index]) {
        fleet_->deployed(buses_->robots()[index].id, *versions_[index]);
    }
}

std::string RobotsRun::how_plan_is(size_t index) const {
    const RobotPlan* const plan = plans_[index].get();
    if (plan == nullptr) return "";
    if (!plan->over()) return "its plan runs";
    const std::string ended =
        plan->ended() ? std::string(plan::name_of(plan->ended()->result)) : "it has not begun";
    return "its plan is over: " + ended;
}

}  // namespace vagus::embed
