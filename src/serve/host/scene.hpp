// A world as pages draw it: what stands in it (JSON, when it changes), and where (bytes, as it
// flows). The layouts are those of protocol.json: scene, poses, rays, picture.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sim/world.hpp"

namespace vagus::serve {

nlohmann::json scene_of(const sim::World& world);
std::string poses_of(const sim::World& world);
std::string rays_of(const sim::World& world);
// What the robot's camera sees; empty without a camera.
std::string picture_of(const sim::World& world, sim::RobotId robot);

}  // namespace vagus::serve
