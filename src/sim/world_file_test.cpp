#include "sim/world_file.hpp"

#include <gtest/gtest.h>

#include <string>

using namespace vagus;
using namespace vagus::sim;

namespace {

// The sentence of the error, or "" if the file is right.
std::string error_of(const std::string& text) {
    const Result<WorldDefinition> world = read_world(text, "w.json");
    return world.ok() ? "" : world.error().what;
}

std::string with(const std::string& member) {
    return "{\"format\":\"vagus-world/1\",\"size\":[2,1],\n" + member + "}";
}

TEST(WorldFile, TheSmallestWorldHasItsDefaults) {
    const auto world = read_world(R"({"format": "vagus-world/1", "size": [2, 1.5]})", "w.json");
    ASSERT_TRUE(world.ok()) << world.error().what;
    WorldDefinition expected;
    expected.width = 2;
    expected.height = 1.5;
    EXPECT_EQ(world.value(), expected);
    EXPECT_EQ(world.value().seed, 1u);
}

TEST(WorldFile, EveryKeyArrivesWhereItBelongs) {
    const auto world = read_world(R"({
      "format": "vagus-world/1", "name": "n", "help": "h", "seed": 9223372036854775807,
      "size": [2, 1], "open": true, "ground": {"colour": [0, 0.5, 1]}, "x": {"mine": 1},
      "objects": [
        {"id": "b", "kind": "box", "at": [1, 0.5], "angle": 0.1, "size": [0.2, 0.1],
         "height": 0.3, "mass": 0.4, "colour": [1, 0, 0]},
        {"id": "c", "kind": "cylinder", "at": [0, 0], "radius": 0.05},
        {"id": "l", "kind": "light", "at": [0, 0]}],
      "robots": [
        {"name": "t", "type": "thymio2", "at": [0.5, 0.6], "angle": 3, "node": 7, "port": 4000,
         "script": "s.aesl", "paint": [0, 1, 0]},
        {"name": "e", "type": "epuck", "at": [1.5, 0.6]}],
      "timeline": [
        {"t": 1.5, "do": "press", "robot": "t", "button": "center"},
        {"t": 2, "do": "move", "id": "b", "at": [0.1, 0.2]},
        {"t": 2, "do": "light", "id": "l", "on": false},
        {"t": 3, "do": "remove", "id": "c"},
        {"t": 4, "do": "add", "object": {"id": "c", "kind": "wall", "at": [0, 0], "size": [1, 1]}}]
    })",
                                  "w.json");
    ASSERT_TRUE(world.ok()) << world.error().what;
    const WorldDefinition& w = world.value();
    EXPECT_EQ(w.name, "n");
    EXPECT_EQ(w.help, "h");
    EXPECT_EQ(w.seed, 9223372036854775807u);
    EXPECT_TRUE(w.open);
    EXPECT_EQ(w.ground, (Colour{0, 0.5, 1}));
    EXPECT_EQ(w.objects[0], (ObjectDefinition{.id = "b",
                                              .kind = ObjectKind::Box,
                                              .at = {1, 0.5},
                                              .angle = 0.1,
                                              .width = 0.2,
                                              .length = 0.1,
                                              .height = 0.3,
                                              .mass = 0.4,
                                              .colour = {1, 0, 0}}));
    EXPECT_EQ(w.objects[1].radius, 0.05);
    EXPECT_EQ(w.robots[0], (RobotDefinition{.name = "t",
                                            .type = RobotType::Thymio2,
                                            .at = {0.5, 0.6},
                                            .angle = 3,
                                            .node = 7,
                                            .port = 4000,
                                            .script = "s.aesl",
                                            .paint = {0, 1, 0}}));
    EXPECT_EQ(w.robots[1].type, RobotType::Epuck);
    EXPECT_EQ(w.robots[1].node, 2);  // its place in the list, from 1
    EXPECT_EQ(w.timeline[0], (TimelineEntry{Time(1500000), PressButton{"t", "center", true}}));
    EXPECT_EQ(w.timeline[1],
              (TimelineEntry{Time(2000000), MoveObject{"b", {0.1, 0.2}, std::nullopt}}));
    EXPECT_EQ(w.timeline[2], (TimelineEntry{Time(2000000), SwitchLight{"l", false}}));
    EXPECT_EQ(w.timeline[3], (TimelineEntry{Time(3000000), RemoveObject{"c"}}));
    EXPECT_EQ(std::get<AddObject>(w.timeline[4].action).object.kind, ObjectKind::Wall);
}

TEST(WorldFile, ErrorsNamePlaceElementAndFix) {
    const std::string mass =
        error_of(with(R"("objects":[{"kind":"box","at":[1,1],"size":[1,1],"mass":-1}])"));
    EXPECT_EQ(mass,
              "w.json:2:57: objects[0].mass: expected a number from 0 to 1000 (kg), found -1; "
              "write 0 for what never moves");
    const std::string typo = error_of(with(R"("robtos":[])"));
    EXPECT_EQ(typo.substr(0, 11), "w.json:2:1:");
    EXPECT_NE(typo.find("robots"), std::string::npos) << typo;
}

TEST(WorldFile, ErrorsAfterReadingHaveTheirPlace) {
    const std::string text = with(R"("robots":[{"name":"r","type":"epuck","at":[1,1]}])");
    const Error placed = error_in_world({Code::NotFound, "robots[0].at: is taken"}, text, "w.json");
    EXPECT_EQ(placed.code, Code::NotFound);
    EXPECT_EQ(placed.what, "w.json:2:43: robots[0].at: is taken");
}

struct Wrong {
    const char* member;
    const char* says;
};

TEST(WorldFile, WhatIsWrongIsSaid) {
    const Wrong cases[] = {
        {R"("seed":-1)", "seed"},
        {R"("seed":9223372036854775808)", "does not fit 64 bits"},
        {R"("open":1)", "open"},
        {R"("name":"a","name":"b")", "name"},
        {R"("ground":{"colour":[0,0,2]})", "ground.colour: expected a number from 0 to 1"},
        {R"("ground":{"colour":[0,0]})", "expected 3 numbers; write them as [1, 0.5, 0]"},
        {R"("ground":{"colour":[0,0,0],"image":"a.png"})", "keep one of them"},
        {R"("objects":{})", "objects"},
        {R"("objects":[{"kind":"pond","at":[1,1]}])", "kind"},
        {R"("objects":[{"kind":"wall","size":[1,1]}])", "at"},
        {R"("objects":[{"kind":"wall","at":[1,1]}])", "a wall needs a size"},
        {R"("objects":[{"kind":"box","at":[1,1],"radius":1}])", "a box needs a size"},
        {R"("objects":[{"kind":"cylinder","at":[1,1],"size":[1,1]}])", "needs a radius"},
        {R"("objects":[{"kind":"patch","at":[1,1]}])", "needs a size or a radius"},
        {R"("objects":[{"kind":"patch","at":[1,1],"size":[1,1],"radius":1}])", "keep one"},
        {R"("objects":[{"kind":"cylinder","at":[1,1],"radius":0.0009}])", "radius: expected"},
        {R"("objects":[{"kind":"wall","at":[1,1],"size":[1,101]}])", "size: expected"},
        {R"("objects":[{"kind":"wall","at":[1,1],"size":[1,1],"mass":1}])", "cannot be moved"},
        {R"("objects":[{"kind":"wall","at":[1,1],"size":[1,1],"height":0}])", "height: expected"},
        {R"("objects":[{"kind":"wall","at":[1,1],"size":[1,1],"angle":1001}])", "angle: expected"},
        {R"("objects":[{"id":"a","kind":"light","at":[1,1]},{"id":"a","kind":"light","at":[1,1]}])",
         "objects[1].id: \"a\" is the id of an earlier object"},
        {R"("robots":[{"name":"a","type":"carbot","at":[0.19,0.5]}])",
         "robots[0].at: robot a would overlap the border of the world; place it further inside"},
        {R"("objects":[{"id":"north","kind":"wall","at":[0.5,0.74],"size":[1,0.15]}],)"
         R"("robots":[{"name":"a","type":"carbot","at":[0.5,0.5]}])",
         "robots[0].at: robot a would overlap the wall \"north\"; place one of them"},
        {R"("objects":[{"kind":"cylinder","at":[0.75,0.5],"radius":0.06}],)"
         R"("robots":[{"name":"a","type":"carbot","at":[0.5,0.5]}])",
         "would overlap the cylinder objects[0]"},
        {R"("robots":[{"name":"a","type":"carport","at":[1,1]}])", "type"},
        {R"("robots":[{"name":"a","type":"carbot","at":[0.5,0.5],"node":65532}])",
         "node: expected a number from 1 to 65531"},
        {R"("robots":[{"name":"a","type":"epuck","at":[0.5,0.5],"node":4},)"
         R"({"name":"b","type":"carbot","at":[0.5,0.5],"node":2}])",
         "4 is a node of an earlier robot (robot b has the nodes 2 to 5)"},
        {R"("robots":[{"name":"","type":"epuck","at":[0.5,0.5]}])", "name: is empty"},
        {R"("robots":[{"name":"a","type":"epuck","at":[0.5,0.5],"node":0}])", "node"},
        {R"("robots":[{"name":"a","type":"epuck","at":[0.5,0.5],"node":65535}])", "node"},
        {R"("robots":[{"name":"a","type":"epuck","at":[0.5,0.5],"port":65536}])", "port"},
        {R"("robots":[{"name":"a","type":"epuck","at":[0.5,0.5]},)"
         R"({"name":"a","type":"epuck","at":[0.5,0.5]}])",
         "robots[1].name: \"a\" is taken"},
        {R"("robots":[{"name":"a","type":"epuck","at":[0.5,0.5],"node":2},)"
         R"({"name":"b","type":"epuck","at":[0.5,0.5]}])",
         "robots[1].node: 2 is a node of an earlier robot"},
        {R"("robots":[{"name":"a","type":"epuck","at":[0.5,0.5],"port":5},)"
         R"({"name":"b","type":"epuck","at":[0.5,0.5],"port":5}])",
         "robots[1].port: 5 is the port of an earlier robot"},
        {R"("robots":[{"name":"a","type":"epuck","at":[-0.1,1]}])", "outside of the walls"},
        {R"("robots":[{"name":"a","type":"epuck","at":[1,99]}])", "or write \"open\": true"},
        {R"("timeline":[{"t":1,"do":"dance"}])", "do"},
        {R"("timeline":[{"t":-1,"do":"remove","id":"a"}])", "t"},
        {R"("timeline":[{"t":1,"do":"remove","id":"a"}])", "there is no object \"a\" at that time"},
        {R"("timeline":[{"t":1,"do":"remove","id":"a","on":true}])", "on"},
        {R"("timeline":[{"t":1,"do":"press","robot":"a","button":"b"}])",
         "there is no robot \"a\""},
        {R"("robots":[{"name":"a","type":"thymio2","at":[0.5,0.5]}],)"
         R"("timeline":[{"t":1,"do":"press","robot":"a","button":"b"}])",
         "it has: backward, left, center, forward, right"},
        {R"("objects":[{"id":"w","kind":"wall","at":[1,1],"size":[1,1]}],)"
         R"("timeline":[{"t":1,"do":"light","id":"w","on":true}])",
         "\"w\" is a wall; only a light"},
        {R"("objects":[{"id":"w","kind":"light","at":[1,1]}],)"
         R"("timeline":[{"t":2,"do":"remove","id":"w"},{"t":1,"do":"light","id":"w","on":true}])",
         "no object \"w\""},
    };
    for (const Wrong& wrong : cases) {
        const std::string error = error_of(with(wrong.member));
        EXPECT_NE(error.find(wrong.says), std::string::npos) << wrong.member << "\n" << error;
        EXPECT_EQ(error.substr(0, 9), "w.json:2:") << wrong.member << "\n" << error;
    }
}

TEST(WorldFile, RobotsMayStandAnywhereWhereThereAreNoWalls) {
    EXPECT_EQ(error_of(with(R"("open":true,"robots":[{"name":"a","type":"epuck","at":[-3,1]}])")),
              "");
}

TEST(WorldFile, WhatStandsOutsideOfTheWallsIsRefused) {
    const auto lamp = [](const char* at) {
        return std::string(R"({"id":"l","kind":"light","at":)") + at + "}";
    };
    const std::string sentence =
        " is outside of the walls around the world; place it from 0 to 2 and from 0 to 1, or write "
        "\"open\": true";
    EXPECT_EQ(error_of(with(R"("objects":[)" + lamp("[2.001,1]") + "]")),
              "w.json:2:42: objects[0].at: [2.001, 1]" + sentence);
    EXPECT_EQ(error_of(with(R"("objects":[)" + lamp("[2,0]") + "]")), "") << "in the wall itself";
    EXPECT_NE(error_of(with(R"("timeline":[{"t":1,"do":"add","object":)" + lamp("[1,-0.1]") + "}]"))
                  .find("timeline[0].object.at: [1, -0.1]" + sentence),
              std::string::npos);
    EXPECT_NE(error_of(with(R"("objects":[)" + lamp("[1,1]") +
                            R"(],"timeline":[{"t":1,"do":"move","id":"l","at":[3,1]}])"))
                  .find("timeline[0].at: [3, 1]" + sentence),
              std::string::npos);
    EXPECT_EQ(error_of(with(R"("open":true,"objects":[)" + lamp("[5,5]") + "]")), "");
}

TEST(WorldFile, AnAngleOfMoreThanAFullTurnGetsAHint) {
    const auto hints = [](const std::string& angle) {
        return hints_of_world(
            with(R"("objects":[{"kind":"box","at":[1,1],"size":[1,1],"angle":)" + angle + "}]"),
            "w.json");
    };
    EXPECT_TRUE(hints("6.284").empty()) << "a full turn, rounded";
    EXPECT_TRUE(hints("-6.2832").empty());
    // 45 degrees are 0.7853981…
    EXPECT_EQ(
        hints("45"),
        (std::vector<std::string>{
            "w.json:2:58: warning: objects[0].angle: 45 is more than a full turn; angles are in "
            "radians: 45 degrees are 0.7854"}));
    EXPECT_EQ(
        hints_of_world(with(R"("objects":[{"id":"b","kind":"box","at":[1,1],"size":[0.1,0.1]}],)"
                            R"("timeline":[{"t":1,"do":"move","id":"b","at":[1,1],"angle":-180}])"),
                       "w.json")
            .size(),
        1u);
}

TEST(WorldFile, PortZeroIsAPortToo) {
    const auto world =
        read_world(with(R"("robots":[{"name":"a","type":"epuck","at":[0.5,0.5],"port":0},)"
                        R"({"name":"b","type":"epuck","at":[0.5,0.5],"port":0},)"
                        R"({"name":"c","type":"epuck","at":[0.5,0.5]}])"),
                   "w.json");
    ASSERT_TRUE(world.ok()) << world.error().what;
    EXPECT_EQ(world.value().robots[1].port, 0);
    EXPECT_EQ(world.value().robots[2].port, std::nullopt);
}

// The hull of a Carbot is 0.4 m by 0.35 m with cut corners: beside it there is room, and what moves
// or lies on the ground is never in the way.
TEST(WorldFile, ARobotMayStandCloseToThingsAndOverMarks) {
    const auto error = [](const std::string& object) {
        return error_of(with(R"("objects":[)" + object +
                             R"(],"robots":[{"name":"a","type":"carbot","at":[0.5,0.5]}])"));
    };
    EXPECT_EQ(error(R"({"kind":"wall","at":[0.5,0.75],"size":[1,0.149]})"), "");
    EXPECT_EQ(error(R"({"kind":"cylinder","at":[0.755,0.5],"radius":0.055})"), "");
    EXPECT_EQ(error(R"({"kind":"cylinder","at":[0.7,0.675],"radius":0.02})"), "") << "the corner";
    EXPECT_NE(error(R"({"kind":"cylinder","at":[0.5,0.5],"radius":0.02})"), "") << "under it";
    EXPECT_EQ(error(R"({"kind":"box","at":[0.5,0.5],"size":[0.1,0.1],"mass":0.1})"), "");
    EXPECT_EQ(error(R"({"kind":"patch","at":[0.5,0.5],"size":[1,1]})"), "");
}

TEST(WorldFile, TheTopMustBeAWorld) {
    EXPECT_NE(error_of("[]"), "");
    EXPECT_NE(error_of(R"({"size":[1,1]})").find("format"), std::string::npos);
    EXPECT_NE(error_of(R"({"format":"vagus-world/2","size":[1,1]})").find("vagus-world/1"),
              std::string::npos);
    EXPECT_NE(error_of(R"({"format":"vagus-world/1"})").find("size"), std::string::npos);
    EXPECT_NE(error_of(R"({"format":"vagus-world/1","size":[0.19,1]})").find("0.2 to 100"),
              std::string::npos);
    EXPECT_NE(error_of(R"({"format":"vagus-world/1","size":[1,100.1]})").find("0.2 to 100"),
              std::string::npos);
}

// A list of `count` items, each made from its number.
template <typename Make>
std::string many(const char* key, size_t count, Make make) {
    std::string text = std::string("\"") + key + "\":[";
    for (size_t i = 0; i < count; ++i)
        text += std::string(i == 0 ? "" : ",") + make(std::to_string(i));
    return text + "]";
}

TEST(WorldFile, OneMoreThanEachLimitIsRefused) {
    const auto object = [](const std::string&) { return R"({"kind":"light","at":[1,1]})"; };
    EXPECT_EQ(error_of(with(many("objects", kObjectsMax, object))), "");
    EXPECT_NE(error_of(with(many("objects", kObjectsMax + 1, object))).find("at most 10000"),
              std::string::npos);
    const auto robot = [](const std::string& i) {
        return R"({"type":"epuck","at":[0.5,0.5],"name":"r)" + i + "\"}";
    };
    EXPECT_EQ(error_of(with(many("robots", kRobotsMax, robot))), "");
    EXPECT_NE(error_of(with(many("robots", kRobotsMax + 1, robot))).find("at most 10000"),
              std::string::npos);
    const std::string light = R"("objects":[{"id":"l","kind":"light","at":[1,1]}],)";
    const auto entry = [](const std::string&) {
        return R"({"t":1,"do":"light","id":"l","on":true})";
    };
    EXPECT_EQ(error_of(with(light + many("timeline", kTimelineMax, entry))), "");
    EXPECT_NE(error_of(with(light + many("timeline", kTimelineMax + 1, entry))).find("at most"),
              std::string::npos);
}

}  // namespace
