#include "cli/screen/arena.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace vagus::cli {
namespace {

constexpr Rgb kRayHit{235, 90, 60};
constexpr Rgb kRayFree{120, 150, 200};
constexpr Rgb kTrail{70, 110, 190};
constexpr Rgb kNose{40, 40, 60};
constexpr Rgb kMark{255, 210, 60};

Rgb blend(Rgb under, Rgb over, double part) {
    const auto mix = [part](uint8_t a, uint8_t b) {
        return static_cast<uint8_t>(std::lround(a + part * (b - a)));
    };
    return {mix(under.r, over.r), mix(under.g, over.g), mix(under.b, over.b)};
}

double luminance(Rgb c) {
    return 0.3 * c.r + 0.59 * c.g + 0.11 * c.b;
}

Rgb ground_at(const View& view, Point at) {
    const GroundImage& image = view.image;
    if (image.pixels.empty()) return view.ground;
    const auto index = [](double part, int count) {
        return static_cast<size_t>(std::clamp(static_cast<int>(part * count), 0, count - 1));
    };
    const size_t column = index(at.x / view.width, image.columns);
    const size_t row = index(1 - at.y / view.height, image.rows);
    return image.pixels[row * static_cast<size_t>(image.columns) + column];
}

Outline shrunk(const Outline& outline, Point centre, double factor) {
    Outline small = outline;
    small.radius *= factor;
    for (Point& corner : small.corners) {
        corner.x = centre.x + factor * (corner.x - centre.x);
        corner.y = centre.y + factor * (corner.y - centre.y);
    }
    return small;
}

Point middle(const Outline& outline) {
    if (outline.corners.empty()) return outline.centre;
    Point sum;
    for (const Point corner : outline.corners) {
        sum.x += corner.x;
        sum.y += corner.y;
    }
    const auto count = static_cast<double>(outline.corners.size());
    return {sum.x / count, sum.y / count};
}

// A wedge at the front, where the hull is dark: the way the robot looks.
Outline nose(const RobotPicture& robot) {
    double reach = robot.outline.radius;
    for (const Point corner : robot.outline.corners) {
        const double ahead = (corner.x - robot.at.x) * std::cos(robot.angle) +
                             (corner.y - robot.at.y) * std::sin(robot.angle);
        reach = std::max(reach, ahead);
    }
    const auto at = [&robot](double distance, double turn) {
        return Point{robot.at.x + distance * std::cos(robot.angle + turn),
                     robot.at.y + distance * std::sin(robot.angle + turn)};
    };
    return {
        {at(reach, 0), at(0.75 * reach, 0.6), at(0.45 * reach, 0), at(0.75 * reach, -0.6)}, {}, 0};
}

void paint_robot(Canvas& canvas, const RobotPicture& robot, bool selected) {
    const Rgb body = robot.led ? blend(robot.paint, *robot.led, 0.35) : robot.paint;
    const Point centre = middle(robot.outline);
    if (selected) canvas.shape(shrunk(robot.outline, centre, 1.25), {kMark, Stuff::Robot});
    canvas.shape(robot.outline, {body, Stuff::Robot});
    if (robot.led) canvas.shape(shrunk(robot.outline, centre, 0.6), {*robot.led, Stuff::Robot});
    canvas.shape(nose(robot), {kNose, Stuff::Robot});
}

// The nearest of eight arrows.
char32_t arrow(double angle, Charset charset) {
    static constexpr std::array<char32_t, 8> kArrows = {U'→', U'↗', U'↑', U'↖',
                                                        U'←', U'↙', U'↓', U'↘'};
    static constexpr std::array<char32_t, 8> kLetters = {U'>', U'/', U'^', U'\\',
                                                         U'<', U'/', U'v', U'\\'};
    const auto eighth = static_cast<int>(std::lround(angle / (std::numbers::pi / 4)));
    const auto index = static_cast<size_t>(((eighth % 8) + 8) % 8);
    return charset == Charset::Ascii ? kLetters[index] : kArrows[index];
}

// Where a robot is only a few cells wide, its form does not tell where it points: an arrow does.
void mark_direction(Grid& grid, const Canvas& canvas, const RobotPicture& robot, const Look& look) {
    const Point centre = middle(robot.outline);
    const int column = canvas.column_of(centre);
    const int row = canvas.row_of(centre);
    const Size size = grid.size();
    if (!canvas.inside(centre) || column >= size.columns || row >= size.rows) return;
    Cell cell = grid.at(column, row);
    const Rgb back = robot.led.value_or(robot.paint);
    cell.glyph = arrow(robot.angle, look.charset);
    cell.ink = {std::nullopt, std::nullopt, true};
    if (look.depth != ColourDepth::None) {
        cell.ink.back = back;
        cell.ink.fore = luminance(back) > 110 ? Rgb{20, 20, 30} : Rgb{255, 255, 255};
    }
    grid.put(column, row, cell);
}

void paint_shapes(Canvas& canvas, std::span<const ShapeView> shapes) {
    for (const ShapeView& shape : shapes) {
        const Stuff stuff = shape.kind == ShapeKind::Patch   ? Stuff::Mark
                            : shape.kind == ShapeKind::Solid ? Stuff::Solid
                                                             : Stuff::Lamp;
        canvas.shape(shape.outline, {shape.colour, stuff});
    }
}

// Marks lie under the walls around the world, all else is in front of them.
void paint_things(Canvas& canvas, const View& view) {
    const auto standing =
        std::find_if(view.shapes.begin(), view.shapes.end(),
                     [](const ShapeView& shape) { return shape.kind != ShapeKind::Patch; });
    const auto marks = static_cast<size_t>(standing - view.shapes.begin());
    const std::span<const ShapeView> shapes(view.shapes);
    paint_shapes(canvas, shapes.first(marks));
    if (view.border) canvas.frame({*view.border, Stuff::Solid});
    paint_shapes(canvas, shapes.subspan(marks));
}

void paint_lines(Canvas& canvas, const View& view) {
    for (const RobotPicture& robot : view.robots) {
        for (const Point at : robot.trail) canvas.dot(at, kTrail);
    }
    for (size_t i = 0; i < view.robots.size(); i++) {
        const RobotPicture& robot = view.robots[i];
        for (const RayView& ray : robot.rays) {
            if (i == view.selected || ray.hit) {
                canvas.line(ray.from, ray.to, ray.hit ? kRayHit : kRayFree);
            }
        }
    }
}

}  // namespace

void draw_arena(Grid& grid, Area area, const View& view, const Look& look) {
    Canvas canvas(area, view.width, view.height);
    canvas.floor([&view](Point at) { return ground_at(view, at); });
    paint_things(canvas, view);
    const bool several = view.robots.size() > 1;
    for (size_t i = 0; i < view.robots.size(); i++) {
        paint_robot(canvas, view.robots[i], several && i == view.selected);
    }
    paint_lines(canvas, view);
    canvas.draw(grid, look);
    for (const RobotPicture& robot : view.robots) mark_direction(grid, canvas, robot, look);
}

}  // namespace vagus::cli
