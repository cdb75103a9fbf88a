// A world as pages draw it: what is in it (JSON, when it changes), and where (bytes, as it
// flows). The layouts are those of protocol.json: scene, poses, rays, picture.
#pragma once

#include <string>
#include <vector>

#include "serve/talk/news.hpp"
#include "sim/world.hpp"

namespace vagus::serve {

talk::Scene scene_of(const sim::World& world);
std::string poses_of(const sim::World& world);
std::string rays_of(const sim::World& world);
// Its parts of one robot, by its index in the scene.
std::string looks_of(const sim::World& world, const sim::RobotView& robot, uint16_t index);
std::string lamps_of(const sim::World& world, const sim::RobotView& robot, uint16_t index);
// What the robot's camera sees; empty without a camera.
std::string picture_of(const sim::World& world, sim::RobotId robot);
// Robots where they were before a run, if a hand put them there: in their order.
void put_robots(sim::World& world, const std::vector<talk::Pose>& poses);

}  // namespace vagus::serve
