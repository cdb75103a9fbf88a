#include "session/known_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace vagus::session {
namespace {

bool has_variable(const aesl::Target& target, std::string_view name) {
    return std::any_of(target.variables.begin(), target.variables.end(),
                       [name](const aesl::NamedVariable& each) { return each.name == name; });
}

TEST(KnownNodes, SimulatedRobotsAreKnownByTheNamesOfTheirNodes) {
    EXPECT_TRUE(has_variable(known_node("thymio-II"), "prox.horizontal"));
    EXPECT_TRUE(has_variable(known_node("e-puck3"), "cam.red"));
    EXPECT_TRUE(has_variable(known_node("drive"), "odometry.heading"));
    EXPECT_TRUE(has_variable(known_node("bumper"), "touch.sectors"));
    EXPECT_TRUE(has_variable(known_node("range"), "sonar.distance"));
    EXPECT_TRUE(has_variable(known_node("head"), "infrared.direction"));
}

TEST(KnownNodes, AnyOtherNameIsTheSoftwareNode) {
    const aesl::Target target = known_node("somebody");
    EXPECT_TRUE(has_variable(target, "args"));
    EXPECT_FALSE(has_variable(target, "touch.sectors"));
}

}  // namespace
}  // namespace vagus::session
