#include "embed/robot_plan.hpp"

#include "embed/bus_check.hpp"
#include "embed/prepared_run.hpp"
#include "session/toolboxes.hpp"
#include "toolbox/needs_bus.hpp"

namespace vagus::embed {

RobotPlan::RobotPlan(session::RobotBus& robot)
    : robot_(robot), camera_(robot.session->world(), robot.id) {
    parts_.bus = &nodes_;
    if (camera_.exists()) parts_.camera = &camera_;
}

// A plan that was not run to its end is told to stop: its code is in the middle of something.
RobotPlan::~RobotPlan() {
    abort();
    const Time latest = begun_ + kPlansEndWithin;
    while (!over() && run_->now() < latest) step();
}

Result<std::unique_ptr<RobotPlan>> RobotPlan::load(session::RobotBus& robot) {
    // make_unique cannot reach the constructor.
    std::unique_ptr<RobotPlan> made(new RobotPlan(robot));
    const session::ProjectFile& project = robot.project;
    std::vector<std::string> toolboxes;
    for (const std::string& one : project.toolboxes) toolboxes.push_back(project.path_of(one));
    TRY(session::add_toolboxes(made->library_, made->parts_, toolboxes));
    made->plan_ = LoadedPlan::from_file(project.path_of(project.plan), made->library_);
    if (!made->plan_->ok()) {
        std::string report = made->plan_->report();
        if (report.ends_with('\n')) report.pop_back();
        return Error{Code::BadInput, "its plan has errors\n" + report};
    }
    for (const auto& [name, value] : project.start_set) {
        const auto& plan = made->plan_->graph().plans.front();
        made->options_.set.push_back(TRY(parse_set(plan, name + "=" + value)));
    }
    return made;
}

// Its trace is in times of the world.
Status RobotPlan::begin(uint64_t seed, const std::vector<debug::Event>& before, Told told,
                        Time at) {
    names_.emplace(robot_.session->common(), "the scripts of " + robot_.project.file);
    TRY(check_names(*names_, *plan_, "its"));
    if (!ears_) ears_.emplace(nodes_);  // in a second run it knows who is there
    for (const debug::Event& event : before) (void)ears_->hear(event);
    heard_.clear();  // what scripts said before time 0 is not for the plan
    only_.reset();
    ended_.reset();
    begun_ = {};
    began_at_ = at;
    paused_at_.reset();
    options_.seed = seed;
    options_.on_trace = [this, line = std::move(told.line)](const plan::TraceEvent& event) {
        if (began_at_ == Time{}) return line(event);
        plan::TraceEvent later = event;
        later.at += began_at_;
        line(later);
    };
    options_.passes_over = std::move(told.passes_over);
    told_of_sent_ = std::move(told.sent);
    options_.may_emit = [this](const run::BusEvent& event) { return names_->may_emit(event); };
    options_.surroundings = this;
    run_.emplace(plan_->graph(), library_, options_);
    run_->start();
    return Status::done();
}

bool RobotPlan::needs_fleet() const {
    return !toolbox::check_without_fleet(plan_->graph()).ok();
}

Status RobotPlan::join(toolbox::Fleet* fleet) {
    parts_.fleet = fleet;
    return fleet != nullptr ? Status::done() : toolbox::check_without_fleet(plan_->graph());
}

void RobotPlan::hear(const debug::Event& event) {
    if (!ears_) return;
    auto one = ears_->hear(event);  // also of a plan that is over: it may begin again
    if (one) hear(std::move(*one));
}

void RobotPlan::hear(run::BusEvent event) {
    const bool full = paused_at_ && heard_.size() >= run::kHeldEventsMax;
    if (!over() && !full) heard_.push_back(std::move(event));
}

void RobotPlan::step() {
    run_->step();
    if (run_->over()) ended_ = run_->finish();
}

void RobotPlan::pause(Time at) {
    if (!paused_at_ && !over()) paused_at_ = at;
}

void RobotPlan::go_on(Time at) {
    if (paused_at_) began_at_ += at - *paused_at_;
    paused_at_.reset();
}

Status RobotPlan::raise(const std::string& supervisor, const std::string& event) {
    if (over()) return Error{Code::Unavailable, "no plan runs"};
    return run_->do_as_asked(run::RaiseEvent{supervisor, event});
}

Result<int> RobotPlan::slot_of(const std::string& name) const {
    if (over()) return Error{Code::Unavailable, "no plan runs, which has its variables"};
    const int slot = plan::find_variable(plan_->graph().plans.front(), name);
    if (slot >= 0) return slot;
    return Error{Code::NotFound, "the plan that runs has no variable " + name};
}

Result<plan::Value> RobotPlan::variable(const std::string& name) const {
    const int slot = TRY(slot_of(name));
    const plan::Value* const value = run_->variable(slot);
    if (value != nullptr) return *value;
    return Error{Code::Unavailable, "its plan has not begun yet"};
}

Status RobotPlan::set(const std::string& name, const plan::Value& value) {
    const int slot = TRY(slot_of(name));
    const auto& variables = plan_->graph().plans.front().variables;
    const plan::Value fits = TRY(plan::convert(value, variables[static_cast<size_t>(slot)].type));
    if (paused_at_) return run_->do_as_asked(run::SetVariable{0, name, fits});
    run_->set(slot, fits);
    return Status::done();
}

// As it ends the robot is not told to move again.
void RobotPlan::abort() {
    if (over()) return;
    go_on(robot_.session->now());
    only_ = session::stop_events(library_.templates());
    run_->abort();
}

std::vector<run::BusEvent> RobotPlan::begin() {
    begun_ += sim::kNodeStep;
    return std::exchange(heard_, {});
}

void RobotPlan::emit(Time at, const run::BusEvent& event) {
    if (only_ && !only_->contains(event.name)) return;
    // Refused is only what a supervisor emits as it stops: may_emit() was not asked.
    const Status sent =
        robot_.session->emit(event.name, event.arguments, began_at_ + at, event.cause);
    if (sent.ok() && told_of_sent_) told_of_sent_(event);
}

}  // namespace vagus::embed
