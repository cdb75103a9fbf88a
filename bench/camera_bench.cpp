// What a picture of Carbot's camera costs: to draw it in a furnished room, and to find and follow
// an object in it.
//
//     build/release/bin/bench_camera      `figure:` lines, medians
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "base/trig.hpp"
#include "sim/world.hpp"
#include "toolbox/carbot/object_eye.hpp"

namespace {

using namespace vagus;
using Clock = std::chrono::steady_clock;

constexpr int kPictures = 400;

// A room of 6 by 5 m with 40 posts and boxes of many colours, one of them red.
sim::WorldDefinition room() {
    sim::WorldDefinition world;
    world.width = 6;
    world.height = 5;
    world.robots.push_back({.name = "carbot", .type = sim::RobotType::Carbot, .at = {1, 2.5}});
    for (int i = 0; i < 40; ++i) {
        sim::ObjectDefinition object;
        object.kind = i % 2 == 0 ? sim::ObjectKind::Cylinder : sim::ObjectKind::Box;
        object.at = {2.2 + 0.45 * (i % 8), 0.5 + 0.9 * (i / 8)};
        (i % 2 == 0 ? object.radius : object.width) = 0.1;
        if (i % 2 == 1) object.length = 0.2;
        object.height = 0.08 + 0.05 * (i % 5);
        object.colour = i == 18 ? sim::Colour{0.9, 0.1, 0.1} : sim::Colour{0.2, 0.02 * i, 0.8};
        world.objects.push_back(object);
    }
    return world;
}

double median(std::vector<double>& all) {
    std::nth_element(all.begin(), all.begin() + kPictures / 2, all.end());
    return all[kPictures / 2];
}

template <typename Act>
double milliseconds(const Act& act) {
    const auto start = Clock::now();
    act();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

int main() {
    sim::World world = std::move(sim::World::create(room()).value());
    const sim::RobotId robot = *world.find_robot("carbot");
    toolbox::carbot::ObjectEye eye({0.9, 0.1, 0.1});
    std::vector<double> drawn;
    std::vector<double> looked;
    int seen = 0;
    for (int i = 0; i < kPictures; ++i) {
        const double angle = 0.3 * trig::sin(0.05 * i);
        if (!world.move(robot, {{1, 2.5}, angle}).ok()) return 1;
        sim::Picture picture;
        drawn.push_back(milliseconds([&] { picture = std::move(world.render(robot).value()); }));
        const toolbox::Image image = {static_cast<int>(picture.width),
                                      static_cast<int>(picture.height), std::move(picture.pixels)};
        looked.push_back(milliseconds([&] { seen += eye.follow(image) ? 1 : 0; }));
    }
    fmt::print(
        "figure: a picture of 160 x 120 is drawn in {:.2f} ms, looked at in {:.2f} ms "
        "(medians of {}; the object was seen in {})\n",
        median(drawn), median(looked), kPictures, seen);
    return 0;
}
