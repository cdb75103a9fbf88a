#include "serve/runner/hand.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/world.hpp"

namespace vagus::serve {

namespace {

constexpr double kUsualSide = 0.2, kUsualRadius = 0.05;  // metres, of what a hand puts

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

Status set_button(sim::World& world, const std::string& robot, const std::string& button,
                  bool down) {
    const sim::RobotId id = TRY(robot_named(world, robot));
    return down ? world.press(id, button) : world.release(id, button);
}

// The kinds of the two lists have one order.
sim::ObjectKind kind_of(talk::ObjectKind kind) {
    return static_cast<sim::ObjectKind>(kind);
}
static_assert(static_cast<int>(talk::ObjectKind::Wall) == static_cast<int>(sim::ObjectKind::Wall));
static_assert(static_cast<int>(talk::ObjectKind::Infrared) ==
              static_cast<int>(sim::ObjectKind::Infrared));

// Neither a size nor a radius was given: a disc, or a square; a lamp needs neither.
void give_usual_size(sim::ObjectDefinition& object) {
    switch (object.kind) {
        case sim::ObjectKind::Wall:
        case sim::ObjectKind::Box:
            object.width = object.length = kUsualSide;
            return;
        case sim::ObjectKind::Cylinder:
        case sim::ObjectKind::Patch:
            object.radius = kUsualRadius;
            return;
        case sim::ObjectKind::Light:
        case sim::ObjectKind::Infrared:
            return;
    }
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
    object.id = order.id;
    if (!order.size && !order.radius) give_usual_size(object);
    object.radius = order.radius.value_or(object.radius);
    if (order.size) object.width = order.size->x;
    if (order.size) object.length = order.size->y;
    object.height = order.height.value_or(object.height);
    object.mass = order.mass.value_or(object.mass);
    if (order.colour) object.colour = {order.colour->r, order.colour->g, order.colour->b};
    const sim::ObjectId put = TRY(world.add(object));
    if (!order.on) TRY(world.switch_light(put, false));
    return put.number;
}

Status hand(sim::World& world, const talk::TakeObject& order) {
    return world.remove(sim::ObjectId{order.object});
}

Status hand(sim::World& world, const talk::SwitchLight& order) {
    return world.switch_light(sim::ObjectId{order.object}, order.on);
}

Status hand(sim::World& world, const talk::TapRobot& order) {
    return world.tap(TRY(robot_named(world, order.robot)));
}

Status Buttons::press(sim::World& world, const talk::PressButton& order) {
    const auto held = std::ranges::find_if(down_, [&](const Down& one) {
        return one.robot == order.robot && one.button == order.button;
    });
    const bool known = held != down_.end();
    if (!order.down && known && world.now() < held->since + kPressLasts) {
        held->let_go = true;
        return Status::done();
    }
    // Pressed again before it was up: two clicks are two.
    if (order.down && known && held->let_go)
        (void)set_button(world, held->robot, held->button, false).ok();
    if (known) down_.erase(held);
    TRY(set_button(world, order.robot, order.button, order.down));
    if (order.down) down_.push_back({order.robot, order.button, world.now()});
    return Status::done();
}

void Buttons::release_due(sim::World& world) {
    std::erase_if(down_, [&world](const Down& one) {
        const bool due = one.let_go && world.now() >= one.since + kPressLasts;
        if (due) (void)set_button(world, one.robot, one.button, false).ok();
        return due;
    });
}

}  // namespace vagus::serve
