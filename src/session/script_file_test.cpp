#include "session/script_file.hpp"

#include <gmock/gmock.h>

namespace vagus::session {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> names(const aesl::CommonDefinitions& common) {
    std::vector<std::string> list;
    for (const aesl::GlobalEvent& event : common.events) list.push_back(event.name);
    return list;
}

TEST(ScriptFile, AFileThatBeginsLikeXmlIsAProject) {
    const auto file = read_script_file(
        "\n <!DOCTYPE aesl-source><network><event name=\"go\" size=\"2\"/>"
        "<node name=\"rover\" nodeId=\"3\">var x</node></network>",
        "a.aesl");
    ASSERT_TRUE(file.ok()) << file.error().what;
    EXPECT_FALSE(file.value().plain);
    EXPECT_THAT(names(file.value().project.common), ElementsAre("go"));
    EXPECT_EQ(file.value().project.scripts.at(0).node, "rover");
}

TEST(ScriptFile, ABrokenProjectIsAnErrorThatNamesTheFile) {
    const auto file = read_script_file("<network><node>", "a.aesl");
    ASSERT_FALSE(file.ok());
    EXPECT_THAT(file.error().what, HasSubstr("a.aesl"));
}

TEST(ScriptFile, AnythingElseIsOnePlainScript) {
    const auto file = read_script_file("var x = 1 < 2", "a.aesl");
    ASSERT_TRUE(file.ok());
    EXPECT_TRUE(file.value().plain);
    EXPECT_EQ(file.value().project.scripts.at(0).source, "var x = 1 < 2");
}

TEST(ScriptFile, EmitDeclaresAnEventBehindThoseOfTheProjects) {
    const aesl::CommonDefinitions common{{{"go", 2}}, {}};
    const aesl::Target target{
        .name = "n", .variables = {}, .local_events = {{"timer", ""}}, .natives = {}};
    const auto wider = with_emitted(
        common, "onevent timer\nemit found 3\n_emit go\nemit timer\nemit found", target);
    EXPECT_THAT(names(wider), ElementsAre("go", "found"));
    EXPECT_EQ(wider.events[0].size, 2);
    EXPECT_EQ(wider.events[1].size, std::nullopt);
}

TEST(ScriptFile, WordsInCommentsDeclareNothing) {
    const auto wider = with_emitted(
        {}, "# emit a\n#* emit b\n emit c *#\nvar emitter\ncall emit.d()\nemit 3\n#* emit e", {});
    EXPECT_THAT(names(wider), IsEmpty());
}

}  // namespace
}  // namespace vagus::session
