#include "session/project_file.hpp"
#include "base/test_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/file.hpp"
#include "base/test_places.hpp"

namespace vagus::session {
namespace {

namespace fs = std::filesystem;
using Values = std::vector<std::pair<std::string, std::string>>;

std::string with(const std::string& members) {
    return "{ \"format\": \"vagus-project/1\"" + (members.empty() ? "" : ", " + members) + " }";
}

std::string error_of(const std::string& text) {
    const auto read = read_project_file(text, "vagus.json");
    return read.ok() ? "no error" : read.error().what;
}

TEST(ProjectFile, ReadsEveryKey) {
    const ProjectFile project = read_project_file(R"({
  "format": "vagus-project/1",
  "name": "Follow a wall",
  "help": "Find a wall.",
  "plan": "WallFollow.plan.json",
  "scripts": ["../carbot/carbot.aesl", "own.aesl"],
  "world": "hall.world.json",
  "toolboxes": ["light.toolbox.json"],
  "target": "tcp:localhost:33333",
  "start": { "plan": true, "set": { "walldist": 30, "speed": 1.50, "on": true, "who": "it" } },
  "safe_stop": { "arm": { "set": { "speed": 0 } } },
  "when_alone": "stop",
  "x": { "anything": [1] }
})",
                                                  "there/vagus.json")
                                    .value();
    EXPECT_EQ(project.name, "Follow a wall");
    EXPECT_EQ(project.help, "Find a wall.");
    EXPECT_EQ(project.plan, "WallFollow.plan.json");
    EXPECT_EQ(project.scripts, (std::vector<std::string>{"../carbot/carbot.aesl", "own.aesl"}));
    EXPECT_EQ(project.world, "hall.world.json");
    EXPECT_EQ(project.toolboxes, (std::vector<std::string>{"light.toolbox.json"}));
    EXPECT_EQ(project.target, "tcp:localhost:33333");
    EXPECT_TRUE(project.start_plan);
    EXPECT_EQ(project.start_set,
              (Values{{"walldist", "30"}, {"speed", "1.50"}, {"on", "true"}, {"who", "it"}}));
    EXPECT_EQ(project.safe_stop, (toolbox::SafeStop{{"arm", {{{"speed", {0}}}, {}}}}));
    EXPECT_TRUE(project.stops_alone);
    EXPECT_EQ(project.path_of(project.scripts[0]), "carbot/carbot.aesl");
}

TEST(ProjectFile, OnlyTheFormatIsNeeded) {
    const ProjectFile project = read_project_file(with(""), "vagus.json").value();
    EXPECT_EQ(project.target, "sim");
    EXPECT_FALSE(project.start_plan);
    EXPECT_EQ(project.plan, "");
    EXPECT_EQ(project.safe_stop, toolbox::SafeStop());
    EXPECT_FALSE(project.stops_alone);
    EXPECT_EQ(error_of("{}"), "vagus.json:1:1: the project has no \"format\"; add it");
}

TEST(ProjectFile, NamesWhatIsWrongAndWhere) {
    EXPECT_EQ(error_of(with("\n\"wrold\": \"a\"")),
              "vagus.json:2:1: the project has the unknown key \"wrold\"; did you mean \"world\"?");
    EXPECT_EQ(error_of(with("\"start\": { \"plna\": true }")),
              "vagus.json:1:43: \"start\" has the unknown key \"plna\"; did you mean \"plan\"?");
    EXPECT_EQ(error_of(with("\"plan\": 1")),
              "vagus.json:1:40: \"plan\" of the project is 1; write a string");
    EXPECT_EQ(error_of(with("\"when_alone\": \"stpo\"")),
              "vagus.json:1:46: \"when_alone\" of the project is \"stpo\"; did you mean \"stop\"?");
    EXPECT_EQ(error_of(with("\"safe_stop\": { \"arm\": 0 }")),
              "vagus.json:1:54: \"arm\" in \"safe_stop\" is 0; it must be an object: { … }");
    EXPECT_EQ(error_of(with("\"scripts\": [1]")),
              "vagus.json:1:44: \"scripts\" of the project holds paths in quotes, not a whole "
              "number");
    EXPECT_EQ(error_of(with("\"scripts\": [\"a\", \"a\"]")),
              "vagus.json:1:49: \"scripts\" of the project names \"a\" twice; keep one of them");
    EXPECT_EQ(
        error_of(with("\"world\": \"\"")),
        "vagus.json:1:41: \"world\" of the project: expected a path of 1 to 4096 bytes; leave "
        "the key out if there is no such file");
    EXPECT_EQ(error_of(with("\"plan\": \"p\", \"start\": { \"set\": { \"a\": [1] } }")),
              "vagus.json:1:70: the value of \"a\" in \"set\" is an array; write a number, a text, "
              "true or false");
    EXPECT_EQ(error_of(with("\"start\": { \"plan\": true }")),
              "vagus.json:1:41: \"start\" begins the plan, but the project has no \"plan\"; name "
              "one, or write \"plan\": false");
    EXPECT_EQ(error_of(with("\"target\": \"usb\"")).substr(0, 68),
              "vagus.json:1:42: \"target\" of the project: expected \"sim\" or a target");
}

TEST(ProjectFile, AnotherFormatIsCalledThat) {
    EXPECT_EQ(error_of("{ \"format\": \"vagus-world/1\" }"),
              "vagus.json:1:13: this is a world file (vagus-world/1); a project file "
              "(vagus-project/1) was expected");
    EXPECT_EQ(error_of("{ \"format\": \"vagus-project/2\" }"),
              "vagus.json:1:13: \"format\" is \"vagus-project/2\"; write \"vagus-project/1\", the "
              "only one that this program reads here");
}

TEST(ProjectFile, IsLimited) {
    std::string paths;
    std::string set;
    for (size_t i = 0; i <= kProjectPathsMax; ++i) {
        paths += (i == 0 ? "\"" : ", \"") + std::to_string(i) + "\"";
        set += (i == 0 ? "\"v" : ", \"v") + std::to_string(i) + "\": 1";
    }
    EXPECT_EQ(error_of(with("\"scripts\": [" + paths + "]")),
              "vagus.json:1:43: \"scripts\" of the project: expected at most 256 paths, found 257; "
              "remove some");
    EXPECT_EQ(error_of(with("\"start\": { \"set\": {" + set + "} }")),
              "vagus.json:1:50: \"set\" of \"start\": expected at most 256 variables, found 257; "
              "remove some");
    EXPECT_EQ(
        error_of(with("\"name\": \"" + std::string(kProjectBytesMax, 'x') + "\"")).substr(0, 20),
        "vagus.json: has 1048");
    const std::string longest(kProjectPathBytesMax, 'p');
    EXPECT_EQ(error_of(with("\"world\": \"" + longest + "\"")), "no error");
    EXPECT_NE(error_of(with("\"world\": \"" + longest + "p\"")), "no error");
}

// A project in a folder of its own: in/vagus.json and in/w.world.json, beside it out.aesl.
class OpenProject : public testing::Test {
protected:
    OpenProject() {
        fs::create_directory(folder_ / "in");
        write("in/w.world.json", "{}");
        write("out.aesl", "");
    }

    void write(const std::string& name, const std::string& text) const {
        ASSERT_TRUE(write_file((folder_ / name).string(), text).ok());
    }
    std::string in() const { return (folder_ / "in").string(); }

    test::Folder folder_;
};

TEST_F(OpenProject, AFolderIsOpenedByItsVagusJson) {
    write("in/vagus.json", with("\"world\": \"w.world.json\""));
    const ProjectFile project = open_project(in()).value();
    EXPECT_EQ(project.path_of(project.world), in() + "/w.world.json");
    EXPECT_TRUE(open_project(in() + "/vagus.json").ok());
    EXPECT_EQ(open_project(folder_.string()).error().code, Code::NotFound);
}

TEST_F(OpenProject, FilesMustBeThereAndInside) {
    write("in/vagus.json", with("\"world\": \"v.world.json\""));
    EXPECT_EQ(open_project(in()).error().what,
              in() + "/vagus.json:1:41: \"world\": there is no file " + in() +
                  "/v.world.json; the path counts from the folder of this file");
    write("in/vagus.json", with("\"scripts\": [\"../out.aesl\"]"));
    EXPECT_EQ(open_project(in()).error().code, Code::Refused);
    write("vagus.json", with(""));
    EXPECT_TRUE(open_project(in()).ok()) << "the outermost project is the border";
}

TEST_F(OpenProject, EveryExampleIsOne) {
    size_t opened = 0;
    for (fs::recursive_directory_iterator at(test::examples()), end; at != end; ++at) {
        const fs::path& path = at->path();
        // What somebody who tried an example has left there: versions that were deployed.
        if (path.filename() == ".vagus") at.disable_recursion_pending();
        if (path.filename() != "vagus.json") continue;
        const auto project = open_project(path.parent_path().string());
        EXPECT_TRUE(project.ok()) << project.error().what;
        ++opened;
    }
    EXPECT_EQ(opened, 17u);
}

}  // namespace
}  // namespace vagus::session
