#include "serve/workbench/folder_project.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "base/test_places.hpp"
#include "serve/workbench/opened.hpp"
#include "session/sim_session.hpp"

using namespace vagus;
using namespace vagus::serve;
namespace fs = std::filesystem;

namespace {

constexpr const char* kPlan = R"({
  "format": "vagus-plan/1",
  "name": "Away",
  "toolboxes": ["drive"],
  "start": { "actor": "ahead" },
  "actors": {
    "ahead": {
      "template": "Forward",
      "in": { "distance": 20 },
      "states": { "ForwardSuccessful": "@terminate" }
    }
  }
}
)";

struct FolderProjectTest : testing::Test {
    void write(const std::string& name, std::string_view text) const { folder.write(name, text); }
    void copy(const std::string& example, const std::string& name) const {
        write(name, read_file((fs::path(test::examples()) / example).string()).value());
    }
    OpenedProject opened(const std::string& name) const {
        auto found = open_path((folder / name).string());
        EXPECT_TRUE(found.ok()) << found.error().what;
        return found.ok() ? found.value() : OpenedProject();
    }
    // Made, opened, and run until its nodes have their scripts.
    OpenedProject made(const std::string& name, const std::string& shown = "") const {
        const auto path = make_project_of(opened(name), shown, test::examples());
        EXPECT_TRUE(path.ok()) << path.error().what;
        if (!path.ok()) return {};
        const OpenedProject project = opened(fs::relative(path.value(), folder.path()).string());
        auto session = session::open_sim(project.real(project.world), {});
        EXPECT_TRUE(session.ok()) << session.error().what;
        if (!session.ok()) return project;
        EXPECT_TRUE(session.value().settle());
        EXPECT_TRUE(session.value().mistakes().empty());
        EXPECT_TRUE(session.value().without_script().empty());
        return project;
    }
    const test::Folder folder;
};

TEST_F(FolderProjectTest, AFolderWithoutAProjectFileRunsTheOnlyFileOfEachKind) {
    write("room/way.plan.json", kPlan);
    copy("carbot/carbot.aesl", "room/wheels.aesl");
    write("room/big.world.json", "{}");
    write("room/notes.txt", "x");
    const OpenedProject project = opened("room");
    EXPECT_EQ(project.name, "room");
    EXPECT_EQ(project.plan, "way.plan.json");
    EXPECT_EQ(project.world, "big.world.json");
    EXPECT_EQ(project.scripts, std::vector<std::string>{"wheels.aesl"});
    EXPECT_EQ(project.project_file, "");
    EXPECT_TRUE(project.only.empty());  // all its files are listed
    EXPECT_FALSE(fs::exists(folder / "room/vagus.json"));
}

TEST_F(FolderProjectTest, OfSeveralFilesOfAKindNoneIsChosen) {
    for (const char* name : {"one", "two"}) {
        write(std::string("many/") + name + ".plan.json", kPlan);
        write(std::string("many/") + name + ".world.json", "{}");
        write(std::string("many/") + name + ".aesl", "var a\n");
    }
    const OpenedProject project = opened("many");
    EXPECT_EQ(project.plan + project.world, "");
    EXPECT_TRUE(project.scripts.empty());
}

TEST_F(FolderProjectTest, AFolderInAProjectCountsItsPathsFromThatOne) {
    write("outer/vagus.json", "{ \"format\": \"vagus-project/1\" }");
    write("outer/in/way.plan.json", kPlan);
    const OpenedProject project = opened("outer/in");
    EXPECT_EQ(project.plan, "in/way.plan.json");
    const auto path = make_project_of(project, "", test::examples());
    ASSERT_TRUE(path.ok()) << path.error().what;
    EXPECT_EQ(path.value(), (folder / "outer").string());
    EXPECT_FALSE(fs::exists(folder / "outer/in/vagus.json"));
}

TEST_F(FolderProjectTest, APlanAloneRunsInTheWorldOfItsName) {
    write("a/way.plan.json", kPlan);
    write("a/other.world.json", "{}");
    EXPECT_EQ(opened("a/way.plan.json").world, "other.world.json");  // the only one
    write("a/third.world.json", "{}");
    EXPECT_EQ(opened("a/way.plan.json").world, "");
    write("a/way.world.json", "{}");
    const OpenedProject project = opened("a/way.plan.json");
    EXPECT_EQ(project.world, "way.world.json");
    EXPECT_EQ(project.only, (std::vector<std::string>{"way.plan.json", "way.world.json"}));
}

TEST_F(FolderProjectTest, APlanAloneGetsAWorldWithACarbotThatObeysIt) {
    write("b/way.plan.json", kPlan);
    const OpenedProject project = made("b/way.plan.json");
    EXPECT_EQ(project.name, "way");
    EXPECT_EQ(project.folder, (folder / "b").string());
    EXPECT_EQ(project.plan, "way.plan.json");
    EXPECT_EQ(project.world, "way.world.json");
    EXPECT_EQ(project.scripts, std::vector<std::string>{"way.aesl"});
    EXPECT_EQ(project.help, "");  // else it says what is wrong
    const std::string world = read_file((folder / "b/way.world.json").string()).value();
    EXPECT_NE(world.find("\"carbot\""), std::string::npos) << world;
    EXPECT_EQ(read_file((folder / "b/way.plan.json").string()).value(), kPlan);
}

TEST_F(FolderProjectTest, AScriptAloneGetsAWorldWithTheRobotThatItIsFor) {
    copy("thymio/explore.aesl", "c/mine.aesl");
    write("c/way.plan.json", kPlan);  // not asked for
    const OpenedProject project = made("c/mine.aesl");
    EXPECT_EQ(project.plan, "");
    EXPECT_EQ(project.scripts, std::vector<std::string>{"mine.aesl"});
    const std::string world = read_file((folder / "c/mine.world.json").string()).value();
    EXPECT_NE(world.find("\"type\": \"thymio2\""), std::string::npos) << world;
    EXPECT_NE(world.find("\"script\": \"mine.aesl\""), std::string::npos) << world;
}

TEST_F(FolderProjectTest, APlanOverTheScriptOfAThymioGetsAThymio) {
    write("d/way.plan.json", kPlan);
    copy("thymio/drive.aesl", "d/drive.aesl");
    EXPECT_EQ(made("d").scripts, std::vector<std::string>{"drive.aesl"});
    const std::string world = read_file((folder / "d/d.world.json").string()).value();
    EXPECT_NE(world.find("\"type\": \"thymio2\""), std::string::npos) << world;
}

TEST_F(FolderProjectTest, InAFolderOfSeveralScriptsTheOneThatIsLookedAtRuns) {
    for (const char* name : {"h/one.aesl", "h/two.aesl"}) copy("thymio/explore.aesl", name);
    EXPECT_EQ(made("h", "two.aesl").scripts, std::vector<std::string>{"two.aesl"});
    EXPECT_FALSE(fs::exists(folder / "h/h.aesl"));
}

TEST_F(FolderProjectTest, WhatIsThereIsNeverReplaced) {
    write("e/way.plan.json", kPlan);
    fs::create_directories(folder / "e/way.aesl");  // a folder in the place of the script
    const auto path = make_project_of(opened("e/way.plan.json"), "", test::examples());
    ASSERT_FALSE(path.ok());
    EXPECT_NE(path.error().what.find("way.aesl: there is such a file already"), std::string::npos)
        << path.error().what;
    EXPECT_FALSE(fs::exists(folder / "e/vagus.json"));
}

TEST_F(FolderProjectTest, AFileOfAProjectLeadsToIt) {
    write("f/vagus.json", "{ \"format\": \"vagus-project/1\", \"name\": \"F\" }");
    write("f/in/way.plan.json", kPlan);
    const auto path = make_project_of(opened("f/in/way.plan.json"), "", test::examples());
    ASSERT_TRUE(path.ok()) << path.error().what;
    EXPECT_EQ(path.value(), (folder / "f").string());
}

}  // namespace
