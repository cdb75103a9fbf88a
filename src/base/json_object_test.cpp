#include "base/json_object.hpp"

#include <gtest/gtest.h>

namespace vagus {
namespace {

// The complaints about a world with a size (1 to 9), a scale, a kind and a list, as "LINE:COL:
// sentence".
std::vector<std::string> complaints_of(std::string_view text) {
    const JsonValue json = parse_json(text, "f").value();
    Complaints complaints;
    JsonObject world(json, "the world", complaints);
    (void)world.integer("size", {.low = 1, .high = 9, .fallback = 1, .need = Need::Required});
    (void)world.number("scale", {.low = 0, .high = 1, .fallback = 0.5});
    (void)world.word("kind", {"wall", "box"}, Need::Optional, "wall");
    (void)world.items("list", Need::Optional);
    (void)world.boolean("open", false);
    world.finish();
    std::vector<std::string> lines;
    for (const Complaint& complaint : complaints)
        lines.push_back(at_place("f", complaint.at, complaint.what));
    return lines;
}

using Lines = std::vector<std::string>;

TEST(JsonObject, AcceptsWhatIsRight) {
    EXPECT_EQ(complaints_of(R"({"size": 9, "scale": 1, "kind": "box", "list": [], "open": true})"),
              Lines{});
}

TEST(JsonObject, NamesUnknownKeysAndTheNearestKnownOne) {
    EXPECT_EQ(complaints_of("{\"size\": 1,\n \"scael\": 1}"),
              Lines{"f:2:2: the world has the unknown key \"scael\"; did you mean \"scale\"?"});
    EXPECT_EQ(
        complaints_of(R"({"size": 1, "colour": 1})"),
        Lines{"f:1:13: the world has the unknown key \"colour\"; remove it, or use one of size, "
              "scale, kind, list and open"});
}

TEST(JsonObject, KeepsXForOthers) {
    EXPECT_EQ(complaints_of(R"({"size": 1, "x": {"anything": [1]}})"), Lines{});
}

TEST(JsonObject, NamesDoubleKeysAtTheSecond) {
    EXPECT_EQ(complaints_of(R"({"size": 1, "size": 2})"),
              Lines{"f:1:13: the world has the key \"size\" a second time; remove one"});
    EXPECT_EQ(complaints_of(R"({"size": 1, "x": 1, "x": 2})").size(), 1u);
}

TEST(JsonObject, NamesMissingKeysWrongKindsAndRanges) {
    EXPECT_EQ(complaints_of("{}"), Lines{"f:1:1: the world has no \"size\"; add it"});
    EXPECT_EQ(complaints_of("[]"),
              Lines{"f:1:1: the world is an array; it must be an object: { … }"});
    EXPECT_EQ(complaints_of(R"({"size": "big"})"),
              Lines{"f:1:10: \"size\" of the world is \"big\"; write a whole number"});
    EXPECT_EQ(complaints_of(R"({"size": 1.5})"),
              Lines{"f:1:10: \"size\" of the world is 1.5; write a whole number"});
    EXPECT_EQ(complaints_of(R"({"size": 10})"),
              Lines{"f:1:10: \"size\" of the world is 10; write a whole number from 1 to 9"});
    EXPECT_EQ(complaints_of(R"({"size": 1, "scale": 1.01})"),
              Lines{"f:1:22: \"scale\" of the world is 1.01; write a number from 0 to 1"});
    EXPECT_EQ(complaints_of(R"({"size": 1, "kind": "bxo"})"),
              Lines{"f:1:21: \"kind\" of the world is \"bxo\"; did you mean \"box\"?"});
    EXPECT_EQ(complaints_of(R"({"size": 1, "kind": "sphere"})"),
              Lines{"f:1:21: \"kind\" of the world is \"sphere\"; write one of wall and box"});
}

// A needed key that is misspelt is one mistake, at the place where it is.
TEST(JsonObject, AMisspeltKeyIsNotAlsoMissing) {
    EXPECT_EQ(complaints_of(R"({"szie": 1})"),
              Lines{"f:1:2: the world has the unknown key \"szie\"; did you mean \"size\"?"});
}

TEST(JsonObject, ValuesThatWereComplainedOfFallBack) {
    const JsonValue json = parse_json(R"({"size": 10, "scale": "x"})", "f").value();
    Complaints complaints;
    JsonObject world(json, "the world", complaints);
    EXPECT_EQ(world.integer("size", {.low = 1, .high = 9, .fallback = 4}), 4);
    EXPECT_EQ(world.number("scale", {.fallback = 0.5}), 0.5);
    EXPECT_EQ(world.text("name", Need::Optional, "none"), "none");
    EXPECT_EQ(complaints.size(), 2u);
}

TEST(JsonObject, TheErrorIsTheFirstInTheFile) {
    const Complaints complaints = {{{3, 1}, "third"}, {{1, 7}, "first"}, {{2, 1}, "second"}};
    EXPECT_EQ(first_complaint(complaints, "a.json").what, "a.json:1:7: first");
}

TEST(JsonObject, KeepsNoMoreComplaintsThanTheLimit) {
    std::string text = "{\"size\": 1";
    for (size_t i = 0; i <= kComplaintsMax; ++i) text += ", \"k" + std::to_string(i) + "\": 0";
    EXPECT_EQ(complaints_of(text + "}").size(), kComplaintsMax);
}

}  // namespace
}  // namespace vagus
