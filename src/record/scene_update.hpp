// Bodies of a world as foxglove.SceneUpdate has them, for public viewers of MCAP.
//
//     const std::vector<Shape> shapes = {shape_of(robot), shape_of(object)};
//     tape.put(poses, at, scene_update(shapes, at));
#pragma once

#include <span>
#include <string>

#include "base/time.hpp"
#include "sim/world.hpp"

namespace vagus::record {

// A body as a box or a cylinder. It owns what it needs: it may be worded on another thread.
struct Shape {
    std::string id;
    sim::Pose pose;
    double height = 0.1;
    double x = 0;  // sizes; a cylinder has radius instead
    double y = 0;
    double radius = 0;
    sim::Colour colour;
};

// The id of an object, also where its definition has none.
std::string key_of(const sim::ObjectView& object);

Shape shape_of(const sim::ObjectView& object);
// Its hull as the smallest box around it.
Shape shape_of(const sim::RobotView& robot);

std::string scene_update(std::span<const Shape> shapes, Time at);
// The same, and all other entities of the topic are deleted.
std::string whole_scene(std::span<const Shape> shapes, Time at);

}  // namespace vagus::record
