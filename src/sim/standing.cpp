#include "sim/standing.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "base/trig.hpp"
#include "sim/carbot/carbot.hpp"
#include "sim/epuck/body.hpp"
#include "sim/thymio2/body.hpp"

namespace vagus::sim {
namespace {

using Corners = std::vector<Point>;

Corners placed(std::span<const Point> corners, const Point& at, double angle) {
    const double c = trig::cos(angle);
    const double s = trig::sin(angle);
    Corners there;
    for (const Point& corner : corners)
        there.push_back({at.x + c * corner.x - s * corner.y, at.y + s * corner.x + c * corner.y});
    return there;
}

Corners corners_of(const ObjectDefinition& object) {
    const double w = object.width / 2;
    const double h = object.length / 2;
    const std::array<Point, 4> corners = {{{-w, -h}, {w, -h}, {w, h}, {-w, h}}};
    return placed(corners, object.at, object.angle);
}

// How far `point` lies inside the edge from `a` to `b` of a polygon that goes counter-clockwise.
double inside(const Point& a, const Point& b, const Point& point) {
    const double x = b.x - a.x;
    const double y = b.y - a.y;
    return (x * (point.y - a.y) - y * (point.x - a.x)) / trig::hypot(x, y);
}

// How deep the second polygon reaches into the first, along the edges of the first.
double depth_along_edges(const Corners& first, const Corners& second) {
    double least = kWorldSizeMax;
    for (size_t i = 0; i < first.size(); ++i) {
        double deepest = -kWorldSizeMax;
        for (const Point& corner : second)
            deepest = std::max(deepest, inside(first[i], first[(i + 1) % first.size()], corner));
        least = std::min(least, deepest);
    }
    return least;
}

// Two convex polygons are apart where an edge of one has all of the other outside.
double depth(const Corners& first, const Corners& second) {
    return std::min(depth_along_edges(first, second), depth_along_edges(second, first));
}

double distance_to_edge(const Point& a, const Point& b, const Point& point) {
    const double x = b.x - a.x;
    const double y = b.y - a.y;
    const double along = ((point.x - a.x) * x + (point.y - a.y) * y) / (x * x + y * y);
    const double t = std::clamp(along, 0.0, 1.0);
    return trig::hypot(point.x - a.x - t * x, point.y - a.y - t * y);
}

// The same with a disc.
double depth(const Corners& hull, const Point& centre, double radius) {
    double distance = kWorldSizeMax;
    bool within = true;
    for (size_t i = 0; i < hull.size(); ++i) {
        const Point& next = hull[(i + 1) % hull.size()];
        distance = std::min(distance, distance_to_edge(hull[i], next, centre));
        within = within && inside(hull[i], next, centre) >= 0;
    }
    return within ? radius : radius - distance;
}

bool is_fixed(const ObjectDefinition& object) {
    const bool solid = object.kind == ObjectKind::Wall || object.kind == ObjectKind::Box ||
                       object.kind == ObjectKind::Cylinder;
    return solid && object.mass == 0;
}

// Circles around both that do not meet settle most cases cheaply.
bool is_far(const RobotDefinition& robot, const ObjectDefinition& object) {
    constexpr double kRobotReach = 0.3;  // m: no robot is larger
    const double reach = kRobotReach + object.radius + (object.width + object.length) / 2;
    const double x = object.at.x - robot.at.x;
    const double y = object.at.y - robot.at.y;
    return x * x + y * y > reach * reach;
}

bool reaches_over_border(const Corners& hull, const WorldDefinition& world) {
    if (world.open) return false;
    return std::any_of(hull.begin(), hull.end(), [&world](const Point& corner) {
        return corner.x < -kStandsInMax || corner.x > world.width + kStandsInMax ||
               corner.y < -kStandsInMax || corner.y > world.height + kStandsInMax;
    });
}

}  // namespace

std::span<const Point> outline_of(RobotType type) {
    switch (type) {
        case RobotType::Thymio2:
            return thymio2::outline();
        case RobotType::Epuck:
            return epuck::outline();
        case RobotType::Carbot:
            return carbot::outline();
    }
    return {};
}

std::optional<std::string> stands_in(const RobotDefinition& robot, const WorldDefinition& world) {
    const Corners hull = placed(outline_of(robot.type), robot.at, robot.angle);
    if (reaches_over_border(hull, world)) return "the border of the world; place it further inside";
    for (size_t i = 0; i < world.objects.size(); ++i) {
        const ObjectDefinition& object = world.objects[i];
        if (!is_fixed(object) || is_far(robot, object)) continue;
        const double deep = object.radius > 0 ? depth(hull, object.at, object.radius)
                                              : depth(hull, corners_of(object));
        if (deep <= kStandsInMax) continue;
        const std::string name =
            object.id.empty() ? "objects[" + std::to_string(i) + "]" : "\"" + object.id + "\"";
        return "the " + std::string(name_of(object.kind)) + " " + name +
               "; place one of them somewhere else";
    }
    return std::nullopt;
}

}  // namespace vagus::sim
