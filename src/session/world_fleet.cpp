#include "session/world_fleet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "fleet/limits.hpp"
#include "fleet/topic.hpp"

namespace vagus::session {

namespace {

fleet::WayModel model_of(const sim::FleetDefinition& fleet) {
    return {
        .latency = fleet.latency, .jitter = fleet.jitter, .loss = fleet.loss, .twice = fleet.twice};
}

// Of a run that is the same each time: names and numbers that real robots draw at random.
fleet::MemberOptions member_of(const RobotBus& robot) {
    return {.fleet = robot.project.fleet.name,
            .robot = robot.name,
            .instance = "simulated-" + std::to_string(robot.id.number),
            .epoch = robot.id.number,
            .project = robot.project.fleet,
            .description = {}};
}

}  // namespace

WorldFleet::WorldFleet(const sim::WorldDefinition& world, uint64_t seed)
    : world_(world), broker_(model_of(world.fleet), seed), by_id_(world.robots.size(), nullptr) {}

Status WorldFleet::join(const RobotBus& robot, Ears ears) {
    if (robot.project.fleet.name.empty()) return Status::done();
    if (!fleet::is_robot_name(robot.name)) {
        return Error{
            Code::BadInput,
            fmt::format("\"{}\" cannot be the name of a robot in a fleet: expected 1 to {} "
                        "bytes, neither \"all\" nor \"group\"; give it another name",
                        robot.name, fleet::kNameBytesMax)};
    }
    fleet::Member member(member_of(robot), Time{});
    fleet::Post will = member.will();
    auto& way = broker_.add(robot.project.fleet.name, std::move(will));
    robots_.push_back(
        std::make_unique<Robot>(Robot{std::move(member), &way, robot.name, std::move(ears)}));
    by_id_[robot.id.number - 1] = robots_.back().get();
    broker_.connect(way);
    return Status::done();
}

void WorldFleet::emitted(sim::RobotId robot, const std::string& event,
                         const std::vector<int16_t>& args, Time now) {
    if (Robot* const one = by_id_[robot.number - 1]) one->member.emitted(event, args, now);
}

void WorldFleet::pass(Time now) {
    broker_.pass(now);
    run_timeline(now);
    for (const auto& robot : robots_) turn(*robot, now);
}

void WorldFleet::run_timeline(Time now) {
    const auto& timeline = world_.timeline;
    while (timeline_next_ < timeline.size() && timeline[timeline_next_].at <= now) {
        const auto* cut = std::get_if<sim::CutFleet>(&timeline[timeline_next_++].action);
        if (cut != nullptr) act(*cut);
    }
}

void WorldFleet::act(const sim::CutFleet& action) {
    for (const auto& robot : robots_) {
        if (!action.robot.empty() && robot->name != action.robot) continue;
        action.cut ? broker_.cut(*robot->way) : broker_.restore(*robot->way);
    }
}

void WorldFleet::turn(Robot& robot, Time now) {
    if (robot.way->has_news()) {
        for (const fleet::LinkEvent& event : robot.way->take()) robot.member.hear(event, now);
    }
    if (robot.member.next_tick() <= now) robot.member.tick(now);
    for (const fleet::MemberAction& action : robot.member.take()) {
        if (const auto* filters = std::get_if<fleet::Subscribe>(&action)) {
            robot.way->subscribe(filters->filters);
        } else if (const auto* post = std::get_if<fleet::Post>(&action)) {
            robot.way->publish(*post);
        } else if (const auto* event = std::get_if<fleet::EmitOnBus>(&action)) {
            robot.ears.hear(*event);
        } else if (const auto* stop = std::get_if<fleet::StopAlone>(&action)) {
            robot.ears.stop(stop->why);
        } else if (const auto* said = std::get_if<fleet::Say>(&action)) {
            robot.ears.say(said->text);
        } else {
            // A command: nobody gives any in virtual time.
        }
    }
}

}  // namespace vagus::session
