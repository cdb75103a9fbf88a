#include "serve/host/hand.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/world.hpp"

namespace vagus::serve {

using Json = nlohmann::json;

namespace {

Status check_inside(const sim::World& world, double x, double y) {
    const sim::WorldDefinition& is = world.definition();
    const bool inside = x >= 0 && x <= is.width && y >= 0 && y <= is.height;
    if (is.open || inside) return Status::done();
    return Error{Code::BadInput,
                 fmt::format("{:g}, {:g} m lies outside of the walls: the world is {:g} by {:g} m",
                             x, y, is.width, is.height)};
}

Status move_object(sim::World& world, const Json& told) {
    const sim::ObjectId id{told["object"]};
    for (const sim::ObjectView& object : world.objects()) {
        if (object.id != id) continue;
        const double angle = told.value("angle", object.pose.angle);
        return world.move(id, {{told["at"][0], told["at"][1]}, angle});
    }
    return Error{Code::NotFound, "there is no such object in the world any more"};
}

Result<std::optional<uint32_t>> put(sim::World& world, const Json& told) {
    sim::ObjectDefinition object;
    const std::string kind = told["kind"];
    object.kind = kind == "wall"  ? sim::ObjectKind::Wall
                  : kind == "box" ? sim::ObjectKind::Box
                                  : sim::ObjectKind::Cylinder;
    object.at = {told["at"][0], told["at"][1]};
    object.angle = told.value("angle", 0.0);
    if (kind == "cylinder") {
        object.radius = told.value("radius", 0.05);
    } else {
        object.width = told.contains("size") ? told["size"][0].get<double>() : 0.2;
        object.length = told.contains("size") ? told["size"][1].get<double>() : 0.2;
    }
    const auto added = world.add(object);
    if (!added.ok()) return added.error();
    return std::optional<uint32_t>(added.value().number);
}

Status touch_robot(sim::World& world, const std::string& what, const Json& told) {
    const auto robot = world.find_robot(told["robot"].get<std::string>());
    if (!robot) {
        return Error{Code::NotFound, "there is no such robot in the world"};
    }
    if (what == "tap") return world.tap(*robot);
    if (what == "press") {
        const std::string button = told["button"];
        return told["down"].get<bool>() ? world.press(*robot, button)
                                        : world.release(*robot, button);
    }
    const auto robots = world.robots();
    const double angle = told.value("angle", robots[robot->number - 1].pose.angle);
    return world.move(*robot, {{told["at"][0], told["at"][1]}, angle});
}

Status touch(sim::World& world, const std::string& what, const Json& told) {
    if (what == "take") return world.remove(sim::ObjectId{told["object"]});
    if (what == "light") return world.switch_light(sim::ObjectId{told["object"]}, told["on"]);
    if (what == "move" && told.contains("object")) return move_object(world, told);
    return touch_robot(world, what, told);
}

}  // namespace

Result<std::optional<uint32_t>> hand(sim::World& world, const std::string& what, const Json& told) {
    if (told.contains("at")) TRY(check_inside(world, told["at"][0], told["at"][1]));
    if (what == "put") return put(world, told);
    TRY(touch(world, what, told));
    return std::optional<uint32_t>();
}

}  // namespace vagus::serve
