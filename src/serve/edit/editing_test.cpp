#include "serve/edit/editing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "base/rng.hpp"
#include "serve/edit/test_page.hpp"

namespace vagus::serve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

TEST_F(EditTest, WithoutAProjectEveryCommandSaysSo) {
    const std::string none = "unavailable: no project is open; open one first";
    EXPECT_EQ(refusal("doc.open", {{"doc", "a"}}), none);
    EXPECT_EQ(refusal("doc.save_all", Json::object()), none);
    EXPECT_EQ(refusal("file.new", {{"path", "a.txt"}, {"kind", "text"}}), none);
    EXPECT_EQ(refusal("file.bytes", {{"path", "a"}}), none);
    EXPECT_EQ(document("files"), (Json{{"files", Json::array()}, {"more", false}}));
    EXPECT_EQ(document("doc", {{"doc", "a"}})["gone"], true);
    EXPECT_EQ(document("findings")["findings"], Json::array());
    EXPECT_EQ(document("scripts"), (Json{{"parts", Json::array()}, {"files", Json::array()}}));
    EXPECT_EQ(document("script", {{"doc", "a"}})["good"], false);
    EXPECT_EQ(ask("text.search",
                  {{"text", "x"}, {"regex", false}, {"case", false}, {"whole", false}})["spots"],
              Json::array());
}

TEST_F(EditTest, HostilePathsAreRefusedEverywhere) {
    write("note.txt", "hello\n");
    const std::filesystem::path outside = root.string() + "-outside.txt";
    std::ofstream(outside) << "secret";
    std::filesystem::create_symlink(outside, root / "link.txt");
    enter();
    const std::string secret = "../" + outside.filename().string();
    for (const std::string& path :
         {secret, outside.string(), std::string("link.txt"), std::string(".vagus/journal"),
          std::string("a/../../x"), std::string("a\\b"), std::string(513, 'a')}) {
        const Json doc = {{"doc", path}};
        const Json file = {{"path", path}};
        for (const char* command : {"doc.open", "doc.save", "doc.revert"}) {
            EXPECT_NE(refusal(command, doc), "") << path;
        }
        EXPECT_NE(refusal("file.delete", file), "") << path;
        EXPECT_NE(refusal("file.bytes", file), "") << path;
        EXPECT_NE(refusal("file.new", {{"path", path}, {"kind", "text"}}), "") << path;
        EXPECT_NE(refusal("file.rename", {{"path", "note.txt"}, {"to", path}}), "") << path;
        EXPECT_NE(refusal("doc.edit", edit_of(path, 1, {})), "") << path;
    }
    EXPECT_NE(refusal("doc.open", {{"doc", "note.txt#1"}}), "");
    EXPECT_NE(refusal("doc.open", {{"doc", "note.txt#-1"}}), "");
    EXPECT_EQ(on_disk("note.txt"), "hello\n");
    std::filesystem::remove(outside);
}

TEST_F(EditTest, MembersOfAJsonFileAreChanged) {
    write("w.world.json", "{\n  \"format\": \"vagus-world/1\",\n  \"size\": [1, 1]\n}\n");
    write("note.txt", "{}");
    enter();
    const Json done =
        ask("doc.patch", {{"doc", "w.world.json"},
                          {"version", 1},
                          {"steps", {{{"do", "set"}, {"at", {"seed"}}, {"value", 7}}}}});
    EXPECT_EQ(done["version"], 2);
    EXPECT_EQ(done["text"],
              "{\n  \"format\": \"vagus-world/1\",\n  \"seed\": 7,\n  \"size\": [1, 1]\n}\n");
    EXPECT_EQ(text("w.world.json"), done["text"]);
    // Nothing changed: no new version.
    EXPECT_EQ(
        ask("doc.patch", {{"doc", "w.world.json"},
                          {"version", 2},
                          {"steps", {{{"do", "set"}, {"at", {"seed"}}, {"value", 7}}}}})["version"],
        2);
    EXPECT_THAT(refusal("doc.patch", {{"doc", "w.world.json"},
                                      {"version", 2},
                                      {"steps", {{{"do", "remove"}, {"at", {"nothing"}}}}}}),
                StartsWith("not_found: steps[0]: there is no “nothing”"));
    EXPECT_THAT(
        refusal("doc.patch", {{"doc", "note.txt"}, {"version", 1}, {"steps", Json::array()}}),
        StartsWith("bad_input: "));
}

TEST_F(EditTest, TheListOfFilesShowsWhatIsUnsavedAndWhatComesAndGoes) {
    write("a/b.aesl", "var x\n");
    write("note.txt", "hello\n");
    enter();
    const auto listed = [&] {
        std::vector<std::string> lines;
        const Json seen = document("files");
        for (const Json& file : seen["files"]) {
            lines.push_back(file["path"].get<std::string>() + " " +
                            file["kind"].get<std::string>() +
                            (file["unsaved"].get<bool>() ? " unsaved" : ""));
        }
        return lines;
    };
    EXPECT_THAT(listed(), ElementsAre("a folder", "a/b.aesl script", "note.txt text"));
    edit("note.txt", 0, 0, "x");
    EXPECT_THAT(listed(), ElementsAre("a folder", "a/b.aesl script", "note.txt text unsaved"));
    ask("file.delete", {{"path", "note.txt"}});
    EXPECT_THAT(listed(), ElementsAre("a folder", "a/b.aesl script"));
    EXPECT_TRUE(std::filesystem::exists(root / ".vagus/trash/note.txt"));
}

TEST_F(EditTest, FilesThatOthersMakeAreNoticed) {
    write("note.txt", "hello\n");
    enter();
    ask("watch", {{"watch", 9001}, {"topic", "files"}});
    editing.tick(now);
    write("new.aesl", "var x\n");
    now += kListEvery;
    editing.tick(now);
    EXPECT_EQ(document("files")["files"].size(), 2u);
    EXPECT_EQ(document("scripts")["parts"].size(), 1u);
    std::filesystem::remove(root / "new.aesl");
    now += kListEvery;
    editing.tick(now);
    EXPECT_EQ(document("scripts")["parts"].size(), 0u);
}

// ---- random edits against a plain string ----

std::u16string units(const std::string& text) {
    std::u16string found;
    for (std::string_view rest = text; !rest.empty();) {
        size_t bytes = 1;
        while (bytes < rest.size() && is_utf8_continuation(rest[bytes])) {
            ++bytes;
        }
        const auto lead = static_cast<unsigned char>(rest[0]);
        char32_t point = lead < 0x80 ? lead : lead & (0xff >> (bytes + 1));
        for (size_t i = 1; i < bytes; ++i) {
            point = point << 6 | (static_cast<unsigned char>(rest[i]) & 0x3f);
        }
        if (point >= 0x10000) {
            found += static_cast<char16_t>(0xd800 + ((point - 0x10000) >> 10));
            found += static_cast<char16_t>(0xdc00 + ((point - 0x10000) & 0x3ff));
        } else {
            found += static_cast<char16_t>(point);
        }
        rest.remove_prefix(bytes);
    }
    return found;
}

TEST_F(EditTest, RandomEditsGiveWhatAPlainStringGives) {
    const uint64_t seed = std::random_device()();
    SCOPED_TRACE("seed " + std::to_string(seed));
    SplitMix64 random(seed);
    const auto below = [&](size_t n) { return static_cast<size_t>(random.next() % n); };
    const std::vector<std::string> pieces = {"a",   "x = 1\n", "é", "😀", "\n", "<&>",
                                             "]]>", "\"",      "",  "€", " ",  "\U0001F916!"};
    write("a.aesl", kTwoNodes);
    write("note.txt", "begin 😀\n");
    enter();
    for (const std::string doc : {"a.aesl#1", "note.txt", "a.aesl#2"}) {
        std::u16string model = units(text(doc));
        for (int i = 0; i < 200; ++i) {
            size_t from = below(model.size() + 1);
            size_t to = std::min(model.size(), from + below(6));
            const auto inside = [&](size_t at) {
                return at < model.size() && model[at] >= 0xdc00 && model[at] < 0xe000;
            };
            const std::string& with = pieces[below(pieces.size())];
            const Json in =
                edit_of(doc, files.version(doc), {{{"from", from}, {"to", to}, {"text", with}}});
            if (inside(from) || inside(to)) {
                EXPECT_THAT(refusal("doc.edit", in), StartsWith("bad_input"));
                continue;
            }
            ask("doc.edit", in);
            model = model.substr(0, from) + units(with) + model.substr(to);
            ASSERT_EQ(units(text(doc)), model) << i;
        }
    }
    // What is around the scripts is as it was.
    EXPECT_THAT(text("a.aesl"), StartsWith(kTwoNodes.substr(0, kTwoNodes.find("var x"))));
}

// ---- files ----

TEST_F(EditTest, NewFilesWorkAtOnce) {
    write("vagus.json", "{\n  \"format\": \"vagus-project/1\"\n}\n");
    enter({.project_file = "vagus.json"});
    ask("file.new", {{"path", "folder"}, {"kind", "folder"}});
    ask("file.new", {{"path", "folder/first.aesl"}, {"kind", "script"}});
    ask("file.new", {{"path", "go to.plan.json"}, {"kind", "plan"}});
    ask("file.new", {{"path", "room.world.json"}, {"kind", "world"}});
    ask("file.new", {{"path", "arm.toolbox.json"}, {"kind", "toolbox"}});
    ask("file.new", {{"path", "read me.md"}, {"kind", "text"}});
    EXPECT_EQ(on_disk("vagus.json"),
              "{\n  \"format\": \"vagus-project/1\",\n  \"plan\": \"go to.plan.json\",\n"
              "  \"world\": \"room.world.json\",\n"
              "  \"toolboxes\": [\"arm.toolbox.json\"]\n}\n");
    editing.set_project({.plan = "go to.plan.json",
                         .world = "room.world.json",
                         .project_file = "vagus.json",
                         .toolboxes = {"arm.toolbox.json"}});
    EXPECT_THAT(findings(), IsEmpty());
    const Json parts = document("scripts")["parts"];
    // The toolbox took the script that the only node has.
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0]["doc"], "folder/first.aesl#1");
    EXPECT_EQ(parts[0]["node"], 1);
    EXPECT_EQ(parts[0]["name"], "thymio-II");
    EXPECT_THAT(on_disk("folder/first.aesl"), HasSubstr("onevent arm.start"));
    EXPECT_EQ(on_disk("arm.aesl"), "there is no arm.aesl");
    for (const char* path : {"room.world.json", "arm.toolbox.json", "go to.plan.json"}) {
        // They are in their saved form.
        const std::string before = text(path);
        EXPECT_EQ(ask("doc.patch", {{"doc", path},
                                    {"version", version(path)},
                                    {"steps",
                                     {{{"do", "set"},
                                       {"at", {"name"}},
                                       {"value", Json::parse(before)["name"]}}}}})["text"],
                  before);
    }
    // A plan with the new template, and one that nobody knows.
    put("go to.plan.json", "\"start\"", "\"toolboxes\": [\"arm\"],\n  \"start\"");
    put("go to.plan.json", "\"Wait\", \"in\": { \"seconds\": \"1\" }", "\"Arm\"");
    EXPECT_THAT(finding("bus").what, HasSubstr("the template Arm works by events"));
    ask("doc.patch",
        {{"doc", "room.world.json"},
         {"version", version("room.world.json")},
         {"steps",
          {{{"do", "set"}, {"at", {"robots", 0, "script"}}, {"value", "folder/first.aesl"}}}}});
    EXPECT_THAT(findings(), IsEmpty());
    put("go to.plan.json", "\"Arm\"", "\"Arn\"");
    EXPECT_THAT(finding("P2").what, HasSubstr("did you mean \"Arm\"?"));
}

// What was seen: after "+ Plan" in a project that names none, Run still ran none.
TEST_F(EditTest, TheFirstPlanIsThatOfTheProject) {
    write("vagus.json", "{\n  \"format\": \"vagus-project/1\"\n}\n");
    enter({.project_file = "vagus.json"});
    ask("file.new", {{"path", "a.plan.json"}, {"kind", "plan"}});
    EXPECT_EQ(on_disk("vagus.json"),
              "{\n  \"format\": \"vagus-project/1\",\n  \"plan\": \"a.plan.json\"\n}\n");
    editing.set_project({.plan = "a.plan.json", .project_file = "vagus.json"});
    ask("file.new", {{"path", "b.plan.json"}, {"kind", "plan"}});
    EXPECT_THAT(on_disk("vagus.json"), HasSubstr("a.plan.json"));
    ask("file.delete", {{"path", "a.plan.json"}});
    ask("file.new", {{"path", "c.plan.json"}, {"kind", "plan"}});
    EXPECT_THAT(on_disk("vagus.json"), HasSubstr("c.plan.json"));
}

// A second script for node 1 would be one that is never loaded.
TEST_F(EditTest, ANewScriptIsForANodeThatHasNone) {
    write("vagus.json",
          "{\n  \"format\": \"vagus-project/1\",\n  \"scripts\": [\"a.aesl\"],\n"
          "  \"world\": \"w.world.json\"\n}\n");
    write("a.aesl", "<network><node nodeId=\"1\" name=\"thymio-II\"></node></network>");
    write("w.world.json",
          "{\n  \"format\": \"vagus-world/1\",\n  \"size\": [1, 1],\n  \"robots\": [\n"
          "    { \"name\": \"one\", \"type\": \"thymio2\", \"at\": [0.3, 0.5], "
          "\"script\": \"a.aesl\" },\n"
          "    { \"name\": \"two\", \"type\": \"thymio2\", \"at\": [0.7, 0.5] }\n  ]\n}\n");
    enter({.world = "w.world.json", .project_file = "vagus.json"});
    ask("file.new", {{"path", "b.aesl"}, {"kind", "script"}});
    EXPECT_THAT(on_disk("b.aesl"), HasSubstr("nodeId=\"2\" name=\"thymio-II\""));
    EXPECT_THAT(on_disk("vagus.json"), HasSubstr("\"scripts\": [\"a.aesl\", \"b.aesl\"]"));
    EXPECT_THAT(on_disk("w.world.json"), HasSubstr("\"script\": \"b.aesl\""));
    EXPECT_THAT(findings(), IsEmpty());
    // Each node has a script now: the next one is for none of them.
    ask("file.new", {{"path", "c.aesl"}, {"kind", "script"}});
    EXPECT_THAT(on_disk("c.aesl"), HasSubstr("nodeId=\"3\" name=\"thymio-II\""));
    EXPECT_THAT(on_disk("vagus.json"), Not(HasSubstr("c.aesl")));
    EXPECT_THAT(on_disk("w.world.json"), Not(HasSubstr("c.aesl")));
}

// A script that vagus.json does not name comes after those that it does.
TEST_F(EditTest, ANewScriptTakesNoNodeFromAnother) {
    write("vagus.json", "{ \"format\": \"vagus-project/1\", \"world\": \"w.world.json\" }\n");
    write("a.aesl", "<network><node nodeId=\"1\" name=\"drive\"></node></network>");
    write("w.world.json",
          "{ \"format\": \"vagus-world/1\", \"size\": [3, 3], \"robots\": [{ \"name\": \"c\", "
          "\"type\": \"carbot\", \"at\": [1, 1] }, { \"name\": \"d\", \"type\": \"carbot\", "
          "\"at\": [2, 2] }] }\n");
    enter({.world = "w.world.json", .project_file = "vagus.json"});
    ask("file.new", {{"path", "b.aesl"}, {"kind", "script"}});
    EXPECT_THAT(on_disk("b.aesl"), HasSubstr("nodeId=\"2\" name=\"bumper\""));
    EXPECT_THAT(on_disk("vagus.json"), HasSubstr("b.aesl"));
    for (const char* path : {"c.aesl", "d.aesl", "e.aesl"}) {
        ask("file.new", {{"path", path}, {"kind", "script"}});
    }
    // The drive of the second Carbot: node 1 would get it, too, if vagus.json named it.
    EXPECT_THAT(on_disk("e.aesl"), HasSubstr("nodeId=\"5\" name=\"drive\""));
    EXPECT_THAT(on_disk("vagus.json"), Not(HasSubstr("e.aesl")));
    EXPECT_EQ(scripts.for_node("drive", 1)->file, "a.aesl");
    EXPECT_EQ(scripts.for_node("drive", 5)->file, "e.aesl");
}

TEST_F(EditTest, NewFilesNeedTheirEndingAndAFreeName) {
    write("a.aesl", "var x\n");
    enter();
    EXPECT_THAT(refusal("file.new", {{"path", "b.txt"}, {"kind", "script"}}),
                StartsWith("bad_input: b.txt: the name of a script must end in .aesl"));
    EXPECT_THAT(refusal("file.new", {{"path", ".plan.json"}, {"kind", "plan"}}),
                StartsWith("bad_input: "));
    EXPECT_THAT(refusal("file.new", {{"path", "a.aesl"}, {"kind", "script"}}),
                StartsWith("failed: a.aesl: there is such a file already"));
    EXPECT_THAT(refusal("file.new", {{"path", "a.toolbox.json"}, {"kind", "toolbox"}}),
                StartsWith("failed: a.aesl: there is such a file already"));
}

TEST_F(EditTest, TestsFollowTheirPlanAndWorldsTheProjectsOfTheirRobots) {
    write("vagus.json", "{ \"format\": \"vagus-project/1\", \"plan\": \"P.plan.json\" }\n");
    write("P.plan.json", "{}\n");
    write("tests/P.test.json",
          "{ \"format\": \"vagus-test/1\", \"plan\": \"../P.plan.json\",\n"
          "\"world\": \"../w.world.json\", \"toolboxes\": [\"../t.toolbox.json\"] }\n");
    write("t.toolbox.json", "{}\n");
    write("picker/vagus.json", "{}\n");
    write("w.world.json",
          "{ \"format\": \"vagus-world/1\", \"size\": [1, 1],\n"
          "\"robots\": [{ \"name\": \"r\", \"type\": \"carbot\", \"project\": \"picker/\" }] }\n");
    enter({.plan = "P.plan.json", .world = "w.world.json", .project_file = "vagus.json"});
    const Json plan = ask("file.rename", {{"path", "P.plan.json"}, {"to", "Q.plan.json"}});
    EXPECT_EQ(plan["followed"], Json({"tests/P.test.json", "vagus.json"}));
    EXPECT_EQ(on_disk("tests/P.test.json"),
              "{ \"format\": \"vagus-test/1\", \"plan\": \"../Q.plan.json\",\n"
              "\"world\": \"../w.world.json\", \"toolboxes\": [\"../t.toolbox.json\"] }\n");
    const Json box = ask("file.rename", {{"path", "t.toolbox.json"}, {"to", "u.toolbox.json"}});
    EXPECT_EQ(box["followed"], Json({"tests/P.test.json"}));
    const Json folder = ask("file.rename", {{"path", "picker"}, {"to", "robots/picker"}});
    EXPECT_EQ(folder["followed"], Json({"w.world.json"}));
    EXPECT_THAT(on_disk("w.world.json"), HasSubstr("\"project\": \"robots/picker/\""));
}

TEST_F(EditTest, WhatNamesAFileFollowsItsRenaming) {
    write("vagus.json",
          "{ \"format\": \"vagus-project/1\", \"plan\":\"plans/P.plan.json\",\n"
          "\"scripts\": [\"s.aesl\"], \"world\": \"w.world.json\"}\n");
    write("s.aesl", "var x\n");
    write("w.world.json",
          "{\n  \"format\": \"vagus-world/1\",\n  \"size\": [1, 1],\n  \"robots\": [{ \"name\": "
          "\"t\", \"type\": \"thymio2\", \"at\": [0.5, 0.5], \"script\": \"s.aesl\" }]\n}\n");
    write("plans/P.plan.json",
          "{ \"format\": \"vagus-plan/1\", \"name\": \"P\", \"start\": { \"actor\": \"a\" },\n"
          "\"actors\": { \"a\": { \"plan\": \"sub/Q.plan.json\", \"states\": { \"OK\": "
          "\"@terminate\", \"Interrupted\": \"@terminate\", \"Error\": \"@terminate\" } } } }\n");
    write("plans/sub/Q.plan.json", "{}\n");
    enter({.plan = "plans/P.plan.json", .world = "w.world.json", .project_file = "vagus.json"});
    const Json script = ask("file.rename", {{"path", "s.aesl"}, {"to", "scripts/first.aesl"}});
    EXPECT_EQ(script["followed"], Json({"vagus.json", "w.world.json"}));
    EXPECT_EQ(on_disk("vagus.json"),
              "{ \"format\": \"vagus-project/1\", \"plan\":\"plans/P.plan.json\",\n"
              "\"scripts\": [\"scripts/first.aesl\"], \"world\": \"w.world.json\"}\n");
    EXPECT_THAT(on_disk("w.world.json"), HasSubstr("\"script\": \"scripts/first.aesl\" }]\n}\n"));
    // A folder: what is in it keeps its paths inside, what is outside follows.
    const Json folder = ask("file.rename", {{"path", "plans"}, {"to", "all/plans"}});
    EXPECT_EQ(folder["followed"], Json({"vagus.json"}));
    EXPECT_THAT(on_disk("vagus.json"), HasSubstr("\"plan\":\"all/plans/P.plan.json\""));
    EXPECT_THAT(on_disk("all/plans/P.plan.json"), HasSubstr("\"sub/Q.plan.json\""));
    // A moved file gets new relative paths; one with unsaved changes is not saved by that.
    edit("all/plans/P.plan.json", 1, 1, " ");
    const Json plan =
        ask("file.rename", {{"path", "all/plans/P.plan.json"}, {"to", "P.plan.json"}});
    EXPECT_EQ(plan["followed"], Json({"P.plan.json", "vagus.json"}));
    EXPECT_THAT(text("P.plan.json"), HasSubstr("\"all/plans/sub/Q.plan.json\""));
    EXPECT_THAT(on_disk("P.plan.json"), HasSubstr("\"sub/Q.plan.json\""));
    EXPECT_THAT(renamed, ElementsAre("s.aesl -> scripts/first.aesl", "plans -> all/plans",
                                     "all/plans/P.plan.json -> P.plan.json"));
    EXPECT_THAT(refusal("file.rename", {{"path", "P.plan.json"}, {"to", "w.world.json"}}),
                StartsWith("failed: w.world.json: there is such a file already"));
    EXPECT_NE(refusal("file.rename", {{"path", "nothing"}, {"to", "else"}}), "");
}

TEST_F(EditTest, BytesComeAsBase64) {
    write("a.png", std::string("\x00\xff\x10", 3));
    write("b.png", "ab");
    write("c.png", "a");
    write("d.png", "");
    write("large.bin", std::string(kBytesMax, 'x'));
    write("larger.bin", std::string(kBytesMax + 1, 'x'));
    enter();
    EXPECT_EQ(ask("file.bytes", {{"path", "a.png"}})["base64"], "AP8Q");
    EXPECT_EQ(ask("file.bytes", {{"path", "b.png"}})["base64"], "YWI=");
    EXPECT_EQ(ask("file.bytes", {{"path", "c.png"}})["base64"], "YQ==");
    EXPECT_EQ(ask("file.bytes", {{"path", "d.png"}})["base64"], "");
    EXPECT_EQ(ask("file.bytes", {{"path", "large.bin"}})["base64"].get<std::string>().size(),
              5592408u);
    EXPECT_THAT(refusal("file.bytes", {{"path", "larger.bin"}}),
                StartsWith("limit: larger.bin: 4194305 bytes, and a page gets files of at most "
                           "4194304; copy it from the folder"));
}

// ---- projects ----

TEST_F(EditTest, AnotherProjectHasOtherScriptsAndFiles) {
    write("one/a.aesl", kTwoNodes);
    write("two/b.aesl", "var x\n");
    files.enter(root / "one");
    editing.set_project({});
    EXPECT_EQ(document("scripts")["parts"].size(), 2u);
    edit("a.aesl#1", 0, 0, "# unsaved\n");
    files.leave();
    editing.set_project({});
    EXPECT_EQ(document("scripts")["parts"].size(), 0u);
    EXPECT_EQ(document("files")["files"].size(), 0u);
    files.enter(root / "two");
    editing.set_project({});
    EXPECT_EQ(document("scripts")["parts"][0]["doc"], "b.aesl");
    files.enter(root / "one");
    editing.set_project({});
    EXPECT_THAT(text("a.aesl#1"), StartsWith("# unsaved\n"));
}

}  // namespace
}  // namespace vagus::serve
