// What is done to a World from outside, and who follows what happens in it.
#include <algorithm>

#include "sim/world_insides.hpp"

namespace vagus::sim {

Result<ObjectId> World::add(const ObjectDefinition& object) {
    if (find_robot(object.id)) {
        return Error{Code::Refused, "\"" + object.id + "\" is the name of a robot; choose another"};
    }
    const ObjectId added = TRY(insides_->inhabitants->add(object));
    if (insides_->told_of_act) insides_->told_of_act({.kind = Act::Kind::Put, .put = object});
    return added;
}

Status World::remove(ObjectId object) {
    return act({.kind = Act::Kind::Remove, .object = object});
}

Status World::move(ObjectId object, const Pose& to) {
    return act({.kind = Act::Kind::Move, .object = object, .to = to});
}

Status World::move(RobotId robot, const Pose& to) {
    return act({.kind = Act::Kind::MoveRobot, .robot = robot, .to = to});
}

Status World::switch_light(ObjectId light, bool on) {
    return act({.kind = Act::Kind::Light, .object = light, .on = on});
}

Status World::Insides::move_robot(RobotId robot, const Pose& to) {
    const auto index = index_of(definition, robot);
    if (!index) return no_robot();
    const auto is_far = [](double value) {
        return !(value >= -kWorldSizeMax && value <= 2 * kWorldSizeMax);
    };
    if (is_far(to.at.x) || is_far(to.at.y) || !(to.angle >= -kAngleMax && to.angle <= kAngleMax)) {
        return Error{Code::BadInput,
                     "the robot would be outside of every world; places are in "
                     "metres, angles in radians"};
    }
    inhabitants->move_robot(*index, to);
    return Status::done();
}

void World::Insides::knock(size_t index) {
    robot(index).knock();
    turns.call(index);
}

void World::Insides::push_button(size_t index, std::string_view button, bool pressed) {
    robot(index).catch_up(now);
    robot(index).set_button(button, pressed);
    turns.call(index);
}

Status World::Insides::set_button(RobotId id, std::string_view button, bool pressed) {
    const auto index = index_of(definition, id);
    if (!index) return no_robot();
    const auto names = buttons_of(definition.robots[*index].type);
    if (std::find(names.begin(), names.end(), button) == names.end()) {
        std::string all;
        for (const std::string_view name : names)
            all += (all.empty() ? "" : ", ") + std::string(name);
        return Error{Code::NotFound, definition.robots[*index].name + " has no button \"" +
                                         std::string(button) +
                                         "\"; it has: " + (all.empty() ? "none" : all)};
    }
    push_button(*index, button, pressed);
    return Status::done();
}

Status World::press(RobotId robot, std::string_view button) {
    return act({.kind = Act::Kind::Press, .robot = robot, .button = std::string(button)});
}

Status World::release(RobotId robot, std::string_view button) {
    return act({.kind = Act::Kind::Release, .robot = robot, .button = std::string(button)});
}

Status World::tap(RobotId robot) {
    return act({.kind = Act::Kind::Tap, .robot = robot});
}

Status World::Insides::tap(RobotId robot) {
    const auto index = index_of(definition, robot);
    if (!index) return no_robot();
    knock(*index);
    return Status::done();
}

Status World::Insides::do_act(const Act& act) {
    switch (act.kind) {
        case Act::Kind::Press:
            return set_button(act.robot, act.button, true);
        case Act::Kind::Release:
            return set_button(act.robot, act.button, false);
        case Act::Kind::Tap:
            return tap(act.robot);
        case Act::Kind::MoveRobot:
            return move_robot(act.robot, act.to);
        case Act::Kind::Move:
            return inhabitants->move(act.object, act.to);
        case Act::Kind::Remove:
            return inhabitants->remove(act.object);
        case Act::Kind::Light:
            return inhabitants->switch_light(act.object, act.on);
        case Act::Kind::Put:
            TRY(inhabitants->add(act.put));
            return Status::done();
    }
    return no_robot();
}

Status World::act(const Act& act) {
    TRY(insides_->do_act(act));
    if (insides_->told_of_act) insides_->told_of_act(act);
    return Status::done();
}

void World::on_act(std::function<void(const Act&)> told) {
    insides_->told_of_act = std::move(told);
}

void World::reseed(uint64_t seed) {
    insides_->reseeded = seed;
    insides_->inhabitants->reseed(seed);
    if (insides_->chaos) insides_->chaos->reseed(seed);
}

std::string World::state_of(RobotId robot, uint16_t node) const {
    const auto index = index_of(insides_->definition, robot);
    if (!index) return "";
    const Machine* const machine = insides_->turns.machine_of(*index, node, insides_->now);
    return machine != nullptr ? machine->state() : "";
}

// ---- Why it happens ----

FrameNumbers& World::number_frames() {
    return insides_->turns.number_frames();
}

FrameNumbers* World::frame_numbers() {
    return insides_->turns.frame_numbers();
}

void World::watch(Witness* witness) {
    if (witness != nullptr) insides_->crew.work_alone(true);
    insides_->turns.watch(witness);
}

void World::on_timeline(std::function<void(size_t)> told) {
    insides_->told_of_timeline = std::move(told);
}

}  // namespace vagus::sim
