#include "session/safe_stop.hpp"
#include "base/test_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/file.hpp"

namespace vagus::session {
namespace {

namespace fs = std::filesystem;

// A toolbox file in a folder of this test's own.
class SafeStopOf : public testing::Test {
protected:
    std::string toolbox(const std::string& name, const std::string& safe_stop) const {
        const std::string path = (folder_ / (name + ".toolbox.json")).string();
        EXPECT_TRUE(write_file(path, "{ \"format\": \"vagus-toolbox/1\", \"name\": \"" + name +
                                         "\", \"project\": \"p.aesl\", \"templates\": {}, "
                                         "\"safe_stop\": " +
                                         safe_stop + " }")
                        .ok());
        return path;
    }

    test::Folder folder_;
};

TEST_F(SafeStopOf, TheProjectStandsAboveToolboxesAndTheseAboveWhatShips) {
    const std::string lower = toolbox("lower", R"({ "drive": { "read": ["v"] }, "arm": {} })");
    const std::string upper = toolbox("upper", R"({ "arm": { "set": { "speed": 0 } },
                                                    "thymio-II": { "read": ["temperature"] } })");
    const SafeStop safe =
        safe_stop_of({lower, upper, "own.so"}, {{"thymio-II", {{{"lamp", {1}}}, {}}}}).value();
    EXPECT_EQ(safe.at("drive"), (SafeStopNode{{}, {"v"}}));
    EXPECT_EQ(safe.at("arm"), (SafeStopNode{{{"speed", {0}}}, {}}));
    EXPECT_EQ(safe.at("thymio-II"), (SafeStopNode{{{"lamp", {1}}}, {}}));
    EXPECT_EQ(safe.at("e-puck1"), shipped_safe_stop().at("e-puck1"));
}

TEST_F(SafeStopOf, TheFirstWrongFileIsNamed) {
    const std::string wrong = toolbox("wrong", R"({ "drive": 3 })");
    const auto safe = safe_stop_of({wrong}, {});
    ASSERT_FALSE(safe.ok());
    EXPECT_NE(safe.error().what.find("wrong.toolbox.json:1:"), std::string::npos)
        << safe.error().what;
}

TEST_F(SafeStopOf, AFileInAProjectTakesWhatThatAndItsToolboxesSay) {
    (void)toolbox("own", R"({ "arm": { "read": ["v"] }, "leg": { "read": ["v"] } })");
    const std::string given = toolbox("given", R"({ "leg": { "read": ["w"] } })");
    const std::string file = (folder_ / "a.aesl").string();
    EXPECT_EQ(safe_stop_around(file, {given}).value().count("arm"), 0u);
    ASSERT_TRUE(write_file((folder_ / "vagus.json").string(),
                           R"({ "format": "vagus-project/1", "toolboxes": ["own.toolbox.json"],
                                "safe_stop": { "drive": {} } })")
                    .ok());
    const SafeStop safe = safe_stop_around(file, {given}).value();
    EXPECT_EQ(safe.at("arm"), (SafeStopNode{{}, {"v"}}));
    EXPECT_EQ(safe.at("leg"), (SafeStopNode{{}, {"w"}}));
    EXPECT_EQ(safe.at("drive"), SafeStopNode());
}

}  // namespace
}  // namespace vagus::session
