// The camera of a simulated robot, for templates that look through one.
#pragma once

#include <utility>

#include "run/code.hpp"
#include "sim/world.hpp"
#include "toolbox/camera.hpp"

namespace vagus::session {

class WorldCamera final : public toolbox::Camera {
public:
    // That of the robot, or else of the first one that has one. The world is borrowed, and stands
    // still while a picture is taken: the code of templates runs between its instants.
    explicit WorldCamera(const sim::World& world, std::optional<sim::RobotId> only = {})
        : world_(world), only_(only) {}

    // Whether there is one.
    bool exists() const { return robot().has_value(); }

    toolbox::Image take() override {
        const auto carrier = robot();
        if (!carrier) throw run::CodeError("no robot of this world has a camera; add a carbot");
        sim::Picture picture = std::move(world_.render(*carrier).value());
        return {static_cast<int>(picture.width), static_cast<int>(picture.height),
                std::move(picture.pixels)};
    }

private:
    std::optional<sim::RobotId> robot() const {
        for (const sim::RobotView& each : world_.robots()) {
            const bool meant = !only_ || *only_ == each.id;
            if (meant && world_.has_camera(each.id)) return each.id;
        }
        return std::nullopt;
    }

    const sim::World& world_;
    std::optional<sim::RobotId> only_;
};

}  // namespace vagus::session
