#include "serve/runner/hand.hpp"

#include <fmt/format.h>

#include "sim/world.hpp"

namespace vagus::serve {

namespace {

Status check_inside(const sim::World& world, const talk::Point& at) {
    const sim::WorldDefinition& is = world.definition();
    const bool inside = at.x >= 0 && at.x <= is.width && at.y >= 0 && at.y <= is.height;
    if (is.open || inside) return Status::done();
    return Error{Code::BadInput,
                 fmt::format("{:g}, {:g} m lies outside of the walls: the world is {:g} by {:g} m",
                             at.x, at.y, is.width, is.height)};
}

Result<sim::RobotId> robot_named(sim::World& world, const std::string& name) {
    const auto robot = world.find_robot(name);
    if (!robot) return Error{Code::NotFound, "there is no such robot in the world"};
    return *robot;
}

sim::ObjectKind kind_of(talk::ObjectKind kind) {
    switch (kind) {
        case talk::ObjectKind::Wall:
            return sim::ObjectKind::Wall;
        case talk::ObjectKind::Box:
            return sim::ObjectKind::Box;
        case talk::ObjectKind::Cylinder:
            return sim::ObjectKind::Cylinder;
    }
    return sim::ObjectKind::Box;
}

}  // namespace

Status hand(sim::World& world, const talk::MoveRobot& order) {
    TRY(check_inside(world, order.at));
    const sim::RobotId id = TRY(robot_named(world, order.robot));
    const double angle = order.angle.value_or(world.robots()[id.number - 1].pose.angle);
    return world.move(id, {{order.at.x, order.at.y}, angle});
}

Status hand(sim::World& world, const talk::MoveObject& order) {
    TRY(check_inside(world, order.at));
    const sim::ObjectId id{order.object};
    for (const sim::ObjectView& object : world.objects()) {
        if (object.id != id) continue;
        const double angle = order.angle.value_or(object.pose.angle);
        return world.move(id, {{order.at.x, order.at.y}, angle});
    }
    return Error{Code::NotFound, "there is no such object in the world any more"};
}

Result<uint32_t> hand(sim::World& world, const talk::PutObject& order) {
    TRY(check_inside(world, order.at));
    sim::ObjectDefinition object;
    object.kind = kind_of(order.kind);
    object.at = {order.at.x, order.at.y};
    object.angle = order.angle;
    if (order.kind == talk::ObjectKind::Cylinder) {
        object.radius = order.radius;
    } else {
        object.width = order.size.x;
        object.length = order.size.y;
    }
    return TRY(world.add(object)).number;
}

Status hand(sim::World& world, const talk::TakeObject& order) {
    return world.remove(sim::ObjectId{order.object});
}

Status hand(sim::World& world, const talk::SwitchLight& order) {
    return world.switch_light(sim::ObjectId{order.object}, order.on);
}

Status hand(sim::World& world, const talk::PressButton& order) {
    const sim::RobotId id = TRY(robot_named(world, order.robot));
    return order.down ? world.press(id, order.button) : world.release(id, order.button);
}

Status hand(sim::World& world, const talk::TapRobot& order) {
    return world.tap(TRY(robot_named(world, order.robot)));
}

}  // namespace vagus::serve
