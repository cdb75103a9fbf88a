// What pages do with texts: edits and what they lack, saving, the disk, renamed and deleted files.
#include <gmock/gmock.h>

#include "serve/edit/test_page.hpp"

namespace vagus::serve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(EditTest, ATextIsOpenedChangedSavedAndTakenBack) {
    write("note.txt", "hello\n");
    enter();
    const Json opened = ask("doc.open", {{"doc", "note.txt"}});
    EXPECT_EQ(opened, (Json{{"epoch", "e1"},
                            {"text", "hello\n"},
                            {"version", 1},
                            {"language", "text"},
                            {"unsaved", false},
                            {"ends", "lf"}}));
    const Json edited = ask("doc.edit", edit_of("note.txt", 1,
                                                {{{"from", 0}, {"to", 1}, {"text", "J"}},
                                                 {{"from", 4}, {"to", 5}, {"text", "y"}}}));
    EXPECT_EQ(edited, (Json{{"version", 2}}));
    const Json seen = document("doc", {{"doc", "note.txt"}});
    EXPECT_EQ(seen, (Json{{"epoch", "e1"},
                          {"version", 2},
                          {"language", "text"},
                          {"ends", "lf"},
                          {"unsaved", true},
                          {"by", "page"},
                          {"gone", false},
                          {"disk", false}}));
    EXPECT_EQ(text("note.txt"), "Jelly\n");
    EXPECT_EQ(on_disk("note.txt"), "hello\n");
    EXPECT_EQ(ask("doc.save", {{"doc", "note.txt"}})["version"], 2);
    EXPECT_EQ(on_disk("note.txt"), "Jelly\n");
    EXPECT_THAT(saved, ElementsAre("note.txt"));
    edit("note.txt", 0, 6, "");
    EXPECT_EQ(ask("doc.revert", {{"doc", "note.txt"}})["version"], 4);
    EXPECT_EQ(text("note.txt"), "Jelly\n");
    edit("note.txt", 0, 1, "B");
    EXPECT_EQ(ask("doc.save_all", Json::object())["saved"], Json({"note.txt"}));
    EXPECT_EQ(on_disk("note.txt"), "Belly\n");
    EXPECT_THAT(changed, testing::Contains("note.txt"));
}

// The page makes its own change fit what it lacks, and sends it again: the server changes nothing.
TEST_F(EditTest, AnEditOfAnOlderTextIsToldWhatIsMissing) {
    write("note.txt", "hello\n");
    enter();
    edit("note.txt", 0, 0, "x");
    edit("note.txt", 1, 2, "H");
    const Json change = {{"from", 0}, {"to", 0}, {"text", "y"}};
    const Json behind = {
        {{"version", 2}, {"changes", {{{"from", 0}, {"to", 0}, {"text", "x"}}}}, {"by", "page"}},
        {{"version", 3}, {"changes", {{{"from", 1}, {"to", 2}, {"text", "H"}}}}, {"by", "page"}}};
    const Json expected = {{"version", 3}, {"behind", behind}};
    EXPECT_EQ(ask("doc.edit", edit_of("note.txt", 1, {change})), expected);
    EXPECT_EQ(ask("doc.pull", {{"doc", "note.txt"}, {"epoch", "e1"}, {"version", 1}}), expected);
    EXPECT_EQ(ask("doc.pull", {{"doc", "note.txt"}, {"epoch", "e1"}, {"version", 3}}),
              (Json{{"version", 3}, {"behind", Json::array()}}));
    EXPECT_EQ(text("note.txt"), "xHello\n");
}

// What was seen: old text after a restart of the server, and old offsets in the new one.
TEST_F(EditTest, AnEditOfAnotherLifeOfTheServerIsNotDoneAndGetsTheWholeText) {
    write("note.txt", "hello\n");
    enter();
    Json edit = edit_of("note.txt", 1, {{{"from", 0}, {"to", 0}, {"text", "y"}}});
    edit["epoch"] = "the life before";
    const Json whole = {{"version", 1}, {"text", "hello\n"}, {"epoch", "e1"}};
    EXPECT_EQ(ask("doc.edit", edit), whole);
    edit["epoch"] = "e1";
    edit["version"] = 2;  // there is no such text
    EXPECT_EQ(ask("doc.edit", edit), whole);
    EXPECT_EQ(ask("doc.pull", {{"doc", "note.txt"}, {"epoch", "e0"}, {"version", 1}}), whole);
    EXPECT_EQ(text("note.txt"), "hello\n");
}

TEST_F(EditTest, VersionsDoNotComeBackWhenAProjectIsOpenedAgain) {
    write("note.txt", "hello\n");
    enter();
    edit("note.txt", 0, 0, "x");
    ask("doc.save", {{"doc", "note.txt"}});
    files.leave();
    write("note.txt", "another text\n");
    enter();
    EXPECT_EQ(ask("doc.pull", {{"doc", "note.txt"}, {"epoch", "e1"}, {"version", 2}})["text"],
              "another text\n");
}

TEST_F(EditTest, OnlySoManyStepsAreKept) {
    write("note.txt", "");
    enter();
    for (size_t i = 0; i <= kUpdatesKept; ++i) {
        ASSERT_TRUE(files.edit("note.txt", files.version("note.txt"), {{0, 0, "x"}}, "a").ok());
    }
    const auto pull = [&](uint32_t version) {
        return ask("doc.pull", {{"doc", "note.txt"}, {"epoch", "e1"}, {"version", version}});
    };
    EXPECT_EQ(pull(2)["behind"].size(), kUpdatesKept);
    EXPECT_EQ(pull(1)["text"], std::string(kUpdatesKept + 1, 'x'));
}

// A page that has lost the answer sends the edit again: it finds its own step, and does no other.
TEST_F(EditTest, AnEditThatIsSentTwiceIsDoneOnce) {
    write("note.txt", "hello\n");
    enter();
    const Json once = edit_of("note.txt", 1, {{{"from", 0}, {"to", 0}, {"text", "y"}}});
    ask("doc.edit", once);
    const Json again = ask("doc.edit", once);
    EXPECT_EQ(again["behind"][0]["by"], "page");
    EXPECT_EQ(again["behind"][0]["changes"], once["changes"]);
    EXPECT_EQ(text("note.txt"), "yhello\n");
}

TEST_F(EditTest, NoClientCallsItselfAsTheServerDoes) {
    write("note.txt", "hello\n");
    enter();
    for (const char* by : {"", "disk", "server", "for:1"}) {
        Json edit = edit_of("note.txt", 1, {{{"from", 0}, {"to", 0}, {"text", "y"}}});
        edit["by"] = by;
        EXPECT_THAT(refusal("doc.edit", edit), StartsWith("bad_input: by: ")) << by;
    }
}

// What was seen: one refused edit, after which nothing could be saved.
TEST_F(EditTest, ARefusedEditIsAnsweredAndWhatFollowsIsSaved) {
    write("note.txt", "hello\n");
    enter();
    EXPECT_THAT(
        refusal("doc.edit", edit_of("note.txt", 1, {{{"from", 0}, {"to", 99}, {"text", ""}}})),
        StartsWith("bad_input: "));
    edit("note.txt", 0, 1, "J");
    EXPECT_EQ(ask("doc.save", {{"doc", "note.txt"}})["version"], 2);
    EXPECT_EQ(on_disk("note.txt"), "Jello\n");
}

// A change of one member is one small step: what another page typed elsewhere keeps its place.
TEST_F(EditTest, APatchIsAStepOfWhatChanged) {
    write("p.json", "{\n  \"a\": 1,\n  \"b\": 2,\n  \"c\": 3\n}\n");
    enter();
    const Json steps = {{{"do", "set"}, {"at", {"a"}}, {"value", 7}},
                        {{"do", "set"}, {"at", {"c"}}, {"value", 9}}};
    ask("doc.patch", {{"doc", "p.json"}, {"version", 1}, {"steps", steps}});
    const Json pulled = ask("doc.pull", {{"doc", "p.json"}, {"epoch", "e1"}, {"version", 1}});
    const Json changes = {{{"from", 9}, {"to", 10}, {"text", "7"}},
                          {{"from", 29}, {"to", 30}, {"text", "9"}}};
    EXPECT_EQ(pulled["behind"], (Json{{{"version", 2}, {"changes", changes}, {"by", "for:1"}}}));
    EXPECT_THAT(refusal("doc.patch", {{"doc", "p.json"}, {"version", 1}, {"steps", steps}}),
                StartsWith("behind: "));
}

TEST_F(EditTest, WhatAsksForATextThatIsAnotherByNowIsRefused) {
    write("a.aesl", kTwoNodes);
    enter();
    const Json rename = {{"doc", "a.aesl#1"}, {"at", at(1, 5)}, {"to", "z"}};
    const auto seen = [&](uint32_t version, const std::string& epoch) {
        Json in = rename;
        in["seen"] = {{{"doc", "a.aesl#1"}, {"version", version}, {"epoch", epoch}}};
        return in;
    };
    edit("a.aesl#1", 0, 0, " ");
    EXPECT_THAT(refusal("script.rename", seen(1, "e1")), StartsWith("behind: a.aesl#1: "));
    EXPECT_THAT(refusal("script.rename", seen(2, "e0")), StartsWith("behind: a.aesl#1: "));
    Json good = seen(2, "e1");
    good["at"] = at(1, 6);
    EXPECT_EQ(ask("script.rename", good)["places"], 4);
}

// The file and the script in it are two views of one text: each change is a step of both.
TEST_F(EditTest, AChangeOfAScriptIsAStepOfItsFileAndTheOtherWayRound) {
    write("a.aesl", kTwoNodes);
    enter();
    const size_t script = kTwoNodes.find("var x");
    const auto last = [&](const std::string& doc, uint32_t version) {
        return ask("doc.pull", {{"doc", doc}, {"epoch", "e1"}, {"version", version}})["behind"][0];
    };
    ask("doc.open", {{"doc", "a.aesl#1"}});
    edit("a.aesl#1", 4, 5, "z<");
    EXPECT_EQ(last("a.aesl", 1),
              (Json{{"version", 2},
                    {"by", "page"},
                    {"changes", {{{"from", script + 4}, {"to", script + 5}, {"text", "z&lt;"}}}}}));
    edit("a.aesl", script, script + 3, "VAR");
    EXPECT_EQ(last("a.aesl#1", 2),
              (Json{{"version", 3},
                    {"by", "page"},
                    {"changes", {{{"from", 0}, {"to", 3}, {"text", "VAR"}}}}}));
    EXPECT_EQ(files.version("a.aesl#2"), 1u);
}

// What was seen: a script that is renamed while open shows an empty tab.
TEST_F(EditTest, AFileThatIsRenamedKeepsItsTextItsVersionAndWhatIsTypedMeanwhile) {
    write("a.aesl", kTwoNodes);
    enter();
    edit("a.aesl#1", 0, 0, "# mine\n");
    ask("file.rename", {{"path", "a.aesl"}, {"to", "b.aesl"}});
    const Json old = document("doc", {{"doc", "a.aesl#1"}});
    EXPECT_EQ(old["moved"], "b.aesl#1");
    EXPECT_EQ(old["version"], 2);
    // Typed before the page had heard of it.
    ask("doc.edit", edit_of("a.aesl#1", 2, {{{"from", 0}, {"to", 1}, {"text", "%"}}}));
    EXPECT_THAT(text("b.aesl#1"), StartsWith("% mine\n"));
    const Json moved = document("doc", {{"doc", "b.aesl#1"}});
    EXPECT_EQ(moved["version"], 3);
    EXPECT_EQ(moved["unsaved"], true);
    EXPECT_FALSE(moved.contains("moved"));
    ask("doc.save", {{"doc", "a.aesl#1"}});
    EXPECT_THAT(on_disk("b.aesl"), HasSubstr("% mine\n"));
    EXPECT_EQ(on_disk("a.aesl"), "there is no a.aesl");
}

TEST_F(EditTest, AFileThatIsDeletedKeepsItsTextAndSavingMakesItAgain) {
    write("folder/note.txt", "hello\n");
    enter();
    edit("folder/note.txt", 0, 1, "J");
    ask("file.delete", {{"path", "folder"}});
    const Json gone = document("doc", {{"doc", "folder/note.txt"}});
    EXPECT_EQ(gone["gone"], true);
    EXPECT_EQ(gone["version"], 2);
    EXPECT_EQ(text("folder/note.txt"), "Jello\n");
    // Nobody asked for it: neither Run nor a save of all brings it back.
    ask("doc.save_all", Json::object());
    EXPECT_EQ(on_disk("folder/note.txt"), "there is no folder/note.txt");
    ask("doc.save", {{"doc", "folder/note.txt"}});
    EXPECT_EQ(on_disk("folder/note.txt"), "Jello\n");
    EXPECT_EQ(document("doc", {{"doc", "folder/note.txt"}})["gone"], false);
}

TEST_F(EditTest, ChangesOutsideOfTheTextAreRefused) {
    write("note.txt", "a😀b");
    enter();
    for (const auto& [from, to] : {std::pair(0, 9), {2, 2}, {3, 1}, {1, 2}}) {
        EXPECT_THAT(refusal("doc.edit",
                            edit_of("note.txt", 1, {{{"from", from}, {"to", to}, {"text", "x"}}})),
                    StartsWith("bad_input: "));
    }
    edit("note.txt", 1, 3, "");
    EXPECT_EQ(text("note.txt"), "ab");
}

TEST_F(EditTest, ATextThatIsTooLongIsRefused) {
    write("full.txt", std::string(kTextBytesMax, 'x'));
    write("long.txt", std::string(kTextBytesMax + 1, 'x'));
    enter();
    EXPECT_EQ(version("full.txt"), 1u);
    EXPECT_THAT(
        refusal("doc.edit", edit_of("full.txt", 1, {{{"from", 0}, {"to", 0}, {"text", "y"}}})),
        StartsWith("limit: "));
    EXPECT_THAT(refusal("doc.open", {{"doc", "long.txt"}}), StartsWith("limit: "));
}

// What was seen: a third text, written while two were compared, was overwritten by "Keep mine".
TEST_F(EditTest, NobodyOverwritesAFileThatNobodyHasSeen) {
    write("note.txt", "one\n");
    enter();
    edit("note.txt", 0, 3, "mine");
    const auto hash = [&] {
        now += kDiskEvery;
        editing.tick(now);
        return document("doc", {{"doc", "note.txt"}})["disk_hash"];
    };
    write("note.txt", "their two\n");
    const Json seen = hash();
    write("note.txt", "their three\n");
    for (const char* which : {"mine", "disk", "both"}) {
        EXPECT_THAT(
            refusal("doc.keep", {{"doc", "note.txt"}, {"which", which}, {"disk_hash", seen}}),
            StartsWith("behind: note.txt: "));
        EXPECT_THAT(refusal("doc.keep", {{"doc", "note.txt"}, {"which", which}}),
                    StartsWith("behind: note.txt: "));
    }
    EXPECT_NE(hash(), seen);
    EXPECT_EQ(ask("doc.disk", {{"doc", "note.txt"}})["text"], "their three\n");
    ask("doc.keep", {{"doc", "note.txt"}, {"which", "mine"}, {"disk_hash", hash()}});
    ask("doc.save", {{"doc", "note.txt"}});
    EXPECT_EQ(on_disk("note.txt"), "mine\n");
}

TEST_F(EditTest, AFileThatCannotBeWrittenIsNoConflict) {
    write("folder/note.txt", "one\n");
    enter();
    edit("folder/note.txt", 0, 3, "two");
    // A folder in the place of the new file keeps it from being written, also as root.
    std::filesystem::remove(root / "folder/note.txt");
    std::filesystem::create_directories(root / "folder/note.txt/in the way");
    EXPECT_THAT(refusal("doc.save_all", Json::object()), StartsWith("unavailable: "));
    std::filesystem::remove_all(root / "folder/note.txt");
    ask("doc.save_all", Json::object());
    EXPECT_EQ(on_disk("folder/note.txt"), "two\n");
}

TEST_F(EditTest, AFileThatChangedOnDiskIsKeptOrTaken) {
    write("note.txt", "one\n");
    enter();
    const auto change_on_disk = [&](const char* with) {
        edit("note.txt", 0, 0, "my ");
        write("note.txt", with);
        std::filesystem::last_write_time(root / "note.txt",
                                         std::filesystem::file_time_type::clock::now() + now);
        now += kDiskEvery;
        editing.tick(now);
        EXPECT_EQ(document("doc", {{"doc", "note.txt"}})["disk"], true);
        EXPECT_EQ(ask("doc.disk", {{"doc", "note.txt"}})["text"], with);
        EXPECT_THAT(refusal("doc.save", {{"doc", "note.txt"}}), StartsWith("conflict: note.txt: "));
        EXPECT_THAT(refusal("doc.save_all", Json::object()), StartsWith("conflict: note.txt: "));
        EXPECT_EQ(on_disk("note.txt"), with);
    };
    const auto hash = [&] { return document("doc", {{"doc", "note.txt"}})["disk_hash"]; };
    change_on_disk("two\n");
    ask("doc.keep", {{"doc", "note.txt"}, {"which", "mine"}, {"disk_hash", hash()}});
    EXPECT_EQ(text("note.txt"), "my one\n");
    EXPECT_EQ(document("doc", {{"doc", "note.txt"}})["disk"], false);
    EXPECT_THAT(refusal("doc.disk", {{"doc", "note.txt"}}), StartsWith("not_found: "));
    ask("doc.save", {{"doc", "note.txt"}});
    EXPECT_EQ(on_disk("note.txt"), "my one\n");
    change_on_disk("three\n");
    ask("doc.keep", {{"doc", "note.txt"}, {"which", "disk"}, {"disk_hash", hash()}});
    EXPECT_EQ(text("note.txt"), "three\n");
    EXPECT_EQ(document("doc", {{"doc", "note.txt"}})["unsaved"], false);
}

}  // namespace
}  // namespace vagus::serve
