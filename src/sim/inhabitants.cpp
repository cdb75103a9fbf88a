#include "sim/inhabitants.hpp"

#include <algorithm>
#include <cassert>

#include "base/rng.hpp"
#include "sim/carbot/carbot.hpp"
#include "sim/epuck/epuck.hpp"
#include "sim/thymio2/thymio2.hpp"
#include "sim/world_check.hpp"

namespace vagus::sim {
namespace {

bool has_body(ObjectKind kind) {
    return kind == ObjectKind::Wall || kind == ObjectKind::Box || kind == ObjectKind::Cylinder;
}

bool is_lamp(ObjectKind kind) {
    return kind == ObjectKind::Light || kind == ObjectKind::Infrared;
}

// Robots with neighbouring ids must not have neighbouring noise.
uint64_t noise_seed(uint64_t seed, uint16_t node) {
    return SplitMix64(SplitMix64(seed).next() ^ node).next();
}

Error gone() {
    return {Code::NotFound, "the object does not exist any more; look it up again by its id"};
}

}  // namespace

Inhabitants::Inhabitants(const WorldDefinition& definition, const Picture& picture,
                         const WorldOptions& options, uint32_t next_object)
    : definition_(definition),
      seed_(options.seed.value_or(definition.seed)),
      arena_({definition.width, definition.height, definition.open}),
      ground_(definition.width, definition.height, definition.ground),
      next_object_(next_object) {
    ground_.set_picture(picture);
    for (const ObjectDefinition& object : definition.objects) {
        const Result<ObjectId> added = add(object);
        assert(added.ok());  // the definition has been checked
        (void)added;
    }
    for (const RobotDefinition& robot : definition.robots) add_robot(robot, options);
}

void Inhabitants::add_robot(const RobotDefinition& robot, const WorldOptions& options) {
    const uint64_t seed = noise_seed(seed_, robot.node);
    switch (robot.type) {
        case RobotType::Thymio2:
            robots_.push_back(
                std::make_unique<thymio2::Thymio2>(arena_, robot, options.sd_folder, seed));
            break;
        case RobotType::Epuck:
            robots_.push_back(std::make_unique<epuck::Epuck>(arena_, robot, pool_, seed));
            break;
        case RobotType::Carbot:
            robots_.push_back(std::make_unique<carbot::Carbot>(arena_, robot, seed));
            break;
    }
    const BodyId body = robots_.back()->body();
    note_body(body, robot.paint);
    if (body.index >= robot_of_body_.size()) robot_of_body_.resize(body.index + 1);
    robot_of_body_[body.index] = robots_.size() - 1;
}

void Inhabitants::reseed(uint64_t seed) {
    for (size_t i = 0; i < robots_.size(); ++i) {
        const uint64_t its = noise_seed(seed, definition_.robots[i].node);
        robots_[i]->reseed(its);
        for (Machine* const machine : robots_[i]->machines()) {
            machine->reseed(static_cast<uint16_t>(noise_seed(its, machine->id())));
        }
    }
}

void Inhabitants::note_body(BodyId body, const Colour& colour) {
    if (body.index >= colours_.size()) colours_.resize(body.index + 1);
    colours_[body.index] = colour;
}

Result<ObjectId> Inhabitants::add(const ObjectDefinition& object) {
    if (const auto problem = find_problem(object, "the object"))
        return Error{Code::BadInput, problem->element + ": " + problem->what};
    if (objects_.size() >= kObjectsMax) {
        return Error{Code::Limit, "a world has at most " + std::to_string(kObjectsMax) +
                                      " objects; remove one first"};
    }
    if (!object.id.empty() && find(object.id)) {
        return Error{Code::Refused, "there is an object \"" + object.id +
                                        "\" already; choose another id, or remove that one"};
    }
    Object added{ObjectId{next_object_++}, object, std::nullopt, {object.at, object.angle}, true};
    if (has_body(object.kind)) {
        added.body = arena_.add_object(object);
        note_body(*added.body, object.colour);
    }
    objects_.push_back(std::move(added));
    if (!has_body(object.kind)) refresh_ground();
    return objects_.back().id;
}

Status Inhabitants::remove(ObjectId id) {
    const Object* const object = find(id);
    if (object == nullptr) return gone();
    if (object->body) arena_.remove(*object->body);
    objects_.erase(objects_.begin() + (object - objects_.data()));
    refresh_ground();
    return Status::done();
}

Status Inhabitants::move(ObjectId id, const Pose& to) {
    Object* const object = find(id);
    if (object == nullptr) return gone();
    ObjectDefinition there = object->definition;
    there.at = to.at;
    there.angle = to.angle;
    if (const auto problem = find_problem(there, "the object"))
        return Error{Code::BadInput, problem->element + ": " + problem->what};
    object->pose = to;
    if (object->body)
        arena_.place(*object->body, to);
    else
        refresh_ground();
    return Status::done();
}

Status Inhabitants::switch_light(ObjectId id, bool on) {
    Object* const object = find(id);
    if (object == nullptr) return gone();
    if (!is_lamp(object->definition.kind)) {
        return Error{Code::Refused, "a " + std::string(sim::name_of(object->definition.kind)) +
                                        " has no switch; only a light or an infrared has"};
    }
    object->on = on;
    refresh_ground();
    return Status::done();
}

void Inhabitants::move_robot(size_t robot, const Pose& to) {
    arena_.place(robots_[robot]->body(), to);
}

// Patches and lamps are few and change rarely: made again from the objects.
void Inhabitants::refresh_ground() {
    std::vector<ObjectDefinition> patches;
    std::vector<Point> lamps;
    beacons_.clear();
    for (const Object& object : objects_) {
        if (object.definition.kind == ObjectKind::Light && object.on)
            lamps.push_back(object.pose.at);
        if (object.definition.kind == ObjectKind::Infrared && object.on)
            beacons_.push_back(object.pose.at);
        if (object.definition.kind != ObjectKind::Patch) continue;
        patches.push_back(object.definition);
        patches.back().at = object.pose.at;
        patches.back().angle = object.pose.angle;
    }
    ground_.set_patches(std::move(patches));
    ground_.set_lamps(std::move(lamps));
}

Pose Inhabitants::pose_of(const Object& object) const {
    return object.body ? arena_.pose(*object.body) : object.pose;
}

Object* Inhabitants::find(ObjectId id) {
    const auto found =
        std::lower_bound(objects_.begin(), objects_.end(), id,
                         [](const Object& object, ObjectId wanted) { return object.id < wanted; });
    return found == objects_.end() || found->id != id ? nullptr : &*found;
}

std::optional<ObjectId> Inhabitants::find(std::string_view id) const {
    for (const Object& object : objects_)
        if (!id.empty() && object.definition.id == id) return object.id;
    return std::nullopt;
}

std::optional<size_t> Inhabitants::robot_of(BodyId body) const {
    return body.index < robot_of_body_.size() ? robot_of_body_[body.index] : std::nullopt;
}

std::string Inhabitants::name_of(BodyId body) const {
    if (body == kBorder) return "border";
    if (const auto robot = robot_of(body)) return definition_.robots[*robot].name;
    for (const Object& object : objects_)
        if (object.body == body) return object.definition.id;
    return "";
}

std::span<const Colour> Inhabitants::colours() {
    for (const auto& robot : robots_) colours_[robot->body().index] = robot->colour();
    return colours_;
}

}  // namespace vagus::sim
