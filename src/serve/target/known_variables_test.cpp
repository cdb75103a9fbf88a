#include "serve/target/known_variables.hpp"

#include <gtest/gtest.h>

#include "session/known_nodes.hpp"

namespace vagus::serve {
namespace {

TEST(KnownVariables, EveryVariableOfTheRobotsOfOurPagesIsDescribed) {
    for (const char* node : {"thymio-II", "drive", "bumper", "range", "head"}) {
        for (const aesl::NamedVariable& variable : session::known_node(node).variables) {
            const KnownVariable* known = known_variable(node, variable.name);
            ASSERT_TRUE(known) << node << " " << variable.name;
            EXPECT_FALSE(known->help.empty()) << node << " " << variable.name;
        }
    }
}

TEST(KnownVariables, WhatARobotObeysCanBeWritten) {
    EXPECT_TRUE(known_variable("thymio-II", "motor.left.target")->writable);
    EXPECT_FALSE(known_variable("thymio-II", "prox.horizontal")->writable);
    EXPECT_EQ(known_variable("thymio-II", "timer.period")->unit, "ms");
    EXPECT_EQ(known_variable("thymio-II", "nothing"), nullptr);
    EXPECT_EQ(known_variable("dummynode-0", "timer.period"), nullptr);
}

}  // namespace
}  // namespace vagus::serve
