#include "serve/script/scripts.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::string_view kPingScript =
    "<network>\n<event size=\"1\" name=\"ping\"/>\n<constant value=\"5\" name=\"LIMIT\"/>\n"
    "<node nodeId=\"1\" name=\"left\">var x = LIMIT\nonevent tick\n  x++\n  emit ping x\n</node>\n"
    "<node nodeId=\"2\" name=\"right\">var x\nonevent ping\n  x = LIMIT\n</node>\n</network>\n";

struct ScriptsTest : testing::Test {
    void SetUp() override {
        std::ofstream(root / "a.aesl") << kPingScript;
        std::ofstream(root / "plain.aesl") << "onevent tick\nemit hello\n";
        files = std::make_unique<Files>(root);
        scripts = std::make_unique<Scripts>(*files, [](const std::string& name, uint16_t) {
            aesl::Target target;
            target.name = name;
            target.bytecode_size = target.variables_size = 256;
            target.stack_size = 32;
            target.variables = {{"id", 1}};
            target.local_events = {{"tick", "every 20 ms"}};
            return target;
        });
        files->on_change([this](const std::string& path) { scripts->changed(path); });
    }
    std::string text(const std::string& doc) { return files->open(doc).value().text; }

    test::Folder root;
    std::unique_ptr<Files> files;
    std::unique_ptr<Scripts> scripts;
};

TEST_F(ScriptsTest, EveryScriptOfTheProjectIsCompiled) {
    ASSERT_EQ(scripts->parts().size(), 3u);
    EXPECT_EQ(scripts->parts()[1].doc, "a.aesl#2");
    EXPECT_EQ(scripts->parts()[1].node, "right");
    EXPECT_EQ(scripts->parts()[2].doc, "plain.aesl");
    for (const ScriptPart& part : scripts->parts()) {
        EXPECT_TRUE(scripts->compiled(part.doc)->result.ok()) << part.doc;
    }
    EXPECT_EQ(scripts->compiled("a.aesl#3"), nullptr);
    EXPECT_EQ(scripts->for_node("right", 7)->doc, "a.aesl#2");
    EXPECT_EQ(scripts->for_node("other", 7)->doc, "plain.aesl");  // of any node
}

TEST_F(ScriptsTest, WhatTheProjectNamesComesFirst) {
    std::ofstream(root / "later.aesl") << "<network><node name=\"left\">var y</node></network>";
    scripts->reread();
    EXPECT_EQ(scripts->for_node("left", 7)->doc, "a.aesl#1");
    scripts->prefer({"later.aesl"});
    EXPECT_EQ(scripts->parts()[0].doc, "later.aesl#1");
    EXPECT_EQ(scripts->for_node("left", 1)->doc, "later.aesl#1");
    EXPECT_EQ(scripts->for_node("right", 2)->doc, "a.aesl#2");
}

TEST_F(ScriptsTest, AnEditIsCompiledAtOnce) {
    ASSERT_TRUE(files->edit("a.aesl#1", 1, {{0, 3, "vra"}}, "me").ok());
    EXPECT_FALSE(scripts->compiled("a.aesl#1")->result.ok());
    EXPECT_TRUE(scripts->compiled("a.aesl#2")->result.ok());
}

TEST_F(ScriptsTest, ABrokenFileKeepsItsScriptsAndSaysWhy) {
    ASSERT_TRUE(files->replace("a.aesl", "<network><node", "me").ok());
    ASSERT_EQ(scripts->broken().size(), 1u);
    EXPECT_EQ(scripts->broken()[0].file, "a.aesl");
    EXPECT_EQ(scripts->parts().size(), 3u);
    ASSERT_TRUE(files->revert("a.aesl", "me").ok());
    EXPECT_TRUE(scripts->broken().empty());
}

TEST_F(ScriptsTest, ReferencesAreOfTheSameThing) {
    // ping in `emit ping x`, the file's event: both scripts.
    const auto ping = scripts->references("a.aesl#1", {4, 8});
    ASSERT_TRUE(ping);
    EXPECT_EQ(ping->spots.size(), 2u);
    // x is each script's own.
    EXPECT_EQ(scripts->references("a.aesl#1", {1, 5})->spots.size(), 3u);
    EXPECT_EQ(scripts->definition("a.aesl#1", {4, 13})[0].at, (aesl::Position{1, 5}));
}

TEST_F(ScriptsTest, RenamingAnEventChangesEveryScriptAndTheFile) {
    const auto renamed = scripts->rename("a.aesl#1", {4, 8}, "pong", "me");
    ASSERT_TRUE(renamed.ok()) << renamed.error().what;
    EXPECT_EQ(renamed.value(), 3u);
    EXPECT_THAT(text("a.aesl"), HasSubstr("<event size=\"1\" name=\"pong\"/>"));
    EXPECT_THAT(text("a.aesl#1"), HasSubstr("emit pong x"));
    EXPECT_THAT(text("a.aesl#2"), HasSubstr("onevent pong"));
    EXPECT_TRUE(scripts->compiled("a.aesl#2")->result.ok());
}

TEST_F(ScriptsTest, RenamingAConstantAndAVariable) {
    ASSERT_TRUE(scripts->rename("a.aesl#2", {3, 8}, "MOST", "me").ok());
    EXPECT_THAT(text("a.aesl#1"), HasSubstr("var x = MOST"));
    ASSERT_TRUE(scripts->rename("a.aesl#1", {1, 5}, "count", "me").ok());
    EXPECT_EQ(text("a.aesl#1"), "var count = MOST\nonevent tick\n  count++\n  emit ping count\n");
    EXPECT_THAT(text("a.aesl#2"), HasSubstr("var x\n"));
}

TEST_F(ScriptsTest, WhatCannotBeRenamedSaysWhy) {
    EXPECT_THAT(scripts->rename("a.aesl#1", {2, 10}, "tock", "me").error().what,
                HasSubstr("belongs to the node"));
    EXPECT_THAT(scripts->rename("a.aesl#1", {4, 8}, "x", "me").error().what, HasSubstr("declares"));
    EXPECT_THAT(scripts->rename("a.aesl#1", {4, 8}, "while", "me").error().what,
                HasSubstr("is no name"));
    EXPECT_EQ(text("a.aesl"), kPingScript);
}

TEST_F(ScriptsTest, EventsAndConstantsComeAndGo) {
    ASSERT_TRUE(scripts->add("a.aesl", "event", "pong", 3, "me").ok());
    EXPECT_FALSE(scripts->add("a.aesl", "event", "pong", 3, "me").ok());
    EXPECT_EQ(scripts->common("a.aesl")->events.size(), 2u);
    ASSERT_TRUE(scripts->move("a.aesl", "event", "pong", 0, "me").ok());
    EXPECT_EQ(scripts->common("a.aesl")->events[0].name, "pong");
    ASSERT_TRUE(scripts->change("a.aesl", "constant", "LIMIT", "LIMIT", 9, "me").ok());
    EXPECT_EQ(scripts->common("a.aesl")->constants[0].value, 9);
    ASSERT_TRUE(scripts->remove("a.aesl", "event", "pong", "me").ok());
    EXPECT_FALSE(scripts->remove("a.aesl", "event", "pong", "me").ok());
    EXPECT_THAT(scripts->add("plain.aesl", "event", "e", 0, "me").error().what,
                HasSubstr("a plain script declares nothing"));
}

}  // namespace
}  // namespace vagus::serve
