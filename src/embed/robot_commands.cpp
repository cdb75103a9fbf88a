#include "embed/robot_commands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "fleet/limits.hpp"
#include "run/traced_variables.hpp"
#include "session/driving.hpp"

namespace vagus::embed {

namespace {

fleet::Answer answer_of(const std::string& why) {
    if (why.empty()) return {.done = true};
    return {.what = std::string(utf8_prefix(why, fleet::kLineBytesMax))};
}

// Stopped means read back: who did not say so is named.
fleet::Answer answer_of_stop(const std::vector<session::StopNode>& nodes) {
    fleet::Answer answer{.done = true};
    for (const session::StopNode& node : nodes) {
        if (node.state == session::StopNode::State::Stopped) continue;
        answer.done = false;
        if (answer.silent.size() >= fleet::kNodesMax) break;
        answer.silent.push_back(node.name.empty() ? fmt::format("node {}", node.node) : node.name);
    }
    return answer;
}

// "robot.aesl:28: division by zero": where the project is on this computer helps nobody elsewhere.
std::string in_project(const session::RobotBus& robot, const std::string& sentence) {
    const std::string folder = robot.project.path_of("");
    return sentence.starts_with(folder) ? sentence.substr(folder.size()) : sentence;
}

// Of most projects nothing. One whose toolboxes cannot be read was refused by then.
std::optional<session::SafeStop> own_safe_stop(const session::ProjectFile& project) {
    if (project.toolboxes.empty() && project.safe_stop.empty()) return std::nullopt;
    std::vector<std::string> toolboxes;
    for (const std::string& one : project.toolboxes) toolboxes.push_back(project.path_of(one));
    auto safe = session::safe_stop_of(toolboxes, project.safe_stop);
    return safe.ok() ? std::optional(std::move(safe.value())) : std::nullopt;
}

}  // namespace

RobotCommands::RobotCommands(session::RobotBus& robot, const std::unique_ptr<RobotPlan>& plan,
                             Calls calls)
    : robot_(robot),
      plan_(plan),
      call_(std::move(calls)),
      own_safe_(own_safe_stop(robot.project)),
      nodes_(*robot.session) {}

// ---- what it is told ----

void RobotCommands::obey(const fleet::Command& command, Answered done) {
    const std::string& verb = command.verb;
    if (verb == "stop") {
        call_.stopped();
        return stop([done = std::move(done)](const std::vector<session::StopNode>& nodes) {
            done(answer_of_stop(nodes));
        });
    }
    const Done told = [done = std::move(done)](const std::string& why) { done(answer_of(why)); };
    if (verb == "start") return start(told);
    if (verb == "pause") return pause(told);
    if (verb == "continue") return go_on(told);
    if (verb == "raise") return raise(command, told);
    if (verb == "set") return set(command, told);
    if (verb == "emit" || verb == "identify") {
        const std::string& event = verb == "emit" ? command.event : verb;
        return told(emit(event, command.values));
    }
    told(verb + " is no command of this version");
}

// The plan is a host as well: what the fleet says on the bus does not come back to it from there.
std::string RobotCommands::emit(const std::string& event, const std::vector<int16_t>& values) {
    const Status sent = robot_.session->emit(event, values, robot_.session->now());
    if (!sent.ok()) return sent.error().what;
    if (plan_runs()) plan_->hear(run::BusEvent{event, values, wire::kHostId, 0});
    return "";
}

// The plan first: what its code says as it ends is in front of what brings the nodes to rest.
void RobotCommands::stop(session::NodeCommands::Stopped done) {
    plan_error_.clear();
    is_stopped_ = true;
    if (plan_ != nullptr) plan_->abort();
    nodes_.stop(safe_stop(), std::move(done));
}

void RobotCommands::start(Done done) {
    is_stopped_ = false;
    if (paused()) return go_on(std::move(done));
    nodes_.start([this, done = std::move(done)](const std::string& why) {
        if (!why.empty()) return done(why);
        if (plan_ == nullptr || plan_runs()) return done("");
        const Status begun = call_.begin_plan();
        done(begun.ok() ? "" : begun.error().what);
    });
}

// Its plan first: what it would still tell a node that is paused is lost.
void RobotCommands::pause(Done done) {
    if (paused()) return done("");
    const bool has_plan = plan_runs();
    if (has_plan) plan_->pause(robot_.session->now());
    if (has_plan && !nodes_.any_runs()) return done("");
    nodes_.pause(safe_stop(), std::move(done));
}

void RobotCommands::go_on(Done done) {
    if (!paused()) return done("it is not paused");
    if (plan_runs()) plan_->go_on(robot_.session->now());
    if (!nodes_.paused()) return done("");
    nodes_.go_on(std::move(done));
}

void RobotCommands::raise(const fleet::Command& command, const Done& done) {
    if (!plan_runs()) return done("no plan runs");
    const Status raised = plan_->raise(command.supervisor, command.event);
    done(raised.ok() ? "" : raised.error().what);
}

void RobotCommands::set(const fleet::Command& command, Done done) {
    if (!command.node.empty()) {
        const debug::Network& network = robot_.session->network();
        const auto node = network.find(command.node);
        const std::string why =
            node.ok() ? session::why_not_from_afar(network, node.value(), command.name,
                                                   command.values, safe_stop())
                      : "";
        if (!why.empty()) return done(why);
        return nodes_.set(command.node, command.name, command.values, std::move(done));
    }
    if (!plan_runs()) return done("no plan runs; name the node of the variable: NODE.NAME");
    if (command.values.size() != 1) return done("a variable of a plan takes one value");
    const Status set = plan_->set(command.name, plan::Value(int64_t{command.values.front()}));
    done(set.ok() ? "" : set.error().what);
}

void RobotCommands::project_changed() {
    own_safe_ = own_safe_stop(robot_.project);
    plan_error_.clear();
}

// What its code could not end in order after a Stop is no error of the plan.
void RobotCommands::see(const plan::TraceEvent& event) {
    if (run::level_of(event) > 0) return;
    if (const auto* began = std::get_if<plan::ActorStarted>(&event.what)) actor_ = began->actor;
    if (std::holds_alternative<plan::PlanStarted>(event.what)) plan_error_.clear();
    const auto* const ended = std::get_if<plan::PlanEnded>(&event.what);
    const bool failed = ended != nullptr && ended->result == plan::PlanResult::Error;
    if (!failed || is_stopped_) return;
    plan_error_ = ended->message;
    call_.plan_failed(ended->message);
}

// ---- what is seen of it ----

fleet::Shown RobotCommands::shown() const {
    fleet::Shown shown;
    const auto add = [&shown](const std::string& problem) {
        if (shown.problems.size() >= fleet::kProblemsMax) return;
        shown.problems.emplace_back(utf8_prefix(problem, fleet::kLineBytesMax));
    };
    if (!refused_.empty()) add(refused_);
    bool runs = false, away = false;
    for (const session::NodeState& node : robot_.session->nodes()) {
        if (!node.name.empty()) shown.nodes.push_back(node.name);
        const debug::NodeView* const view = robot_.session->network().node(node.id);
        const bool is_away = view != nullptr && !view->connected;
        if (is_away) add(node.name + " is away");
        away = away || is_away;
        if (!node.fault.empty()) add(node.name + ": " + in_project(robot_, node.fault));
        const bool running = node.has_script && node.state == debug::ProgramState::Running;
        const std::string endless = running ? robot_.session->endless(node.id) : "";
        if (!endless.empty()) {
            add(node.name + ": " + in_project(robot_, endless));
        } else if (running && !node.killed.empty()) {
            add(node.name + ": " + in_project(robot_, node.killed));
        }
        runs = runs || running;
    }
    if (!plan_error_.empty()) add("its plan ended in an error: " + plan_error_);
    if (plan_runs()) shown.actor = actor_;
    const char* const does = paused() ? "paused" : runs || plan_runs() ? "running" : "stopped";
    // One that is stopped does what it is to do; what was wrong before that is told all the same.
    const bool is_well = shown.problems.empty() || (is_stopped_ && !runs && !away);
    shown.state = is_well ? does : "fault";
    return shown;
}

Result<std::vector<int16_t>> RobotCommands::values(const fleet::Tells& variable) const {
    const session::SimSession& session = *robot_.session;
    const uint16_t id = TRY(robot_.session->network().find(variable.node));
    for (const auto& [name, values] : session.script_variables(id)) {
        if (name == variable.name) return std::vector<int16_t>(values.begin(), values.end());
    }
    const auto range = TRY(robot_.session->network().variable(id, variable.name));
    const auto memory = session.world().variables(robot_.id, id);
    if (size_t{range.address} + range.count > memory.size()) {
        return Error{Code::Unavailable, variable.name + " is not there yet"};
    }
    const auto values = memory.subspan(range.address, range.count);
    return std::vector<int16_t>(values.begin(), values.end());
}

Result<plan::Value> RobotCommands::read(const plan::WordFormula::Name& name) const {
    if (name.of != plan::WordFormula::Name::Of::Word) {
        if (plan_ != nullptr) return plan_->variable(name.variable);
        return Error{Code::Unavailable, "the robot has no plan, which has its variables"};
    }
    const std::vector<int16_t> found = TRY(values({name.node, name.variable}));
    if (name.element < found.size()) return plan::Value(int64_t{found[name.element]});
    return Error{Code::NotFound, fmt::format("{}: \"{}\" has {} elements, counted from 0",
                                             name.shown, name.variable, found.size())};
}

std::vector<std::string> RobotCommands::missing() const {
    std::vector<std::string> names;
    for (const session::NodeState& node : robot_.session->nodes()) {
        const debug::NodeView* const view = robot_.session->network().node(node.id);
        if (view != nullptr && view->connected && view->described) continue;
        names.push_back(node.name.empty() ? fmt::format("node {}", node.id) : node.name);
    }
    return names;
}

}  // namespace vagus::embed
