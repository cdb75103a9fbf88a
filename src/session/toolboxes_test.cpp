#include "session/toolboxes.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "base/file.hpp"
#include "base/test_places.hpp"
#include "toolbox/builtin.hpp"
#include "toolbox/load.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::session {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kExamples = test::examples();

// ---- what is built in fits the scripts that come with it ----

class Projects : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Projects, DeclareTheEventsOfTheirToolbox) {
    const auto& [toolbox, project] = GetParam();
    const std::string path = (kExamples / "carbot" / toolbox).string();
    const auto read = [&project = project](const std::string&) {
        return read_project_events((kExamples / project).string());
    };
    const Result<toolbox::ToolboxFile> file =
        toolbox::read_toolbox(read_file(path).value(), path, read);
    EXPECT_TRUE(file.ok()) << file.error().what;
}

INSTANTIATE_TEST_SUITE_P(Toolboxes, Projects,
                         testing::Values(std::pair("drive.toolbox.json", "carbot/carbot.aesl"),
                                         std::pair("drive.toolbox.json", "thymio/drive.aesl"),
                                         std::pair("carbot.toolbox.json", "carbot/carbot.aesl")));

TEST(Toolboxes, CarbotsTemplatesUseEventsOfItsProject) {
    const auto events = read_project_events((kExamples / "carbot/carbot.aesl").string());
    ASSERT_TRUE(events.ok()) << events.error().what;
    const toolbox::Parts parts;
    run::CodeLibrary library;
    toolbox::add_builtin(library, parts);
    for (const plan::Template& one : library.templates().find("carbot")->templates) {
        EXPECT_FALSE(one.bus.events.empty()) << one.name;
        for (const std::string& event : one.bus.events) {
            EXPECT_TRUE(events.value().contains(event)) << one.name << ": " << event;
        }
    }
}

// ---- toolboxes of a user ----

class OwnToolboxes : public testing::Test {
protected:
    std::string write(const std::string& name, std::string_view text) const {
        EXPECT_TRUE(write_file((folder_ / name).string(), text).ok());
        return (folder_ / name).string();
    }
    std::string error_of(const std::vector<std::string>& files) {
        const Status added = add_toolboxes(library_, parts_, files);
        return added.ok() ? "no error" : added.error().what;
    }

    test::Folder folder_;
    toolbox::Parts parts_;
    run::CodeLibrary library_;
};

constexpr std::string_view kLamp = R"({
  "format": "vagus-toolbox/1", "name": "lamp", "project": "lamp.aesl",
  "templates": { "Shine": { "kind": "actor", "node": "lamp", "start": "lamp.on",
    "states": { "Done": { "event": "lamp.done" } } } }
})";
constexpr std::string_view kProject = R"(<!DOCTYPE aesl-source>
<network>
<event size="1" name="lamp.on"/>
<event size="1" name="lamp.done"/>
<node nodeId="1" name="lamp">onevent lamp.on
</node>
</network>
)";

TEST_F(OwnToolboxes, AreFoundByTheirName) {
    write("lamp.aesl", kProject);
    EXPECT_EQ(error_of({write("lamp.toolbox.json", kLamp)}), "no error");
    ASSERT_NE(library_.templates().find("lamp"), nullptr);
    EXPECT_EQ(library_.templates().find("lamp")->templates.front().name, "Shine");
    EXPECT_NE(library_.templates().find("core"), nullptr);
}

TEST_F(OwnToolboxes, NeedTheirProject) {
    const std::string path = write("lamp.toolbox.json", kLamp);
    EXPECT_THAT(error_of({path}), HasSubstr(path + ":2:59: \"project\" cannot be used: "));
}

TEST_F(OwnToolboxes, NeedTheirEvents) {
    std::string project(kProject);
    project.replace(project.find("lamp.done"), 9, "lamp.gone");
    write("lamp.aesl", project);
    const std::string path = write("lamp.toolbox.json", kLamp);
    EXPECT_THAT(error_of({path}), HasSubstr(path + ":4:36: the event \"lamp.done\""));
}

TEST_F(OwnToolboxes, CannotHaveANameThatIsTaken) {
    write("lamp.aesl", kProject);
    const std::string path = write("lamp.toolbox.json", kLamp);
    EXPECT_EQ(error_of({path, path}), "the toolbox " + path +
                                          ": there is a toolbox named \"lamp\" already; give this "
                                          "one another name");
}

// "Wait" is found in core, by every plan and before anything else.
TEST_F(OwnToolboxes, CannotHaveATemplateThatNoPlanCouldUse) {
    write("lamp.aesl", kProject);
    std::string text(kLamp);
    text.replace(text.find("Shine"), 5, "Wait");
    const std::string path = write("lamp.toolbox.json", text);
    EXPECT_EQ(error_of({path}), "the toolbox " + path +
                                    ": its template \"Wait\" in line 3 can never be used: the "
                                    "toolbox core has one of that name, and plans look there "
                                    "first; give it another name");
}

TEST_F(OwnToolboxes, ThatDoNotExistAreAnError) {
    const std::string path = (folder_ / "none.toolbox.json").string();
    EXPECT_THAT(error_of({path}), HasSubstr(path));
    EXPECT_THAT(error_of({"lamp.json"}), HasSubstr("expected a file NAME.toolbox.json or a shared "
                                                   "library NAME.so"));
}

}  // namespace
}  // namespace vagus::session
