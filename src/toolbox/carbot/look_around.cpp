// LookAround and SearchWall: the distance sensor is turned around, the robot is at rest.
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "toolbox/carbot/inputs.hpp"
#include "toolbox/carbot/rover.hpp"
#include "toolbox/carbot/templates.hpp"
#include "toolbox/carbot/walls.hpp"

namespace vagus::toolbox::carbot {

namespace {

using plan::Type;
using plan::Value;

constexpr double kReachDeg = 120;    // the rotator turns no further
constexpr double kInTheWayDeg = 45;  // to both sides of ahead

plan::Input spread_input() {
    return {.name = "spread",
            .type = Type::Float,
            .fallback = Value(kReachDeg),
            .unit = "deg",
            .help = "how far to each side it looks",
            .low = 0,
            .high = kReachDeg};
}

const plan::Template& look_around_declared() {
    static const plan::Template kDeclared{
        .name = "LookAround",
        .help = "Measures the distance in many directions.",
        .icon = "M12 12L20 6M12 12v-9M12 12L4 6M4 15a9 9 0 0 0 16 0M12 12v.1",
        .inputs = {spread_input(), step_input()},
        .outputs = {{.name = "map", .type = Type::Object, .help = "the distances"},
                    {.name = "nearest",
                     .type = Type::Float,
                     .unit = "cm",
                     .help = "the smallest of them; 0 if nothing is in reach"},
                    {.name = "angle", .type = Type::Float, .unit = "deg", .help = "where that is"}},
        .outcomes = {{"Done", "it has looked"}},
        .bus = Rover::bus_of(Rover::Needs::Range)};
    return kDeclared;
}

const plan::Template& search_wall_declared() {
    static const plan::Template kDeclared{
        .name = "SearchWall",
        .help = "Looks around for the wall that is in the way, or else the nearest one.",
        .icon = "M4 3v18M10 10a4 4 0 1 0 8 0a4 4 0 1 0-8 0M17 13l4 4",
        .inputs = {spread_input(),
                   step_input(),
                   side_input("right, left, or nearer (turns less)"),
                   {.name = "reach",
                    .type = Type::Float,
                    .fallback = Value(100.0),
                    .unit = "cm",
                    .help = "walls farther from the sensor do not count",
                    .low = 0,
                    .high = 300}},
        .outputs = {{.name = "angle",
                     .type = Type::Float,
                     .unit = "deg",
                     .help = "how far to turn to be parallel to it, with the wall on that side"},
                    {.name = "distance",
                     .type = Type::Float,
                     .unit = "cm",
                     .help = "from the sensor to the wall"}},
        .outcomes = {{"WallFound", "there is one"}, {"NoWallFound", "nothing is in reach"}},
        .bus = Rover::bus_of(Rover::Needs::Range)};
    return kDeclared;
}

std::vector<Echo> scan(run::ActorContext& context, const Parts& parts, const plan::Template& of) {
    const double spread = input_of(context, of, 0);
    const double step = input_of(context, of, 1);
    Rover rover(context, parts, Rover::Needs::Range);
    return stopping(rover, [&] { return rover.scan(-spread, spread, step); });
}

class LookAround final : public run::Actor {
public:
    explicit LookAround(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        std::vector<Echo> echoes = scan(context, parts_, look_around_declared());
        Echo nearest;
        for (const Echo& echo : echoes) {
            if (echo.distance_cm <= 0) continue;
            if (nearest.distance_cm > 0 && echo.distance_cm >= nearest.distance_cm) continue;
            nearest = echo;
        }
        context.out(0, Value(plan::Object(std::make_shared<DistanceMap>(std::move(echoes)))));
        context.out(1, Value(nearest.distance_cm));
        context.out(2, Value(nearest.angle_deg));
    }

private:
    const Parts& parts_;
};

double turn_for(const Wall& wall, std::string_view side) {
    const double right = wall.turn_to_have_it_right();
    const double left = wall.turn_to_have_it_left();
    if (side == "nearer") return std::abs(left) < std::abs(right) ? left : right;
    return side == "left" ? left : right;
}

class SearchWall final : public run::Actor {
public:
    explicit SearchWall(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        const std::string& side = context.in(2).string();
        if (side != "right" && side != "left" && side != "nearer") {
            throw run::CodeError("the input \"side\" is \"" + side +
                                 "\", but must be right, left or nearer");
        }
        const double reach = input_of(context, search_wall_declared(), 3);
        const std::vector<Echo> echoes = scan(context, parts_, search_wall_declared());
        // In a corner the wall ahead is the next one, however near that at the side is.
        auto wall = nearest_wall(echoes, {.to_side_deg = kInTheWayDeg, .reach_cm = reach});
        if (!wall) wall = nearest_wall(echoes, {.reach_cm = reach});
        context.end(wall ? 0 : 1);
        if (!wall) return;
        context.out(0, Value(turn_for(*wall, side)));
        context.out(1, Value(wall->distance_cm));
    }

private:
    const Parts& parts_;
};

}  // namespace

run::Coded look_around(const Parts& parts) {
    return {look_around_declared(), [&parts] { return std::make_unique<LookAround>(parts); }, {}};
}

run::Coded search_wall(const Parts& parts) {
    return {search_wall_declared(), [&parts] { return std::make_unique<SearchWall>(parts); }, {}};
}

}  // namespace vagus::toolbox::carbot
