#include "toolbox/builtin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace vagus::toolbox {
namespace {

using testing::ElementsAre;

class Builtin : public testing::Test {
protected:
    Builtin() { add_builtin(library_, parts_); }

    Parts parts_;
    run::CodeLibrary library_;
};

TEST_F(Builtin, AreCoreDriveCarbotAndFleet) {
    std::vector<std::string> names;
    for (const auto& toolbox : library_.templates().toolboxes()) {
        names.push_back(toolbox.name);
        EXPECT_TRUE(is_builtin(toolbox.name));
    }
    EXPECT_THAT(names, ElementsAre("core", "drive", "carbot", "fleet"));
    EXPECT_FALSE(is_builtin("lamp"));
}

// What an editor shows is there for all of them.
TEST_F(Builtin, HaveHelpAndAnIconForEverything) {
    for (const auto& toolbox : library_.templates().toolboxes()) {
        EXPECT_FALSE(toolbox.help.empty()) << toolbox.name;
        for (const plan::Template& one : toolbox.templates) {
            const std::string name = toolbox.name + "." + one.name;
            EXPECT_FALSE(one.help.empty()) << name;
            EXPECT_TRUE(one.icon.starts_with("M")) << name;
            for (const auto& input : one.inputs) EXPECT_FALSE(input.help.empty()) << name;
            for (const auto& output : one.outputs) EXPECT_FALSE(output.help.empty()) << name;
            for (const auto& outcome : one.outcomes) EXPECT_FALSE(outcome.help.empty()) << name;
        }
    }
}

// The same templates, so the same plans: those of drive are in carbot too.
TEST_F(Builtin, CarbotHasTheTemplatesOfDrive) {
    const auto names_of = [this](std::string_view toolbox) {
        std::vector<std::string> names;
        for (const auto& one : library_.templates().find(toolbox)->templates) {
            names.push_back(one.name);
        }
        return names;
    };
    EXPECT_THAT(names_of("drive"),
                testing::IsSupersetOf({"Forward", "Turn", "Curve", "CheckTouchSensor"}));
    EXPECT_THAT(names_of("carbot"), testing::IsSupersetOf(names_of("drive")));
    EXPECT_THAT(names_of("carbot"),
                testing::IsSupersetOf({"SearchWall", "WallForward", "LookAround", "FindInfrared",
                                       "ReadColour", "FindObject", "FollowObject", "NavigateTo",
                                       "CheckDrivingLane", "CheckEscapeButton", "CheckProgress",
                                       "CheckWallDistance"}));
}

TEST_F(Builtin, EveryTemplateHasCode) {
    for (const auto& toolbox : library_.templates().toolboxes()) {
        for (const plan::Template& one : toolbox.templates) {
            if (one.kind == plan::Kind::Supervisor) {
                EXPECT_NE(library_.make_supervisor(one), nullptr) << one.name;
            } else {
                EXPECT_NE(library_.make_actor(one), nullptr) << one.name;
            }
        }
    }
}

}  // namespace
}  // namespace vagus::toolbox
