#include "session/plan_world.hpp"

#include <algorithm>
#include <set>

#include "base/nearest.hpp"
#include "base/text.hpp"

namespace vagus::session {

namespace {

std::string joined(const std::vector<Diagnostic>& list) {
    std::string text;
    for (const Diagnostic& one : list) text += report_of(one);
    if (text.ends_with('\n')) text.pop_back();
    return text;
}

// The scripts run, or the Error says which do not and why.
Status settle(SimSession& session, const std::string& path) {
    const bool settled = session.settle();
    const std::vector<Diagnostic> mistakes = session.mistakes();
    if (!mistakes.empty()) return Error{Code::BadInput, joined(mistakes)};
    for (const Note& note : session.take_notes()) {
        if (note.kind == NoteKind::Trouble) return Error{Code::Refused, path + ": " + note.text};
        if (note.kind == NoteKind::Fault) return Error{Code::Refused, note.text};
    }
    if (settled) return Status::done();
    return Error{Code::Timeout, path +
                                    ": a robot does not take its script, although the run has "
                                    "not begun; let its script begin without waiting"};
}

// ---- which robot ----

std::vector<std::string> node_names(const SimSession& session, sim::RobotId robot) {
    std::vector<std::string> names;
    for (const NodeState& node : session.nodes()) {
        if (node.robot == robot) names.push_back(node.name);
    }
    return names;
}

// The first list of which the robot has no node; nullptr if it has one of each.
const toolbox::NodeNames* lacks(const std::vector<std::string>& has,
                                const std::vector<toolbox::NodeNames>& needs) {
    for (const toolbox::NodeNames& names : needs) {
        if (std::find_first_of(has.begin(), has.end(), names.begin(), names.end()) == has.end()) {
            return &names;
        }
    }
    return nullptr;
}

Result<sim::RobotId> find_robot(const SimSession& session, const PlanWorldOptions& options) {
    const auto found = session.world().find_robot(options.robot);
    if (!found) {
        std::vector<std::string> names;
        for (const sim::RobotView& robot : session.world().robots()) {
            names.emplace_back(robot.name);
        }
        const std::string near = nearest(options.robot, names);
        return Error{Code::NotFound,
                     "--robot " + options.robot + ": " + options.path +
                         " has no robot of that name; " +
                         (near.empty() ? "it has " + list_of({names.begin(), names.end()})
                                       : "did you mean " + near + "?")};
    }
    const std::vector<std::string> has = node_names(session, *found);
    const toolbox::NodeNames* missing = lacks(has, options.needs);
    if (!missing) return *found;
    return Error{Code::NotFound, "--robot " + options.robot + ": the plan needs a node \"" +
                                     missing->front() + "\", and that robot has only " +
                                     list_of({has.begin(), has.end()}) +
                                     "; choose a robot that has it"};
}

// The robot that the plan drives. Nothing if the plan asks for no node, or no robot has them all:
// then the code that misses one says so.
Result<std::optional<sim::RobotId>> choose_robot(const SimSession& session,
                                                 const PlanWorldOptions& options) {
    if (!options.robot.empty()) return std::optional(TRY(find_robot(session, options)));
    std::optional<sim::RobotId> only;
    std::vector<std::string> names;
    for (const sim::RobotView& robot : session.world().robots()) {
        if (options.needs.empty() || lacks(node_names(session, robot.id), options.needs)) continue;
        only = robot.id;
        names.emplace_back(robot.name);
    }
    if (names.size() < 2) return only;
    return Error{Code::Refused, "a plan is for one robot, and this one could drive " +
                                    std::to_string(names.size()) + " robots of " + options.path +
                                    ": " + list_of({names.begin(), names.end()}) +
                                    "; choose one, as --robot " + names.front()};
}

std::set<debug::NodeId> nodes_of(const SimSession& session, std::optional<sim::RobotId> robot) {
    std::set<debug::NodeId> ids;
    for (const NodeState& node : session.nodes()) {
        if (robot && node.robot == *robot) ids.insert(node.id);
    }
    return ids;
}

}  // namespace

Result<std::unique_ptr<PlanWorld>> PlanWorld::open(const PlanWorldOptions& options,
                                                   toolbox::BusNodes& nodes) {
    SimOptions how;
    how.world.seed = options.seed;
    how.world.starts = options.starts;
    how.world.threads = options.threads;
    how.world.chaos = options.chaos;
    how.traced = options.traced;
    how.heard = true;
    how.guests = options.guests;
    SimSession session = TRY(open_sim(options.path, how));
    TRY(settle(session, options.path));
    const std::optional<sim::RobotId> robot = TRY(choose_robot(session, options));
    if (robot) session.emit_to(*robot);
    BusNames names(session.common(), "the scripts of " + options.path);
    // make_unique cannot reach the constructor.
    return std::unique_ptr<PlanWorld>(
        new PlanWorld(std::move(session), std::move(names), nodes, robot));
}

PlanWorld::PlanWorld(SimSession session, BusNames names, toolbox::BusNodes& nodes,
                     std::optional<sim::RobotId> robot)
    : session_(std::move(session)),
      robot_(robot),
      camera_(session_.world(), robot),
      names_(std::move(names)),
      ears_(nodes, nodes_of(session_, robot)) {
    (void)hear();  // who is there; what scripts said before time 0 is not for the plan
}

void PlanWorld::join(run::RunOptions& options) {
    options.surroundings = this;
    options.may_emit = [this](const run::BusEvent& event) { return names_.may_emit(event); };
}

void PlanWorld::close_but_for(std::set<std::string> events) {
    const std::lock_guard lock(mutex_);
    only_ = std::move(events);
}

void PlanWorld::emit(Time at, const run::BusEvent& event) {
    {
        const std::lock_guard lock(mutex_);
        if (only_ && !only_->contains(event.name)) return;
    }
    if (told_of_emit_) told_of_emit_(at, event);
    // Refused is only what a supervisor emits as it stops: may_emit() was not asked.
    (void)session_.emit(event.name, event.arguments, at, event.cause).ok();
}

std::vector<run::BusEvent> PlanWorld::begin() {
    if (before_each_) before_each_(next());
    session_.begin_instant();
    return hear();
}

std::vector<run::BusEvent> PlanWorld::arrived() {
    session_.hear_ahead();
    return hear();
}

std::vector<run::BusEvent> PlanWorld::hear() {
    std::vector<run::BusEvent> heard = std::exchange(brought_, {});
    for (const debug::Event& event : session_.take_heard()) {
        if (auto one = ears_.hear(event)) heard.push_back(std::move(*one));
    }
    return heard;
}

}  // namespace vagus::session
