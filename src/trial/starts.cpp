#include "trial/starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <vector>

#include "base/file.hpp"
#include "base/nearest.hpp"
#include "base/rng.hpp"
#include "sim/standing.hpp"
#include "sim/world_file.hpp"

namespace vagus::trial {

namespace {

// The draw of places is a stream of its own: what else a seed gives does not hang on it.
constexpr uint64_t kStartsStream = 0x9d2c5680;
constexpr double kRadiansPerDegree = std::numbers::pi / 180;

}  // namespace

Result<std::string> draw_start(const TestFile& test, uint64_t seed) {
    const Starts& starts = *test.starts;
    if (test.world.empty()) {
        return Error{Code::BadInput, test.path +
                                         ": \"starts\" puts a robot somewhere in a world; "
                                         "give the test a \"world\""};
    }
    const std::string text = TRY(read_file(test.world));
    const sim::WorldDefinition world = TRY(sim::read_world(text, test.world));
    const auto found = std::ranges::find(world.robots, starts.robot, &sim::RobotDefinition::name);
    if (found == world.robots.end()) {
        std::vector<std::string> names;
        for (const sim::RobotDefinition& robot : world.robots) names.push_back(robot.name);
        return Error{
            Code::NotFound,
            fmt::format("{}: \"robot\" of \"starts\": {} has no robot \"{}\"; {}", test.path,
                        test.world, starts.robot, known_instead(starts.robot, names))};
    }
    SplitMix64 random(seed ^ kStartsStream);
    const auto between = [&random](double low, double high) {
        return low + random.unit() * (high - low);
    };
    std::string stands;
    for (int tried = 0; tried < kStartsTriedMax; ++tried) {
        sim::RobotDefinition robot = *found;
        robot.at.x = between(starts.low.x, starts.high.x);
        robot.at.y = between(starts.low.y, starts.high.y);
        const double degrees = between(starts.angle_low, starts.angle_high);
        robot.angle = degrees * kRadiansPerDegree;
        const auto in = sim::stands_in(robot, world);
        if (!in) {
            return fmt::format("{}={},{},{}", robot.name, plan::text_of(robot.at.x),
                               plan::text_of(robot.at.y), plan::text_of(degrees));
        }
        stands = *in;
    }
    return Error{Code::Refused,
                 fmt::format("{}: \"within\" of \"starts\": of {} places drawn there none had room "
                             "for the robot; the last one stood in {}",
                             test.path, kStartsTriedMax, stands)};
}

}  // namespace vagus::trial
