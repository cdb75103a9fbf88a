#include "aesl/project_text.hpp"

#include <gtest/gtest.h>

#include "aesl/project.hpp"

namespace vagus::aesl {
namespace {

constexpr std::string_view kFile =
    "<!DOCTYPE aesl-source>\n<network>\n\n<!--events-->\n    <event size=\"2\" name=\"ping\"/>\n\n"
    "<!--node a-->\n<node nodeId=\"1\" name=\"a\">var x = 1\nif x &lt; 2 &amp;&amp; x>0 then\nend\n"
    "<toolsPlugins><t a=\"&gt;\">y</t></toolsPlugins></node>\n<node name='b'/>\n"
    "<node name=\"c\"><![CDATA[if 1 < 2 then end]]></node>\n</network>\n";

TEST(ProjectText, ScriptsReadAsTheCompilerReadsThem) {
    const ProjectText file(kFile);
    const auto project = parse_project(kFile, "a.aesl");
    ASSERT_TRUE(project.ok()) << project.error().what;
    ASSERT_EQ(file.scripts(), 3u);
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(file.script(i), project.value().scripts[i].source);
}

TEST(ProjectText, AChangeTouchesOnlyItsBytes) {
    // "var x = 1": the 1 is at 8; what was written as && and > stays as it was written.
    const std::string changed = ProjectText(kFile).replace(0, 8, 9, "a<b");
    std::string expected(kFile);
    expected.replace(expected.find("= 1") + 2, 1, "a&lt;b");
    EXPECT_EQ(changed, expected);
    EXPECT_EQ(ProjectText(changed).script(0), "var x = a<b\nif x < 2 && x>0 then\nend\n");
}

TEST(ProjectText, ReferencesCountAsOneCharacter) {
    // "if x < 2": x at 13, < at 15.
    EXPECT_EQ(ProjectText(kFile).script(0).substr(15, 1), "<");
    const std::string changed = ProjectText(kFile).replace(0, 15, 16, ">");
    EXPECT_NE(changed.find("if x &gt; 2 &amp;&amp; x>0"), std::string::npos);
}

TEST(ProjectText, TextGoesIntoAnEmptyElementAndIntoCdata) {
    const std::string filled = ProjectText(kFile).replace(1, 0, 0, "emit ping");
    EXPECT_NE(filled.find("<node name='b'>emit ping</node>"), std::string::npos);
    const std::string cdata = ProjectText(kFile).replace(2, 3, 4, "]]>");
    EXPECT_EQ(ProjectText(cdata).script(2), "if ]]> < 2 then end");
}

TEST(ProjectText, AtTheEndOfAScript) {
    const size_t end = ProjectText(kFile).script(0).size();
    const std::string changed = ProjectText(kFile).replace(0, end, end, "# end");
    EXPECT_NE(changed.find("end\n# end<toolsPlugins>"), std::string::npos);
}

TEST(ProjectText, LineEndsAreThoseOfTheFile) {
    const std::string text =
        "<network>\r\n<node name=\"a\">var x\r\nx=1\r\n</node>\r\n</network>\r\n";
    EXPECT_EQ(ProjectText(text).script(0), "var x\nx=1\n");
    EXPECT_EQ(ProjectText(text).replace(0, 6, 6, "var y\n"),
              "<network>\r\n<node name=\"a\">var x\r\nvar y\r\nx=1\r\n</node>\r\n</network>\r\n");
}

// A file of the largest size: what looked to its end at each character would take minutes.
TEST(ProjectText, ALongScriptIsReadInOnePass) {
    std::string source;
    while (source.size() < 4'000'000) source += "# nothing that ends an entity\n";
    const std::string text = "<network>\n<node name=\"a\">" + source + "</node>\n</network>\n";
    EXPECT_EQ(ProjectText(text).script(0), source);
    EXPECT_EQ(ProjectText(text).replace(0, 0, 1, "#").size(), text.size());
}

TEST(ProjectText, DefinitionsComeChangeMoveAndGo) {
    const std::string two = ProjectText(kFile).add({"event", "pong", 0});
    EXPECT_NE(two.find("    <event size=\"2\" name=\"ping\"/>\n    <event size=\"0\" "
                       "name=\"pong\"/>\n"),
              std::string::npos);
    const std::string moved = *ProjectText(two).move("event", "pong", 0);
    EXPECT_LT(moved.find("pong"), moved.find("ping"));
    const std::string changed = *ProjectText(two).change("event", "ping", {"event", "pang", 3});
    EXPECT_NE(changed.find("<event size=\"3\" name=\"pang\"/>"), std::string::npos);
    EXPECT_EQ(*ProjectText(two).remove("event", "pong"), kFile);
    EXPECT_FALSE(ProjectText(kFile).remove("event", "pong"));
    const std::string constant = ProjectText(kFile).add({"constant", "N", -5});
    EXPECT_EQ(parse_project(constant, "a").value().common.constants.at(0).value, -5);
}

TEST(ProjectText, TheFirstDefinitionOfAFileStandsAtItsBeginning) {
    const std::string text = "<network>\n<node name=\"a\"></node>\n</network>\n";
    EXPECT_EQ(ProjectText(text).add({"event", "e", 1}),
              "<network>\n    <event size=\"1\" name=\"e\"/>\n<node name=\"a\"></node>\n"
              "</network>\n");
}

}  // namespace
}  // namespace vagus::aesl
