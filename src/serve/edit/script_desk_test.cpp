#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "serve/edit/test_page.hpp"

namespace vagus::serve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// ---- scripts ----

TEST_F(EditTest, WhatIsKnownOfAScriptIsShown) {
    write("a.aesl", kTwoNodes);
    enter();
    const Json scripts_seen = document("scripts");
    EXPECT_EQ(scripts_seen["parts"][1],
              (Json{{"doc", "a.aesl#2"}, {"name", "right"}, {"node", 2}, {"file", "a.aesl"}}));
    EXPECT_EQ(scripts_seen["files"],
              Json::array({{{"path", "a.aesl"},
                            {"events", {{{"name", "ping"}, {"value", 1}}}},
                            {"constants", {{{"name", "LIMIT"}, {"value", 5}}}}}}));
    const Json script = document("script", {{"doc", "a.aesl#1"}});
    EXPECT_EQ(script["good"], true);
    EXPECT_EQ(script["node"], "left");
    EXPECT_EQ(script["bytecode"]["of"], 512);  // of the software node (docs/formats.md)
    EXPECT_EQ(script["code_lines"], Json({1, 3, 4}));
    ASSERT_EQ(script["handlers"].size(), 2u);
    // Code is in the order of the event table, which is sorted by number: ping is 0, the
    // initialisation 0xffff. Load, SmallImm, Binary, Store; Emit of 3 words, straight from x; Stop.
    EXPECT_EQ(script["handlers"][0],
              (Json{{"kind", "event"}, {"name", "ping"}, {"line", 2}, {"words", 8}}));
    // SmallImm, Store, Stop.
    EXPECT_EQ(script["handlers"][1],
              (Json{{"kind", "init"}, {"name", ""}, {"line", 0}, {"words", 3}}));
    const Json lines = ask("script.listing", {{"doc", "a.aesl#1"}})["lines"];
    const auto line = [](int of, int address, int words, const char* shown) {
        return Json{{"line", of}, {"address", address}, {"words", words}, {"text", shown}};
    };
    EXPECT_EQ(lines[0], line(0, 0, 1, "event table of 5 words"));
    EXPECT_EQ(lines[1], line(0, 1, 2, "onevent ping at 5"));
    EXPECT_EQ(lines[2], line(0, 3, 2, "initialisation at 13"));
    EXPECT_EQ(lines[3], line(3, 5, 1, "Load x"));
    EXPECT_EQ(lines[4], line(3, 6, 1, "SmallImm 1"));
    EXPECT_EQ(lines[5], line(3, 7, 1, "Binary +"));
    EXPECT_EQ(lines[6], line(3, 8, 1, "Store x"));
    EXPECT_EQ(lines[7], line(4, 9, 3, "Emit ping, 1 word from x"));
    EXPECT_EQ(lines[9], line(1, 13, 1, "SmallImm 5"));
}

TEST_F(EditTest, QuestionsOfAnEditorAreAnswered) {
    write("a.aesl", kTwoNodes);
    enter();
    const Json there = {{"doc", "a.aesl#1"}, {"at", at(4, 9)}};  // emit pi|ng x
    const Json completed = ask("script.complete", there);
    EXPECT_EQ(completed["from"], at(4, 8));
    ASSERT_EQ(completed["items"].size(), 1u);
    EXPECT_EQ(completed["items"][0]["label"], "ping");
    EXPECT_EQ(completed["items"][0]["kind"], "event");
    EXPECT_EQ(completed["items"][0]["detail"], "1 argument");
    const Json hovered = ask("script.hover", there);
    EXPECT_EQ(hovered["found"], true);
    EXPECT_EQ(hovered["at"], at(4, 8));
    EXPECT_EQ(hovered["end"], at(4, 12));
    EXPECT_EQ(hovered["title"], "ping: an event of the project with 1 arguments");
    EXPECT_EQ(ask("script.hover", {{"doc", "a.aesl#1"}, {"at", at(3, 1)}}),
              (Json{{"found", false}}));
    const Json declared = ask("script.definition", {{"doc", "a.aesl#1"}, {"at", at(3, 3)}});
    EXPECT_EQ(declared["spots"], Json::array({{{"doc", "a.aesl#1"},
                                               {"at", at(1, 5)},
                                               {"end", at(1, 6)},
                                               {"line_text", "var x = LIMIT"}}}));
    const Json used = ask("script.references", there);
    EXPECT_EQ(used["name"], "ping");
    ASSERT_EQ(used["spots"].size(), 3u);
    EXPECT_EQ(used["spots"][2]["doc"], "a.aesl#2");
    EXPECT_EQ(used["spots"][2]["line_text"], "onevent ping");
    EXPECT_THAT(refusal("script.hover", {{"doc", "a.aesl#3"}, {"at", at(1, 1)}}),
                StartsWith("not_found: "));
    // Far outside of the text.
    ask("script.complete", {{"doc", "a.aesl#1"}, {"at", at(10'000'000, 10'000'000)}});
    EXPECT_EQ(ask("script.format_name", {{"name", "speed.left"}}), (Json{{"good", true}}));
    for (const char* bad : {"", "1a", "a b", "when", "a-b"}) {
        EXPECT_EQ(ask("script.format_name", {{"name", bad}})["good"], false) << bad;
    }
}

TEST_F(EditTest, NamesChangeInAllScriptsThatShareThem) {
    write("a.aesl", kTwoNodes);
    enter();
    const Json event =
        ask("script.rename", {{"doc", "a.aesl#2"}, {"at", at(2, 10)}, {"to", "pong"}});
    EXPECT_EQ(event["changed"], Json({"a.aesl", "a.aesl#1", "a.aesl#2"}));
    EXPECT_EQ(event["places"], 4);
    EXPECT_THAT(text("a.aesl"), HasSubstr("<event size=\"1\" name=\"pong\"/>"));
    EXPECT_EQ(text("a.aesl#1"), "var x = LIMIT\nonevent pong\n  x = x + 1\n  emit pong x\n");
    const Json variable =
        ask("script.rename", {{"doc", "a.aesl#1"}, {"at", at(3, 3)}, {"to", "count"}});
    EXPECT_EQ(variable["changed"], Json({"a.aesl#1"}));
    EXPECT_EQ(variable["places"], 4);
    EXPECT_THAT(refusal("script.rename", {{"doc", "a.aesl#1"}, {"at", at(3, 3)}, {"to", "LIMIT"}}),
                StartsWith("bad_input: "));
    EXPECT_THAT(refusal("script.rename", {{"doc", "a.aesl#1"}, {"at", at(3, 1)}, {"to", "b"}}),
                StartsWith("not_found: "));
    EXPECT_EQ(document("scripts")["files"][0]["events"][0]["name"], "pong");
}

constexpr std::string_view kPingPlan =
    "{\n  \"format\": \"vagus-plan/1\",\n  \"name\": \"P\",\n  \"start\": { \"actor\": \"a\", "
    "\"supervisors\": { \"s\": { \"template\": \"OnEvent\", \"in\": { \"event\": \"'ping'\" } } } "
    "},\n"
    "  \"actors\": {\n    \"a\": { \"template\": \"Send\", \"in\": { \"event\": \"'ping'\", "
    "\"args\": "
    "\"'ping'\" } },\n    \"ping\": { \"template\": \"Log\", \"in\": { \"text\": \"'ping'\" } }\n  "
    "}\n}\n";

std::string arm_toolbox(const std::string& event) {
    return "{\n  \"format\": \"vagus-toolbox/1\",\n  \"name\": \"arm\",\n  \"project\": "
           "\"a.aesl\",\n  \"templates\": { \"T\": { \"kind\": \"actor\", \"node\": \"ping\", "
           "\"start\": \"" +
           event + "\", \"states\": { \"ping\": { \"event\": \"" + event + "\" } } } }\n}\n";
}

TEST_F(EditTest, PlansAndToolboxesFollowTheNameOfAnEvent) {
    write("vagus.json", "{ \"format\": \"vagus-project/1\" }\n");
    write("a.aesl", kTwoNodes);
    write("P.plan.json", kPingPlan);
    write("arm.toolbox.json", arm_toolbox("ping"));
    write("other/vagus.json", "{ \"format\": \"vagus-project/1\" }\n");
    write("other/Q.plan.json", kPingPlan);
    enter({.project_file = "vagus.json"});
    const Json event =
        ask("script.rename", {{"doc", "a.aesl#2"}, {"at", at(2, 10)}, {"to", "pong"}});
    EXPECT_EQ(event["changed"],
              Json({"P.plan.json", "a.aesl", "a.aesl#1", "a.aesl#2", "arm.toolbox.json"}));
    EXPECT_EQ(event["places"], 8);
    // Two of the four: what is no event keeps its name.
    std::string plan(kPingPlan);
    for (const char* before :
         {"OnEvent\", \"in\": { \"event\": \"'p", "Send\", \"in\": { \"event\": \"'p"}) {
        plan[plan.find(before) + std::string(before).size()] = 'o';
    }
    EXPECT_EQ(text("P.plan.json"), plan);
    EXPECT_EQ(text("other/Q.plan.json"), kPingPlan);
    const std::string toolbox = text("arm.toolbox.json");
    EXPECT_THAT(toolbox, HasSubstr("\"node\": \"ping\", \"start\": \"pong\""));
    EXPECT_THAT(toolbox, HasSubstr("\"ping\": { \"event\": \"pong\" }"));
    // The same from the list of events.
    const Json back = ask(
        "define.change",
        {{"file", "a.aesl"}, {"kind", "event"}, {"name", "pong"}, {"to", "ping"}, {"value", 1}});
    EXPECT_EQ(back["others"], Json({"P.plan.json", "arm.toolbox.json"}));
    EXPECT_EQ(text("P.plan.json"), kPingPlan);
    EXPECT_EQ(text("arm.toolbox.json"), arm_toolbox("ping"));
    // A plan may mean the event of another script.
    ask("file.new", {{"path", "c.aesl"}, {"kind", "script"}});
    ask("define.add", {{"file", "c.aesl"}, {"kind", "event"}, {"name", "ping"}, {"value", 1}});
    const Json mine = ask(
        "define.change",
        {{"file", "a.aesl"}, {"kind", "event"}, {"name", "ping"}, {"to", "pong"}, {"value", 1}});
    EXPECT_EQ(mine["others"], Json({"arm.toolbox.json"}));
}

TEST_F(EditTest, EventsAndConstantsAreDeclaredChangedMovedAndRemoved) {
    write("a.aesl", kTwoNodes);
    write("plain.aesl", "var x\n");
    enter();
    const auto define = [](const char* kind, const char* name) {
        return Json{{"file", "a.aesl"}, {"kind", kind}, {"name", name}};
    };
    Json add = define("event", "pong");
    add["value"] = 258;
    ask("define.add", add);
    EXPECT_EQ(document("scripts")["files"][0]["events"][1],
              (Json{{"name", "pong"}, {"value", 258}}));
    EXPECT_THAT(refusal("define.add", add), StartsWith("failed: "));
    add["name"] = "third";
    add["value"] = 259;
    EXPECT_THAT(refusal("define.add", add), StartsWith("bad_input: an event has 0 to 258"));
    Json move = define("event", "pong");
    move["to"] = 0;
    ask("define.move", move);
    EXPECT_EQ(document("scripts")["files"][0]["events"][0]["name"], "pong");
    Json change = define("constant", "LIMIT");
    change["to"] = "MOST";
    change["value"] = 6;
    EXPECT_EQ(ask("define.change", change)["places"], 3);
    EXPECT_THAT(text("a.aesl"), HasSubstr("<constant value=\"6\" name=\"MOST\"/>"));
    EXPECT_THAT(text("a.aesl#2"), HasSubstr("y = MOST"));
    ask("define.remove", define("event", "pong"));
    EXPECT_EQ(document("scripts")["files"][0]["events"].size(), 1u);
    EXPECT_THAT(refusal("define.remove", define("event", "pong")), StartsWith("not_found: "));
    put("a.aesl", "</network>", "");
    add["value"] = 0;
    EXPECT_THAT(refusal("define.add", add), StartsWith("failed: fix the file first: a.aesl:"));
    Json plain = add;
    plain["file"] = "plain.aesl";
    plain["value"] = 0;
    EXPECT_THAT(refusal("define.add", plain), StartsWith("failed: plain.aesl: a plain script"));
}

// ---- searching ----

TEST_F(EditTest, TextsAreSearchedAsTheyAreEdited) {
    write("a.aesl", kTwoNodes);
    write("note.txt", "Ping é ping\r\nping\n");
    write("binary.txt", "\xff ping");
    enter();
    edit("note.txt", 0, 0, "un");
    const auto search = [&](const char* what, bool regex, bool exact, bool whole) {
        std::vector<std::string> lines;
        const Json found = ask(
            "text.search", {{"text", what}, {"regex", regex}, {"case", exact}, {"whole", whole}});
        for (const Json& spot : found["spots"]) {
            lines.push_back(spot["doc"].get<std::string>() + ":" +
                            std::to_string(spot["at"]["line"].get<int>()) + ":" +
                            std::to_string(spot["at"]["column"].get<int>()) + "-" +
                            std::to_string(spot["end"]["column"].get<int>()));
        }
        return lines;
    };
    EXPECT_THAT(search("ping", false, true, false),
                ElementsAre("a.aesl:3:23-27", "a.aesl#1:2:9-13", "a.aesl#1:4:8-12",
                            "a.aesl#2:2:9-13", "note.txt:1:10-14", "note.txt:2:1-5"));
    EXPECT_THAT(search("PING", false, false, true),
                ElementsAre("a.aesl:3:23-27", "a.aesl#1:2:9-13", "a.aesl#1:4:8-12",
                            "a.aesl#2:2:9-13", "note.txt:1:10-14", "note.txt:2:1-5"));
    EXPECT_THAT(search("^\\w = L", true, true, false), IsEmpty());
    EXPECT_THAT(search("\\w = [A-Z]", true, true, false),
                ElementsAre("a.aesl#1:1:5-10", "a.aesl#2:3:3-8"));
    const Json wrong =
        ask("text.search", {{"text", "("}, {"regex", true}, {"case", false}, {"whole", false}});
    EXPECT_THAT(wrong["why"].get<std::string>(), HasSubstr("missing )"));
    EXPECT_EQ(wrong["spots"], Json::array());
}

TEST_F(EditTest, OnlySoManyPlacesAreShown) {
    write("long.txt", std::string(kSpotsMax, 'x'));
    enter();
    const Json in = {{"text", "x"}, {"regex", false}, {"case", false}, {"whole", false}};
    const Json all = ask("text.search", in);
    EXPECT_EQ(all["spots"].size(), kSpotsMax);
    EXPECT_EQ(all["more"], false);
    edit("long.txt", 0, 0, "x");
    const Json most = ask("text.search", in);
    EXPECT_EQ(most["spots"].size(), kSpotsMax);
    EXPECT_EQ(most["more"], true);
}

TEST_F(EditTest, WhatWasFoundIsReplaced) {
    write("a.aesl", kTwoNodes);
    write("note.txt", "ping 😀 ping\n");
    enter();
    const Json some = ask("text.replace", {{"text", "ping"},
                                           {"regex", false},
                                           {"case", true},
                                           {"whole", true},
                                           {"by", "$1"},
                                           {"docs", {"note.txt"}}});
    EXPECT_EQ(some["changed"], Json({"note.txt"}));
    EXPECT_EQ(some["places"], 2);
    EXPECT_EQ(text("note.txt"), "$1 😀 $1\n");
    const Json all = ask(
        "text.replace",
        {{"text", "(p)ing"}, {"regex", true}, {"case", true}, {"whole", true}, {"by", "$1ong"}});
    EXPECT_EQ(all["changed"], Json({"a.aesl", "a.aesl#1", "a.aesl#2"}));
    EXPECT_EQ(all["places"], 4);
    std::string expected(kTwoNodes);
    for (size_t found = expected.find("ping"); found != expected.npos;
         found = expected.find("ping")) {
        expected.replace(found, 4, "pong");
    }
    EXPECT_EQ(text("a.aesl"), expected);
    EXPECT_THAT(findings(), IsEmpty());
    EXPECT_THAT(
        refusal("text.replace",
                {{"text", "["}, {"regex", true}, {"case", true}, {"whole", true}, {"by", ""}}),
        StartsWith("bad_input: "));
}

}  // namespace
}  // namespace vagus::serve
