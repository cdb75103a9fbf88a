#include "embed/robots_run.hpp"

#include <algorithm>
#include <utility>

#include "run/traced_variables.hpp"
#include "session/trace.hpp"
#include "toolbox/fleet/fleet.hpp"
#include "wire/protocol.hpp"

namespace vagus::embed {

using session::NoteKind;
using session::RobotBus;

RobotsRun::RobotsRun(std::unique_ptr<session::WorldBuses> buses) : buses_(std::move(buses)) {}

// Plans that still run ask the fleet a last time as their code is ended.
RobotsRun::~RobotsRun() {
    plans_.clear();
}

Result<std::unique_ptr<RobotsRun>> RobotsRun::open(const RobotsOptions& options) {
    auto buses = TRY(session::WorldBuses::open(options.world, options.sim));
    // make_unique cannot reach the constructor.
    std::unique_ptr<RobotsRun> made(new RobotsRun(std::move(buses)));
    made->traced_ = options.sim.traced;
    made->door_ = options.door;
    made->seed_ = options.sim.world.seed.value_or(made->buses_->world().definition().seed);
    for (RobotBus& robot : made->buses_->robots()) {
        const Status added = made->add_plan(robot);
        if (added.ok()) continue;
        return Error{added.error().code, options.world + ": robot " + robot.name + ": " +
                                             robot.project.file + ": " + added.error().what};
    }
    for (size_t i = 0; i < made->plans_.size(); ++i) made->add_commands(i);
    return made;
}

Status RobotsRun::add_plan(RobotBus& robot) {
    plans_.emplace_back();
    if (robot.project.plan.empty()) return Status::done();
    plans_.back() = TRY(RobotPlan::load(robot));
    return Status::done();
}

// ---- the start and the end ----

Status RobotsRun::start() {
    if (!has_projects()) return Status::done();
    (void)buses_->settle();
    for (const auto& one : commands_) one->begin_again();
    // Plans of the run before ask their fleet a last time as their code is ended.
    const auto last = std::exchange(
        fleet_, std::make_unique<session::WorldFleet>(buses_->world().definition(), seed_, door_));
    if (watcher_ != nullptr) fleet_->watch();
    for (size_t i = 0; i < plans_.size(); ++i) {
        const RobotBus& robot = buses_->robots()[i];
        const Status begun = begin(i);
        if (begun.ok()) continue;
        return Error{begun.error().code,
                     "robot " + robot.name + ": " + robot.project.file + ": " + begun.error().what};
    }
    return Status::done();
}

RobotPlan::Told RobotsRun::told_by_plan(size_t index) {
    RobotPlan::Told told{
        .line = [this, index](const plan::TraceEvent& event) { see(index, event); }};
    if (watcher_ == nullptr) return told;
    told.passes_over = [this, index](const run::Raising& raising) {
        return watcher_ != nullptr && watcher_->passes_over(index, raising);
    };
    told.sent = [this, index](const run::BusEvent& event) {
        if (watcher_ != nullptr) watcher_->sent(index, event);
    };
    return told;
}

bool RobotsRun::asks_fleet(size_t index) const {
    return plans_[index] && plans_[index]->needs_fleet();
}

Status RobotsRun::begin(size_t index) {
    RobotBus& robot = buses_->robots()[index];
    RobotPlan* const plan = plans_[index].get();
    const std::vector<debug::Event> before = robot.session->take_heard();
    if (plan != nullptr) {
        TRY(plan->begin(seed_ + robot.id.number, before, told_by_plan(index)));
    }
    TRY(fleet_->join(robot, ears_of(index), asks_fleet(index)));
    tell_version(index);
    if (plan != nullptr) TRY(plan->join(fleet_->asked_by(robot.id)));
    // What scripts say as they are loaded is for the fleet, too.
    for (const debug::Event& event : before) tell_fleet(robot, event, Time{});
    return Status::done();
}

// Of what comes over the fleet; it has one where frames have, so that what follows from it can say
// so.
uint32_t RobotsRun::number_of_message(uint32_t cause) {
    sim::FrameNumbers* const numbers = buses_->world().frame_numbers();
    return numbers != nullptr ? numbers->other(cause) : 0;
}

void RobotsRun::hear_of_fleet(size_t index, const fleet::EmitOnBus& event, uint32_t frame) {
    RobotBus& robot = buses_->robots()[index];
    const uint32_t number = number_of_message(frame);
    const Status sent = robot.session->emit(event.event, event.args, buses_->now(), number);
    if (!sent.ok()) {
        return say(robot, "the event " + event.event + " of " + event.from +
                              " could not be passed on: " + sent.error().what);
    }
    if (watcher_) {
        watcher_->of_fleet(index, FleetEvent{number, event.event, event.args, event.from});
    }
    RobotPlan* const plan = plans_[index].get();
    if (!plan) return;
    plan->hear(run::BusEvent{event.event, event.args, wire::kHostId, number});
    plan->hear(run::BusEvent{toolbox::fleet_event(event.event, event.from), event.args,
                             wire::kHostId, number});
}

void RobotsRun::hear_news(size_t index, const std::vector<session::FleetNews>& news) {
    const uint32_t number = number_of_message(0);
    if (watcher_) watcher_->of_fleet(index, FleetTold{number, news});
    plans_[index]->hear({std::string(toolbox::kFleetNews), {}, wire::kHostId, number});
}

void RobotsRun::add_ears_of_watcher(session::WorldFleet::Ears& ears, size_t index) {
    ears.asked = [this, index](uint64_t question, const keeper::Request& request) {
        if (watcher_) watcher_->of_fleet(index, KeeperAsked{question, request});
    };
    ears.replied = [this, index](uint64_t question, const keeper::Reply& reply) {
        if (watcher_) watcher_->of_fleet(index, KeeperDecided{question, reply});
    };
}

session::WorldFleet::Ears RobotsRun::ears_of(size_t index) {
    RobotBus& robot = buses_->robots()[index];
    const auto hear = [this, index](const fleet::EmitOnBus& event, uint32_t frame) {
        hear_of_fleet(index, event, frame);
    };
    const auto stop = [this, index, &robot](const std::string& why) {
        say(robot, why + "; the robot stops, as its project says");
        if (watcher_) watcher_->stopped(index, why);
        if (deployer_.stopped) deployer_.stopped(index);
        commands_[index]->stop([](const auto&) {});
    };
    session::WorldFleet::Ears ears{
        .hear = hear, .stop = stop, .say = [this, &robot](const std::string& text) {
            say(robot, text);
        }};
    ears.news = [this, index](const std::vector<session::FleetNews>& news) {
        if (plans_[index]) hear_news(index, news);
    };
    if (watcher_) add_ears_of_watcher(ears, index);
    if (door_) add_ears_of_broker(ears, index);
    return ears;
}

void RobotsRun::add_ears_of_broker(session::WorldFleet::Ears& ears, size_t index) {
    RobotCommands& commands = *commands_[index];
    ears.shown = [&commands] { return commands.shown(); };
    ears.values = [&commands](const fleet::Tells& variable) { return commands.values(variable); };
    ears.obey = [this, index, &commands](const fleet::Command& command,
                                         session::WorldFleet::Answered done) {
        say(index, "the fleet says " + command.verb);
        commands.obey(command, std::move(done));
    };
    ears.want = [this, index](const fleet::Want& want) {
        if (deployer_.want) deployer_.want(index, want);
    };
}

void RobotsRun::see(size_t index, const plan::TraceEvent& event) {
    RobotBus& robot = buses_->robots()[index];
    if (told_) told_(index, event);
    if (watcher_) watcher_->line(index, event);
    if (traced_) buses_->trace(plan::format_trace(event, robot.name) + "\n");
    commands_[index]->see(event);
    const auto* ended = std::get_if<plan::PlanEnded>(&event.what);
    if (ended == nullptr || run::level_of(event) > 0) return;
    std::string text = robot.name + ": the plan " + event.plan + " has ended (" +
                       std::string(plan::name_of(ended->result)) + ")";
    if (ended->result == plan::PlanResult::Error) text += ": " + ended->message;
    robot.session->tell(NoteKind::Plan, std::move(text));
}

void RobotsRun::say(RobotBus& robot, const std::string& text) {
    robot.session->tell(NoteKind::Fleet, robot.name + ": " + text);
    if (!traced_) return;
    buses_->trace(session::TraceLine(buses_->now(), "fleet")
                      .text("robot", robot.name)
                      .text("text", text)
                      .done());
}

void RobotsRun::reseed(uint64_t seed) {
    buses_->world().reseed(seed);
    if (fleet_) fleet_->reseed(seed);
    for (size_t i = 0; i < plans_.size(); ++i) {
        if (plans_[i]) plans_[i]->reseed(seed + buses_->robots()[i].id.number);
    }
}

const LoadedPlan* RobotsRun::plan(size_t robot) const {
    return plans_[robot] ? &plans_[robot]->loaded() : nullptr;
}

bool RobotsRun::has_failed() const {
    return std::any_of(plans_.begin(), plans_.end(), [](const auto& plan) {
        return plan && plan->ended() && plan->ended()->result == plan::PlanResult::Error;
    });
}

void RobotsRun::end() {
    const auto running = [](const auto& plan) { return plan && !plan->over(); };
    for (const auto& plan : plans_) {
        if (plan) plan->abort();
    }
    const Time latest = buses_->now() + kPlansEndWithin;
    while (std::any_of(plans_.begin(), plans_.end(), running) && buses_->now() < latest) {
        instant();
    }
    if (fleet_) fleet_->leave();
}

Status RobotsRun::restart() {
    end();
    rest_ = {};
    buses_->reset();
    return start();
}

// ---- time ----

void RobotsRun::step(Duration span) {
    if (!has_projects()) return buses_->common().step(span);
    rest_ += span;
    for (; rest_ >= sim::kNodeStep; rest_ -= sim::kNodeStep) instant();
}

void RobotsRun::instant() {
    const Time at = buses_->now() + sim::kNodeStep;
    run_plans_before(at);
    buses_->begin_instant();
    for (size_t i = 0; i < plans_.size(); ++i) hear(i, at);
    if (fleet_) fleet_->pass(at);
    for (const auto& plan : plans_) {
        while (plan && plan->is_due(at)) plan->step();
    }
    buses_->end_instant();
}

// Most plans have nothing to do before the next instant and are already there.
void RobotsRun::run_plans_before(Time at) {
    std::vector<RobotPlan*> early;
    for (const auto& plan : plans_) {
        if (plan && plan->is_due(at) && plan->now() < at) early.push_back(plan.get());
    }
    while (!early.empty()) {
        const auto first =
            std::min_element(early.begin(), early.end(),
                             [](RobotPlan* a, RobotPlan* b) { return a->now() < b->now(); });
        (*first)->step();
        if ((*first)->over() || (*first)->now() >= at) early.erase(first);
    }
}

// Events of nodes go to the fleet. Events of hosts do not: they may come from the fleet.
void RobotsRun::hear(size_t index, Time at) {
    RobotBus& robot = buses_->robots()[index];
    for (const debug::Event& event : robot.session->take_heard()) {
        if (plans_[index]) plans_[index]->hear(event);
        commands_[index]->hear(event);
        tell_fleet(robot, event, at);
    }
    commands_[index]->tick();
}

void RobotsRun::tell_fleet(const RobotBus& robot, const debug::Event& event, Time at) {
    const auto* sent = std::get_if<debug::UserEvent>(&event.what);
    const bool is_named = sent != nullptr && !sent->name.empty();
    if (!fleet_ || !is_named || event.node == wire::kHostId) return;
    fleet_->emitted(robot.id, {sent->name, sent->arguments, event.frame}, at);
}

}  // namespace vagus::embed
