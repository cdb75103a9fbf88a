#include "aesl/project.hpp"

#include <gtest/gtest.h>

#include "base/file.hpp"
#include "base/test_places.hpp"

namespace vagus::aesl {
namespace {

// The worked example of section 5.2, byte for byte.
std::string rover_file() {
    return read_file(test::testdata("projects/rover.aesl")).value();
}

std::string error_of_project(std::string_view xml) {
    const auto parsed = parse_project(xml, "p.aesl");
    return parsed.ok() ? "no error" : parsed.error().what;
}

Project parsed(std::string_view xml) {
    return parse_project(xml, "p.aesl").value();
}

std::string network(std::string_view inside) {
    return "<network>\n" + std::string(inside) + "</network>\n";
}

TEST(Project, ReadsTheWorkedExample) {
    const Project project = parsed(rover_file());
    ASSERT_EQ(project.common.events.size(), 2u);
    EXPECT_EQ(project.common.events[1].name, "status");
    EXPECT_EQ(project.common.events[1].size, 2);
    ASSERT_EQ(project.common.constants.size(), 2u);
    EXPECT_EQ(project.common.constants[1].name, "DRIFT");
    EXPECT_EQ(project.common.constants[1].value, -3);
    EXPECT_EQ(project.keywords, "true");
    ASSERT_EQ(project.scripts.size(), 1u);
    const Script& script = project.scripts[0];
    EXPECT_EQ(script.node, "rover");
    EXPECT_EQ(script.node_id, 1);
    EXPECT_EQ(script.first_line, 20);
    EXPECT_TRUE(script.source.starts_with("var speed = 0\nvar ticks = 0\n\ntimer.period"));
    EXPECT_NE(script.source.find("if speed < 100 and ticks > 2 then\n\tspeed += DRIFT & 0xf"),
              std::string::npos);
    EXPECT_TRUE(script.source.ends_with("onevent setspeed\nspeed = args[0]\n"));
    EXPECT_TRUE(script.plugins.starts_with("<toolsPlugins>\n  <ThymioVisual"));
}

TEST(Project, WritingTheWorkedExampleChangesNoByte) {
    EXPECT_EQ(format_project(parsed(rover_file())), rover_file());
}

TEST(Project, ChildrenMayComeInAnyOrder) {
    const Project project =
        parsed(network("<node name=\"a\">emit e X</node>"
                       "<constant name=\"X\" value=\"1\"/>"
                       "<event name=\"e\" size=\"1\"/>"));
    EXPECT_EQ(project.scripts[0].source, "emit e X");
    EXPECT_EQ(project.scripts[0].node_id, 0);
    EXPECT_EQ(project.common.events[0].name, "e");
    EXPECT_EQ(project.common.constants[0].value, 1);
}

TEST(Project, SourceIsAllTextAndCdataOfTheNode) {
    const Project project =
        parsed(network("<node name=\"a\">x = 1<!-- no text -->\r\n<![CDATA[if x < 2 & 3]]>&#10;"
                       "&lt;<p>not this</p> \n</node>"));
    EXPECT_EQ(project.scripts[0].source, "x = 1\nif x < 2 & 3\n< \n");
    EXPECT_EQ(project.scripts[0].plugins, "<p>not this</p>");
}

TEST(Project, FirstLineIsWhereTheStartTagEnds) {
    const Project project = parsed(
        "<network><node\n name=\"a>\n\"\n>x</node>\n<node name='b'>y"
        "</node></network>");
    EXPECT_EQ(project.scripts[0].node, "a> ") << "XML reads a line feed in an attribute as space";
    EXPECT_EQ(project.scripts[0].first_line, 4);
    EXPECT_EQ(project.scripts[1].first_line, 5);
}

TEST(Project, AnEventWithoutSizeHasNone) {
    EXPECT_EQ(parsed(network("<event name=\"e\"/>")).common.events[0].size, std::nullopt);
}

TEST(Project, UuidsOfTheForkAreKept) {
    constexpr std::string_view kId = "{c8a4bd06-1d5e-4f6b-9d2b-d1a1b2c3d4e5}";
    const Project project =
        parsed(network("<node name=\"a\" nodeId=\"" + std::string(kId) + "\">x</node>"));
    EXPECT_EQ(project.scripts[0].node_id, 0);
    EXPECT_EQ(project.scripts[0].uuid, kId);
    EXPECT_NE(format_project(project).find(kId), std::string::npos);
}

TEST(Project, WritingIsStableWhateverWasRead) {
    const std::string odd = network(
        "<future a=\"1&amp;&quot;\"><b/>text</future><other/>\n"
        "<node nodeId=\"7\" name=\"a--&lt;&#9;-\">]]&gt; \"quotes\" &#13;\n<state "
        "x='y'/>tail</node>"
        "<node name=\"empty\"/><event name=\"no&amp;size\"/><keywords flag=\"false\"/>");
    const std::string once = format_project(parsed(odd));
    const Project again = parsed(once);
    EXPECT_EQ(format_project(again), once);
    EXPECT_EQ(again.scripts[0].node, "a--<\t-");
    EXPECT_EQ(again.scripts[0].source, "]]> \"quotes\" \r\ntail");
    EXPECT_EQ(again.scripts[0].plugins, "<state x=\"y\"/>");
    EXPECT_EQ(again.others, "<future a=\"1&amp;&quot;\"><b/>text</future>\n<other/>\n");
}

TEST(Project, StrictAboutValues) {
    EXPECT_EQ(error_of_project(network("<constant name=\"X\"/>")),
              "p.aesl:2:1: the <constant> \"X\" has no value; add value=\"…\"");
    EXPECT_EQ(error_of_project(network(" <constant name=\"X\" value=\"1a\"/>")),
              "p.aesl:2:2: \"value\" of the <constant> \"X\" is \"1a\"; write a whole number from "
              "-2147483648 to 2147483647");
    for (const std::string bad : {"", " 1", "0x10", "1.5", "+1", "99999999999999999999"})
        EXPECT_NE(error_of_project(network("<constant name=\"X\" value=\"" + bad + "\"/>")),
                  "no error")
            << bad;
    EXPECT_EQ(error_of_project(network("<event size=\"1\"/>")),
              "p.aesl:2:1: a <event> has no name; add name=\"…\"");
    EXPECT_EQ(error_of_project(network("<event name=\"e\" size=\"-1\"/>")),
              "p.aesl:2:1: \"size\" of the <event> \"e\" is \"-1\"; write a whole number from 0 to "
              "258");
    EXPECT_EQ(
        error_of_project(network("<node name=\"a\" nodeId=\"65536\"/>")),
        "p.aesl:2:1: \"nodeId\" of the <node> \"a\" is \"65536\"; write a whole number from 0 "
        "to 65535");
}

TEST(Project, EventsCarryAtMost258Words) {
    EXPECT_EQ(error_of_project(network("<event name=\"e\" size=\"258\"/>")), "no error");
    EXPECT_NE(error_of_project(network("<event name=\"e\" size=\"259\"/>")), "no error");
}

TEST(Project, NamesHaveAtMost255Bytes) {
    const auto named = [](size_t size) {
        return network("<event name=\"" + std::string(size, 'e') + "\"/>");
    };
    EXPECT_EQ(error_of_project(named(255)), "no error");
    EXPECT_EQ(error_of_project(named(256)),
              "p.aesl:2:1: a <event> has a name of 256 bytes; use at most 255");
}

TEST(Project, BrokenXmlIsPlacedAndMended) {
    constexpr std::string_view kFix =
        "; in a script write &lt; for < and &amp; for &, or put the script into <![CDATA[ … ]]>";
    EXPECT_EQ(error_of_project("<network>\n<node name=\"a\">é & 1</node></network>"),
              "p.aesl:2:18: this & begins no character that XML knows" + std::string(kFix));
    EXPECT_EQ(error_of_project("<network>\n<node name=\"a\">if x < 2</node></network>"),
              "p.aesl:2:21: this < begins no whole tag" + std::string(kFix));
    EXPECT_EQ(
        error_of_project("<network>\n<node name=\"a\">if x <y</node></network>").substr(0, 12),
        "p.aesl:2:21:");
    EXPECT_NE(error_of_project("<network>\n<node name=\"a\">").find("this is not XML"),
              std::string::npos);
    EXPECT_NE(error_of_project("<network></nodes>").find("this is not XML"), std::string::npos);
    EXPECT_EQ(error_of_project(""),
              "p.aesl:1:1: the file has no element; a project is a <network>");
    EXPECT_EQ(error_of_project("<net/>"),
              "p.aesl:1:1: the file holds a <net>; a project is a <network>");
    EXPECT_EQ(error_of_project("<network/>\n <network/>"),
              "p.aesl:2:2: a second outermost element, <network>; move it into the <network> or "
              "remove it");
    EXPECT_EQ(error_of_project("<network/>x"),
              "p.aesl:1:1: there is text outside of the <network>; remove it");
    EXPECT_EQ(error_of_project("<network>x = 1</network>"),
              "p.aesl:1:1: the <network> has text outside of its elements; move it into a <node> "
              "or remove it");
}

TEST(Project, OnlyXmlCharactersAreRead) {
    EXPECT_EQ(error_of_project("<network>\n\xff</network>"),
              "p.aesl:2:1: this byte is not UTF-8; save the file as UTF-8");
    EXPECT_EQ(error_of_project("<network>\x01</network>"),
              "p.aesl:1:10: XML cannot contain a control character; remove it");
    EXPECT_NE(error_of_project("<network><node name=\"a\"><![CDATA[\x1f]]></node></network>"),
              "no error");
    EXPECT_EQ(error_of_project(std::string_view("<network/>\0", 11)).substr(0, 12), "p.aesl:1:11:");
    for (const std::string bad : {"&#0;", "&#1;", "&#xd800;", "&nbsp;", "&#;", "&#x;", "&lt"})
        EXPECT_NE(error_of_project(network("<node name=\"a\">" + bad + "</node>")), "no error")
            << bad;
    EXPECT_EQ(error_of_project(network("<!-- & --><node name=\"a\">&#xe9;<![CDATA[ & ]]></node>")),
              "no error");
    EXPECT_EQ(error_of_project("\xef\xbb\xbf<network/>"), "no error");
}

TEST(Project, DepthAndSizeAreLimited) {
    const auto nested = [](size_t depth) {
        std::string xml;
        for (size_t i = 1; i < depth; ++i) xml += "<a>";
        for (size_t i = 1; i < depth; ++i) xml += "</a>";
        return "<network>" + xml + "</network>";
    };
    EXPECT_EQ(error_of_project(nested(kProjectDepthMax)), "no error");
    EXPECT_NE(error_of_project(nested(kProjectDepthMax + 1)).find("more than 100 deep"),
              std::string::npos);
    EXPECT_NE(error_of_project(nested(500'000)).find("more than 100 deep"), std::string::npos);
    const auto padded = [](size_t size) { return "<network/>" + std::string(size - 10, ' '); };
    EXPECT_EQ(error_of_project(padded(kProjectBytesMax)), "no error");
    EXPECT_NE(error_of_project(padded(kProjectBytesMax + 1)).find("larger than 8 MB"),
              std::string::npos);
}

TEST(Project, EachNodeGetsAScriptOfItsName) {
    const Project project =
        parsed(network("<node name=\"a\" nodeId=\"1\">1</node>"
                       "<node name=\"b\">2</node>"
                       "<node name=\"a\" nodeId=\"3\">3</node>"));
    const auto of = [&project](std::vector<NodeName> nodes) { return scripts_for(project, nodes); };
    EXPECT_EQ(of({{"a", 3}}), std::vector<int>{2}) << "the id is preferred";
    EXPECT_EQ(of({{"a", 9}}), std::vector<int>{0}) << "else the first of the name";
    EXPECT_EQ(of({{"a", 9}, {"a", 1}}), (std::vector<int>{2, 0})) << "whose id fits chooses first";
    EXPECT_EQ(of({{"c", 0}, {"b", 7}}), (std::vector<int>{-1, 1}));
    EXPECT_EQ(of({{"a", 7}, {"a", 8}, {"a", 9}}), (std::vector<int>{0, 2, 0}))
        << "when all are given away, the first again";
}

}  // namespace
}  // namespace vagus::aesl
