#include "serve/talk/scene.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/trig.hpp"
#include "serve/bytes.hpp"
#include "serve/follow/sights.hpp"
#include "serve/json.hpp"
#include "sim/camera.hpp"

namespace vagus::serve {

namespace {

void append_point(std::string& bytes, sim::Point point) {
    append(bytes, static_cast<float>(point.x));
    append(bytes, static_cast<float>(point.y));
}

Json json_of(sim::Point point) {
    return {point.x, point.y};
}
Json json_of(sim::Colour colour) {
    return {colour.r, colour.g, colour.b};
}

// Heights of the bodies, in metres: Thymio II and e-puck by their makers, Carbot by the paper.
double height_of(sim::RobotType type) {
    switch (type) {
        case sim::RobotType::Thymio2:
            return 0.053;
        case sim::RobotType::Epuck:
            return 0.047;
        case sim::RobotType::Carbot:
            return 0.22;
    }
    return 0.1;
}

std::vector<uint16_t> nodes_of(const sim::RobotView& robot) {
    std::vector<uint16_t> nodes;
    if (robot.own_bus) return nodes;  // nobody here is on that bus
    for (uint16_t i = 0; i < robot.nodes; ++i) {
        nodes.push_back(static_cast<uint16_t>(robot.node + i));
    }
    return nodes;
}

Json robot_json(const sim::World& world, const sim::RobotView& robot) {
    Json outline = Json::array();
    for (const sim::Point point : robot.outline) outline.push_back(json_of(point));
    Json buttons = Json::array();
    for (const std::string_view button : sim::buttons_of(robot.type)) buttons.push_back(button);
    return {{"name", robot.name},
            {"type", sim::name_of(robot.type)},
            {"nodes", nodes_of(robot)},
            {"outline", std::move(outline)},
            {"paint", json_of(robot.paint)},
            {"height", height_of(robot.type)},
            {"camera", world.has_camera(robot.id)},
            {"buttons", std::move(buttons)}};
}

Json object_json(const sim::ObjectView& object) {
    const sim::ObjectDefinition& definition = *object.definition;
    Json json = {{"id", definition.id},
                 {"number", object.id.number},
                 {"kind", sim::name_of(definition.kind)},
                 {"height", definition.height},
                 {"mass", definition.mass},
                 {"colour", json_of(definition.colour)},
                 {"on", object.on}};
    if (definition.radius > 0) {
        json["radius"] = definition.radius;
    } else {
        json["size"] = {definition.width, definition.length};
    }
    return json;
}

}  // namespace

talk::Scene scene_of(const sim::World& world) {
    const sim::WorldDefinition& definition = world.definition();
    talk::Scene scene;
    Json robots = Json::array();
    for (const sim::RobotView& robot : world.robots()) {
        scene.robots.push_back({std::string(robot.name), nodes_of(robot)});
        robots.push_back(robot_json(world, robot));
    }
    Json objects = Json::array();
    for (const sim::ObjectView& object : world.objects()) objects.push_back(object_json(object));
    Json document = {{"name", definition.name},     {"size", {definition.width, definition.height}},
                     {"open", definition.open},     {"ground", json_of(definition.ground)},
                     {"robots", std::move(robots)}, {"objects", std::move(objects)}};
    if (!definition.ground_image.empty()) document["image"] = definition.ground_image;
    scene.document.json = std::move(document);
    return scene;
}

// All objects, so that a page that has just come knows where the fixed ones are, too.
std::string poses_of(const sim::World& world) {
    const auto robots = world.robots();
    const auto objects = world.objects();
    std::string bytes;
    append(bytes, static_cast<uint16_t>(robots.size()));
    append(bytes, static_cast<uint16_t>(objects.size()));
    for (const sim::RobotView& robot : robots) {
        append_point(bytes, robot.pose.at);
        append(bytes, static_cast<float>(robot.pose.angle));
    }
    for (const sim::ObjectView& object : objects) {
        append(bytes, object.id.number);
        append_point(bytes, object.pose.at);
        append(bytes, static_cast<float>(object.pose.angle));
    }
    return bytes;
}

// Rounded to a tenth of a millimetre, and without a negative zero: a look that hits nothing is then
// the same while its robot moves.
std::string looks_of(const sim::World& world, const sim::RobotView& robot, uint16_t index) {
    const double cosine = trig::cos(robot.pose.angle);
    const double sine = trig::sin(robot.pose.angle);
    const auto in_robot = [&](sim::Point at) {
        const double x = at.x - robot.pose.at.x;
        const double y = at.y - robot.pose.at.y;
        const auto rounded = [](double metres) { return std::round(metres * 1e4) / 1e4 + 0.0; };
        return sim::Point{rounded(cosine * x + sine * y), rounded(cosine * y - sine * x)};
    };
    std::string looks;
    for (const sim::Beam& look : world.beams(robot.id)) {
        append(looks, index);
        append(looks, static_cast<uint16_t>(look.hit ? 1 : 0));
        append_point(looks, in_robot(look.from));
        append_point(looks, in_robot(look.to));
    }
    return looks;
}

std::string lamps_of(const sim::World& world, const sim::RobotView& robot, uint16_t index) {
    std::string lamps;
    for (const sim::Lamp& lamp : world.lamps(robot.id)) {
        append(lamps, index);
        append(lamps, uint16_t{0});
        append_point(lamps, lamp.at);
        append(lamps, static_cast<float>(lamp.colour.r));
        append(lamps, static_cast<float>(lamp.colour.g));
        append(lamps, static_cast<float>(lamp.colour.b));
    }
    return lamps;
}

std::string rays_of(const sim::World& world) {
    std::string looks, lamps;
    uint16_t index = 0;
    for (const sim::RobotView& robot : world.robots()) {
        looks += looks_of(world, robot, index);
        lamps += lamps_of(world, robot, index++);
    }
    return rays_payload(looks, lamps);
}

std::string picture_of(const sim::World& world, sim::RobotId robot) {
    const auto picture = world.render(robot);
    if (!picture.ok()) return {};
    std::string bytes;
    append(bytes, static_cast<uint16_t>(picture.value().width));
    append(bytes, static_cast<uint16_t>(picture.value().height));
    const auto& pixels = picture.value().pixels;
    bytes.append(reinterpret_cast<const char*>(pixels.data()), pixels.size() * sizeof pixels[0]);
    return bytes;
}

void put_robots(sim::World& world, const std::vector<talk::Pose>& poses) {
    std::vector<sim::RobotId> ids;
    for (const sim::RobotView& robot : world.robots()) ids.push_back(robot.id);
    for (size_t i = 0; i < ids.size() && i < poses.size(); ++i) {
        (void)world.move(ids[i], {{poses[i].x, poses[i].y}, poses[i].angle}).ok();
    }
}

}  // namespace vagus::serve
