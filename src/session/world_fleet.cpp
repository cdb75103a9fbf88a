#include "session/world_fleet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <variant>

#include "base/text.hpp"
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
    for (const auto& robot : robots_) leave(*robot);
}

// Closed in good order, so that no will is published.
void WorldFleet::leave(Robot& robot) {
    robot.member.leave();
    perform(robot);
    robot.way.real.reset();
    robot.asks_way.real.reset();
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

Result<std::unique_ptr<WorldFleet::Robot>> WorldFleet::made(const RobotBus& robot,
                                                            const fleet::MemberOptions& options,
                                                            const Ears& ears, bool asks) {
    auto one = std::make_unique<Robot>(Robot{.id = robot.id,
                                             .member = fleet::Member(options, now_),
                                             .name = robot.name,
                                             .fleet = options.fleet,
                                             .ears = ears,
                                             .tell = fleet::TellList(robot.project.fleet.tell)});
    one->way = TRY(connected(options, one->member.will()));
    if (asks) TRY(let_ask(*one, options));
    return one;
}

Status WorldFleet::join(const RobotBus& robot, const Ears& ears, bool asks) {
    const fleet::MemberOptions options = member_of(robot);
    if (options.fleet.empty()) return Status::done();
    if (!fleet::is_robot_name(robot.name)) {
        return Error{
            Code::BadInput,
            fmt::format("\"{}\" cannot be the name of a robot in a fleet: expected 1 to {} "
                        "bytes, neither \"all\" nor \"group\"; give it another name",
                        robot.name, fleet::kNameBytesMax)};
    }
    auto one = TRY(made(robot, options, ears, asks));
    by_id_[robot.id.number - 1] = one.get();
    robots_.push_back(std::move(one));
    return Status::done();
}

Status WorldFleet::join_again(const RobotBus& robot, bool asks) {
    Robot* const before = by_id_[robot.id.number - 1];
    if (before == nullptr || !door_) return Status::done();
    fleet::MemberOptions options = member_of(robot);
    options.fleet = before->fleet;
    auto next = TRY(made(robot, options, before->ears, asks));
    leave(*before);
    by_id_[robot.id.number - 1] = next.get();
    *std::ranges::find(robots_, before, &std::unique_ptr<Robot>::get) = std::move(next);
    return Status::done();
}

// The state of the version before is not told behind it.
void WorldFleet::deployed(sim::RobotId robot, const fleet::Version& version) {
    Robot* const one = by_id_[robot.number - 1];
    if (one == nullptr) return;
    if (one->ears.shown) one->member.show(one->ears.shown(), now_);
    one->member.deployed(version);
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
    now_ = now;
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

// What everybody may see of it.
void WorldFleet::show(Robot& robot, Time now) {
    (void)robot.tell.forget_old(now);
    if (now < robot.show_at) return;
    robot.show_at = now + kShowEvery;
    robot.member.show(robot.ears.shown(), now);
    for (const fleet::Tells& variable : robot.tell.all()) {
        auto values = robot.ears.values(variable);
        if (values.ok()) {
            robot.member.changed(variable.node, variable.name, std::move(values.value()));
        }
    }
}

fleet::Answer WorldFleet::tell_for_a_minute(Robot& robot, const fleet::Tells& variable) {
    const auto there = robot.ears.values(variable);
    if (!there.ok()) {
        return {.what = std::string(utf8_prefix(there.error().what, fleet::kLineBytesMax))};
    }
    robot.member.tell_again(variable.node, variable.name);
    if (robot.tell.add(variable, now_)) return {.done = true};
    return {.what = fmt::format("{} variables are told already because somebody asked for them; "
                                "wait a minute",
                                fleet::kTellMax)};
}

// In virtual time nobody gives commands. By the time of the answer it may be another instance, of
// the same name.
void WorldFleet::obey(Robot& robot, const fleet::Command& command) {
    if (!robot.ears.obey) return;
    if (command.verb == "tell") {
        const fleet::Tells variable{command.node, command.name};
        return robot.member.answer(command, tell_for_a_minute(robot, variable));
    }
    robot.ears.obey(command, [this, id = robot.id, command](fleet::Answer answer) {
        by_id_[id.number - 1]->member.answer(command, std::move(answer));
    });
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
        } else if (const auto* fetch = std::get_if<fleet::Fetch>(&action)) {
            if (robot.ears.want) robot.ears.want(fetch->want);
        }
    }
}

}  // namespace vagus::session
