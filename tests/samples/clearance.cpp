#include "clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace vagus::samples {

namespace {

using sim::Point;

Point placed(Point point, const sim::Pose& pose) {
    const double cosine = std::cos(pose.angle);
    const double sine = std::sin(pose.angle);
    return {pose.at.x + cosine * point.x - sine * point.y,
            pose.at.y + sine * point.x + cosine * point.y};
}

std::vector<Point> placed(std::span<const Point> points, const sim::Pose& pose) {
    std::vector<Point> all;
    for (const Point& point : points) all.push_back(placed(point, pose));
    return all;
}

double to_segment(Point point, Point from, Point to) {
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const double length2 = dx * dx + dy * dy;
    const double along =
        length2 > 0 ? ((point.x - from.x) * dx + (point.y - from.y) * dy) / length2 : 0;
    const double at = std::clamp(along, 0.0, 1.0);
    return std::hypot(point.x - from.x - at * dx, point.y - from.y - at * dy);
}

// Of a convex polygon, counter-clockwise.
bool contains(const std::vector<Point>& polygon, Point point) {
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Point& a = polygon[i];
        const Point& b = polygon[(i + 1) % polygon.size()];
        if ((b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x) < 0) return false;
    }
    return true;
}

double to_point(const std::vector<Point>& polygon, Point point) {
    if (contains(polygon, point)) return 0;
    double nearest = HUGE_VAL;
    for (size_t i = 0; i < polygon.size(); ++i) {
        nearest =
            std::min(nearest, to_segment(point, polygon[i], polygon[(i + 1) % polygon.size()]));
    }
    return nearest;
}

// Two convex polygons that cross without a corner of one in the other: that needs something thinner
// than a hull, whose corners stick out on both sides; it is found by its middle.
double between(const std::vector<Point>& one, const std::vector<Point>& other, Point middle) {
    double nearest = to_point(one, middle);
    for (const Point& point : one) nearest = std::min(nearest, to_point(other, point));
    for (const Point& point : other) nearest = std::min(nearest, to_point(one, point));
    return nearest;
}

bool is_in_the_way(const sim::ObjectDefinition& object) {
    using enum sim::ObjectKind;
    return object.kind == Wall || object.kind == Box || object.kind == Cylinder;
}

double to_object(const std::vector<Point>& hull, const sim::ObjectView& object) {
    const sim::ObjectDefinition& shape = *object.definition;
    if (shape.radius > 0) return std::max(to_point(hull, object.pose.at) - shape.radius, 0.0);
    const double x = shape.width / 2;
    const double y = shape.length / 2;
    const std::array<Point, 4> corners = {{{-x, -y}, {x, -y}, {x, y}, {-x, y}}};
    return between(hull, placed(corners, object.pose), object.pose.at);
}

double to_border(const std::vector<Point>& hull, const sim::WorldDefinition& world) {
    if (world.open) return HUGE_VAL;
    double nearest = HUGE_VAL;
    for (const Point& point : hull) {
        nearest =
            std::min({nearest, point.x, point.y, world.width - point.x, world.height - point.y});
    }
    return std::max(nearest, 0.0);
}

}  // namespace

double clearance(const sim::World& world, const sim::RobotView& robot, const sim::Pose& pose) {
    const std::vector<Point> hull = placed(robot.outline, pose);
    double nearest = to_border(hull, world.definition());
    for (const sim::ObjectView& object : world.objects()) {
        if (is_in_the_way(*object.definition)) {
            nearest = std::min(nearest, to_object(hull, object));
        }
    }
    return nearest;
}

}  // namespace vagus::samples
