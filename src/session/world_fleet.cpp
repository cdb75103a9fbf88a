#include "session/world_fleet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <variant>

#include "fleet/limits.hpp"
#include "fleet/topic.hpp"

namespace vagus::session {

namespace {

fleet::WayModel model_of(const sim::FleetDefinition& fleet) {
    return {
        .latency = fleet.latency, .jitter = fleet.jitter, .loss = fleet.loss, .twice = fleet.twice};
}

}  // namespace

WorldFleet::WorldFleet(const sim::WorldDefinition& world, uint64_t seed, std::optional<Door> door)
    : world_(world),
      broker_(model_of(world.fleet), seed),
      door_(std::move(door)),
      by_id_(world.robots.size(), nullptr) {}

WorldFleet::~WorldFleet() {
    leave();
}

void WorldFleet::leave() {
    if (!door_ || std::exchange(left_, true)) return;
    for (const auto& robot : robots_) {
        robot->member.leave();
        perform(*robot);
        // Closed in good order, so that no will is published.
        robot->way.real.reset();
        robot->asks_way.real.reset();
    }
}

// In virtual time each run is the same: no name or number is random as those of real robots.
fleet::MemberOptions WorldFleet::member_of(const RobotBus& robot) const {
    fleet::MemberOptions member{.fleet = robot.project.fleet.name,
                                .robot = robot.name,
                                .instance = "simulated-" + std::to_string(robot.id.number),
                                .epoch = robot.id.number,
                                .project = robot.project.fleet,
                                .description = {}};
    if (!door_) return member;
    if (!door_->fleet.empty()) member.fleet = door_->fleet;
    std::tie(member.instance, member.epoch) = door_->instance_and_epoch();
    member.description =
        fleet::description_of(robot.project.fleet, robot.project.name, robot.project.plan);
    return member;
}

Status WorldFleet::join(const RobotBus& robot, Ears ears, bool asks) {
    const fleet::MemberOptions options = member_of(robot);
    if (options.fleet.empty()) return Status::done();
    if (!fleet::is_robot_name(robot.name)) {
        return Error{
            Code::BadInput,
            fmt::format("\"{}\" cannot be the name of a robot in a fleet: expected 1 to {} "
                        "bytes, neither \"all\" nor \"group\"; give it another name",
                        robot.name, fleet::kNameBytesMax)};
    }
    auto one = std::make_unique<Robot>(Robot{.member = fleet::Member(options, Time{}),
                                             .name = robot.name,
                                             .ears = std::move(ears),
                                             .tell = robot.project.fleet.tell});
    one->way = TRY(connected(options, one->member.will()));
    if (asks) TRY(let_ask(*one, options));
    by_id_[robot.id.number - 1] = one.get();
    robots_.push_back(std::move(one));
    return Status::done();
}

void WorldFleet::emitted(sim::RobotId robot, const Emission& event, Time now) {
    Robot* const one = by_id_[robot.number - 1];
    if (one == nullptr) return;
    const int64_t number = one->member.emitted(event.name, event.arguments, now);
    if (number != 0 && event.frame != 0) one->sent.add(number, event.frame);
}

// At a real broker a robot of that name may be any.
uint32_t WorldFleet::frame_of(const fleet::EmitOnBus& event) const {
    if (door_) return 0;
    const auto by = std::ranges::find(
        robots_, event.from, [](const auto& one) -> const auto& { return one->name; });
    return by == robots_.end() ? 0 : (*by)->sent.frame_of(event.number);
}

toolbox::Fleet* WorldFleet::asked_by(sim::RobotId robot) {
    Robot* const one = by_id_[robot.number - 1];
    return one != nullptr ? one->asks.get() : nullptr;
}

void WorldFleet::pass(Time now) {
    if (left_) return;
    broker_.pass(now);
    run_timeline(now);
    for (Keeper& keeper : keepers_) turn(keeper, now);
    for (const auto& robot : robots_) turn(*robot, now);
}

Result<WorldFleet::Way> WorldFleet::connected(const fleet::MemberOptions& options,
                                              fleet::Post will) {
    Way way;
    if (door_) {
        way.real = TRY(door_->connect(options, std::move(will)));
    } else {
        way.modelled = &broker_.add(options.fleet, std::move(will));
        broker_.connect(*way.modelled);
    }
    return way;
}

// At a real broker as another client, whose keeper is a process of its own.
Status WorldFleet::let_ask(Robot& robot, fleet::MemberOptions options) {
    robot.asks = std::make_unique<MemberFleet>(fleet::KeeperClient::Options{
        .fleet = options.fleet, .robot = options.robot, .epoch = options.epoch});
    if (watched_) robot.asks->tell_more(robot.ears.asked);
    if (door_) options.instance += "-plan";
    robot.asks_way = TRY(connected(options, {}));
    if (!door_) add_keeper(options.fleet);
    return Status::done();
}

// ---- the keepers ----

void WorldFleet::add_keeper(const std::string& fleet) {
    const bool known = std::any_of(keepers_.begin(), keepers_.end(),
                                   [&fleet](const Keeper& one) { return one.fleet == fleet; });
    if (!known) start(keepers_.emplace_back(Keeper{.fleet = fleet}));
}

void WorldFleet::start(Keeper& keeper) {
    ++keepers_started_;
    keeper.keeping = std::make_unique<fleet::Keeping>(fleet::KeepingOptions{
        .fleet = keeper.fleet,
        .keeper = {.instance = "simulated-" + std::to_string(keepers_started_)}});
    keeper.way = &broker_.add(keeper.fleet, {});
    broker_.connect(*keeper.way);
}

// A process that is killed says nothing more; another one knows what the broker has kept.
void WorldFleet::act(const sim::RunKeeper& action) {
    for (Keeper& keeper : keepers_) {
        if (action.on && !keeper.keeping) start(keeper);
        if (action.on || !keeper.keeping) continue;
        broker_.cut(*keeper.way);
        keeper.keeping.reset();
    }
}

void WorldFleet::turn(Keeper& keeper, Time now) {
    if (!keeper.keeping) return;
    if (keeper.way->has_news()) {
        for (const fleet::LinkEvent& event : keeper.way->take()) keeper.keeping->hear(event, now);
    }
    if (now >= keeper.tick_at) {
        keeper.keeping->tick(now);
        keeper.tick_at = now + fleet::kKeeperTickEvery;
    }
    for (const fleet::KeepingAction& action : keeper.keeping->take()) {
        if (const auto* filters = std::get_if<fleet::Subscribe>(&action)) {
            keeper.way->subscribe(filters->filters);
        } else if (const auto* post = std::get_if<fleet::Post>(&action)) {
            if (watched_) tell_reply(keeper, *post);
            keeper.way->publish(*post);
        }
    }
}

// To the robot that it is for, at once: for that one itself it is on its way.
void WorldFleet::tell_reply(const Keeper& keeper, const fleet::Post& post) const {
    const auto heard = fleet::read(keeper.fleet, post.topic, post.payload);
    const auto* const reply =
        heard.ok() ? std::get_if<fleet::Reply>(&heard.value().message) : nullptr;
    if (reply == nullptr) return;
    for (const auto& robot : robots_) {
        if (robot->name != heard.value().topic.robot || !robot->ears.replied) continue;
        robot->ears.replied(reply->number, reply->reply);
    }
}

// ---- the robots ----

// What its plan asks. At a real broker only while the name is the member's: of two robots of one
// name the one that stays out takes no tasks. What is not sent now is asked again.
void WorldFleet::ask(Robot& robot, Time at) {
    const Time now = door_ ? door_->now() : at;
    MemberFleet& asks = *robot.asks;
    fleet::Link& way = robot.asks_way.link();
    if (robot.asks_way.may_have_news()) {
        for (const fleet::LinkEvent& event : way.take()) {
            if (std::holds_alternative<fleet::Connected>(event)) way.subscribe(asks.filters());
            asks.hear(event, now);
        }
    }
    asks.tick(now);
    const bool has_name = !door_ || robot.member.standing() == fleet::Member::Standing::Holding;
    for (const fleet::Post& post : asks.take()) {
        if (has_name) way.publish(post);
    }
    for (MemberFleet::Told& told : asks.take_told()) {
        robot.member.changed("plan", told.name, std::move(told.values));
    }
    const std::vector<FleetNews> what = asks.take_what_is_new();
    if (asks.take_news() && robot.ears.news) robot.ears.news(what);
}

void WorldFleet::run_timeline(Time now) {
    const auto& timeline = world_.timeline;
    while (timeline_next_ < timeline.size() && timeline[timeline_next_].at <= now) {
        const sim::Action& action = timeline[timeline_next_++].action;
        if (const auto* cut = std::get_if<sim::CutFleet>(&action)) act(*cut);
        if (const auto* keeper = std::get_if<sim::RunKeeper>(&action)) act(*keeper);
    }
}

// A real way is cut by who has the cable.
void WorldFleet::act(const sim::CutFleet& action) {
    if (door_) return;
    for (const auto& robot : robots_) {
        if (!action.robot.empty() && robot->name != action.robot) continue;
        for (fleet::ModelledBroker::Way* const way :
             {robot->way.modelled, robot->asks_way.modelled}) {
            if (way == nullptr) continue;
            action.cut ? broker_.cut(*way) : broker_.restore(*way);
        }
    }
}

void WorldFleet::turn(Robot& robot, Time now) {
    if (robot.way.may_have_news()) {
        for (const fleet::LinkEvent& event : robot.way.link().take()) robot.member.hear(event, now);
    }
    if (robot.asks) ask(robot, now);
    if (door_) show(robot, now);
    if (robot.member.next_tick() <= now) robot.member.tick(now);
    perform(robot);
}

// What everybody may see of it, and answers to those who wait until it is at rest.
void WorldFleet::show(Robot& robot, Time now) {
    if (!robot.stopping.empty() && robot.ears.is_at_rest()) {
        for (const fleet::Command& command : std::exchange(robot.stopping, {})) {
            robot.member.answer(command, {.done = true});
        }
    }
    if (now < robot.show_at) return;
    robot.show_at = now + kShowEvery;
    robot.member.show(robot.ears.shown(), now);
    for (const fleet::Tells& variable : robot.tell) {
        std::vector<int16_t> values = robot.ears.values(variable);
        if (values.empty()) continue;
        robot.member.changed(variable.node, variable.name, std::move(values));
    }
}

// In virtual time nobody gives commands.
void WorldFleet::obey(Robot& robot, const fleet::Command& command) {
    if (!robot.ears.obey) return;
    const auto answer = robot.ears.obey(command);
    if (answer) {
        robot.member.answer(command, *answer);
    } else {
        robot.stopping.push_back(command);
    }
}

void WorldFleet::perform(Robot& robot) {
    for (const fleet::MemberAction& action : robot.member.take()) {
        if (const auto* filters = std::get_if<fleet::Subscribe>(&action)) {
            robot.way.link().subscribe(filters->filters);
        } else if (const auto* post = std::get_if<fleet::Post>(&action)) {
            robot.way.link().publish(*post);
        } else if (const auto* event = std::get_if<fleet::EmitOnBus>(&action)) {
            robot.ears.hear(*event, frame_of(*event));
        } else if (const auto* stop = std::get_if<fleet::StopAlone>(&action)) {
            robot.ears.stop(stop->why);
        } else if (const auto* said = std::get_if<fleet::Say>(&action)) {
            robot.ears.say(said->text);
        } else if (const auto* command = std::get_if<fleet::Obey>(&action)) {
            obey(robot, command->command);
        } else {
            // Another version: what a world runs is what its file says.
        }
    }
}

}  // namespace vagus::session
