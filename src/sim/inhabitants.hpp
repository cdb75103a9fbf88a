// The objects and robots of a world with their bodies, and what ground and cameras get of them. The
// part of World that knows no time and no bus.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "sim/arena.hpp"
#include "sim/definitions.hpp"
#include "sim/ground.hpp"
#include "sim/robot.hpp"
#include "sim/world.hpp"

namespace vagus::sim {

struct Object {
    ObjectId id;
    ObjectDefinition definition;
    std::optional<BodyId> body;  // walls, boxes, cylinders
    Pose pose;                   // as it was put; loose bodies have theirs in the arena
    bool on = true;
};

class Inhabitants {
public:
    // `definition` must outlive this; `next_object` is the number of the first object.
    Inhabitants(const WorldDefinition& definition, const Picture& picture,
                const WorldOptions& options, uint32_t next_object);

    Result<ObjectId> add(const ObjectDefinition& object);
    Status remove(ObjectId id);
    Status move(ObjectId id, const Pose& to);
    Status switch_light(ObjectId id, bool on);
    void move_robot(size_t robot, const Pose& to);
    // As World::reseed(): noise and slip of robots, math.rand of their nodes.
    void reseed(uint64_t seed);

    std::span<const Object> objects() const { return objects_; }
    Pose pose_of(const Object& object) const;
    std::optional<ObjectId> find(std::string_view id) const;
    uint32_t next_object() const { return next_object_; }

    // In the order of the definition.
    std::span<const std::unique_ptr<Robot>> robots() const { return robots_; }
    // The robot with that body; none for objects and the border.
    std::optional<size_t> robot_of(BodyId body) const;
    // What a touch is called in the trace.
    std::string name_of(BodyId body) const;

    Arena& arena() { return arena_; }
    const Ground& ground() const { return ground_; }
    // The infrared beacons that are on.
    std::span<const Point> beacons() const { return beacons_; }
    // Colours of bodies by index, as cameras see them now.
    std::span<const Colour> colours();

private:
    Object* find(ObjectId id);
    void note_body(BodyId body, const Colour& colour);
    void refresh_ground();
    void add_robot(const RobotDefinition& robot, const WorldOptions& options);

    const WorldDefinition& definition_;
    uint64_t seed_;
    Arena arena_;
    Ground ground_;
    EnergyPool pool_;
    std::vector<Object> objects_;
    std::vector<std::unique_ptr<Robot>> robots_;
    std::vector<Colour> colours_;
    std::vector<std::optional<size_t>> robot_of_body_;  // robots stay for ever
    std::vector<Point> beacons_;
    uint32_t next_object_;
};

}  // namespace vagus::sim
