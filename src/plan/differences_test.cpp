// What differs between two plans, by hand and on random pairs: applied to the one, the differences
// give the other.
#include "plan/differences.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.hpp"
#include "plan/file.hpp"

namespace vagus::plan {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kPlan = R"({
  "format": "vagus-plan/1",
  "name": "Main",
  "configuration": { "far": { "type": "int", "initial": 30 }, "near": { "type": "int" } },
  "start": { "actor": "drive", "supervisors": {
    "stop": { "template": "See", "events": { "Seen": "@terminate" } } } },
  "actors": {
    "drive": { "template": "Drive", "in": { "speed": "far" }, "states": { "Done": "turn" },
      "supervisors": { "wall": { "template": "See", "events": { "Seen": "turn" } },
                       "edge": { "template": "See", "events": { "Seen": "@ignore" } } } },
    "turn": { "template": "Turn", "states": { "Done": "drive" } } },
  "layout": { "drive": [0, 0], "turn": [100, 0] } })";

std::string with(std::string text, const std::string& here, const std::string& instead) {
    const size_t at = text.find(here);
    EXPECT_NE(at, std::string::npos) << here;
    return text.replace(at, here.size(), instead);
}

JsonValue tree(const std::string& text) {
    Result<JsonValue> made = read_plan_tree(text, "p.plan.json");
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().what);
    return made.ok() ? std::move(made.value()) : json_object({});
}

Differences between(const std::string& before, const std::string& after) {
    return differences(tree(before), tree(after));
}

std::string told(const std::string& before, const std::string& after) {
    return format_text(between(before, after), {});
}

TEST(Differences, TheSamePlanHasNone) {
    EXPECT_THAT(between(kPlan, kPlan), IsEmpty());
    EXPECT_EQ(told(kPlan, kPlan), "");
    EXPECT_EQ(format_json({}), "[]\n");
}

// Both are saved in the same form (P0).
TEST(Differences, SpacesAndTheOrderOfKeysAreNone) {
    EXPECT_THAT(between(kPlan, with(kPlan, R"("template": "Turn", "states": { "Done": "drive" })",
                                    R"(   "states":{"Done":"drive"},"template":"Turn")")),
                IsEmpty());
}

TEST(Differences, AFieldIsToldWithBothItsValues) {
    EXPECT_EQ(told(kPlan, with(kPlan, R"("speed": "far")", R"("speed": "far + 1")")),
              "actor drive\n  - in.speed: \"far\"\n  + in.speed: \"far + 1\"\n");
    EXPECT_EQ(told(kPlan, with(kPlan, R"("initial": 30)", R"("initial": 30, "unit": "cm")")),
              "variable far\n  + unit: \"cm\"\n");
    EXPECT_EQ(told(kPlan, with(kPlan, R"("Seen": "turn")", R"("Seen": "@terminate")")),
              "supervisor wall of drive\n  - events.Seen: \"turn\"\n  + events.Seen: "
              "\"@terminate\"\n");
    EXPECT_EQ(told(kPlan, with(kPlan, R"("actor": "drive")", R"("actor": "turn")")),
              "plan\n  - start.actor: \"drive\"\n  + start.actor: \"turn\"\n");
}

// 30 is an int, 30.0 a float (P0).
TEST(Differences, AWholeNumberIsNotTheSameAsAFloat) {
    EXPECT_EQ(between(kPlan, with(kPlan, "30", "30.0")).size(), 1u);
}

TEST(Differences, AnElementThatCameOrWentIsOneDifference) {
    const std::string more =
        with(kPlan, R"("turn": { "template")", R"("wait": { "template": "Wait", "in": { "seconds":
             1 }, "states": { "Done": "turn" } }, "turn": { "template")");
    const Differences added = between(kPlan, more);
    ASSERT_EQ(added.size(), 1u);
    EXPECT_EQ(added[0].kind, DifferenceKind::Added);
    EXPECT_THAT(added[0].path, ElementsAre("actors", "wait"));
    EXPECT_EQ(added[0].behind, "drive");
    EXPECT_EQ(format_text(added, {}),
              "+ actor wait\n  + template: \"Wait\"\n  + in.seconds: 1\n  + states.Done: "
              "\"turn\"\n");
    EXPECT_THAT(told(more, kPlan), HasSubstr("- actor wait\n  - template: \"Wait\"\n"));
}

// The first supervisor wins (P21).
TEST(Differences, TheOrderOfSupervisorsIsOne) {
    std::string swapped = with(kPlan, "\"wall\"", "\"%\"");
    swapped = with(with(swapped, "\"edge\"", "\"wall\""), "\"%\"", "\"edge\"");
    swapped = with(swapped, R"("edge": { "template": "See", "events": { "Seen": "turn" } })",
                   R"("edge": { "template": "See", "events": { "Seen": "@ignore" } })");
    swapped = with(swapped, R"("wall": { "template": "See", "events": { "Seen": "@ignore" } })",
                   R"("wall": { "template": "See", "events": { "Seen": "turn" } })");
    EXPECT_EQ(told(kPlan, swapped),
              "actor drive\n  - order of supervisors: wall, edge\n  + order of supervisors: edge, "
              "wall\n");
}

TEST(Differences, PlacesAreToldInOneLineUnlessAskedFor) {
    const std::string moved = with(with(kPlan, "[0, 0]", "[0, 50]"), "[100, 0]", "[9, 9]");
    EXPECT_EQ(told(kPlan, moved), "2 elements stand elsewhere (--places lists them)\n");
    EXPECT_THAT(format_text(between(kPlan, moved), {.places = true}),
                HasSubstr("  - layout.drive: [0, 0]\n  + layout.drive: [0, 50]\n"));
    EXPECT_TRUE(is_place(between(kPlan, moved)[0]));
    EXPECT_EQ(told(kPlan, with(kPlan, "[0, 0]", "[0, 50]")),
              "1 element stands elsewhere (--places lists them)\n");
}

TEST(Differences, JsonSaysTheSame) {
    EXPECT_EQ(format_json(between(kPlan, with(kPlan, R"("speed": "far")", R"("speed": "1")"))),
              "[\n  {\"kind\": \"changed\", \"element\": \"actor drive\", \"part\": \"in.speed\", "
              "\"path\": [\"actors\", \"drive\", \"in\", \"speed\"], \"before\": \"far\", "
              "\"after\": \"1\"}\n]\n");
}

TEST(Differences, AFileThatIsNoPlanIsRefusedWithItsPlace) {
    EXPECT_EQ(read_plan_tree("{", "p.plan.json").ok(), false);
    const auto doubled = read_plan_tree(with(kPlan, "\"near\"", "\"far\""), "p.plan.json");
    ASSERT_FALSE(doubled.ok());
    EXPECT_THAT(doubled.error().what, HasSubstr("p.plan.json:4:"));
}

TEST(Differences, WhatDoesNotFitIsNotApplied) {
    const std::string other = with(kPlan, R"("speed": "far")", R"("speed": "far + 1")");
    const Differences all = between(kPlan, other);
    const auto twice = apply_differences(all, tree(other));
    ASSERT_FALSE(twice.ok());
    EXPECT_EQ(twice.error().what, "\"actors.drive.in.speed\" cannot be changed: it is another one");
}

// ---- random pairs ----

class PairMaker {
public:
    explicit PairMaker(uint64_t seed) : random_(seed) {}

    std::string plan() {
        std::string text = "{ \"format\": \"vagus-plan/1\", \"name\": \"P\"";
        if (below(2) == 0) text += fmt::format(", \"help\": \"help {}\"", below(2));
        if (below(2) == 0) text += ", \"toolboxes\": [\"a\"]";
        text += ", \"configuration\": {" + list(&PairMaker::variable, "v") + "}";
        text += fmt::format(", \"start\": {{ \"actor\": \"a{}\", \"supervisors\": {{{}}} }}",
                            below(3), list(&PairMaker::supervisor, "g"));
        text += ", \"actors\": {" + list(&PairMaker::actor, "a") + "}";
        if (below(2) == 0) text += ", \"layout\": {" + list(&PairMaker::spot, "a") + "}";
        if (below(3) == 0) text += fmt::format(", \"x\": {{ \"k\": [{}] }}", below(2));
        return text + " }";
    }

private:
    size_t below(uint64_t bound) { return static_cast<size_t>(random_.below(bound)); }

    // Some of six names, in any order.
    std::string list(std::string (PairMaker::*one)(), const std::string& prefix) {
        std::vector<int> names = {0, 1, 2, 3, 4, 5};
        for (size_t i = names.size(); i > 1; --i) std::swap(names[i - 1], names[below(i)]);
        names.resize(below(7));
        if (below(2) == 0) std::sort(names.begin(), names.end());
        std::string text;
        for (const int name : names) {
            text += fmt::format("{}\"{}{}\": {}", text.empty() ? "" : ", ", prefix, name,
                                (this->*one)());
        }
        return text;
    }

    std::string word() { return fmt::format("\"w{}\"", below(3)); }
    std::string variable() {
        return fmt::format("{{ \"type\": \"int\"{} }}",
                           below(2) == 0 ? "" : fmt::format(", \"initial\": {}", below(3)));
    }
    std::string spot() { return fmt::format("[{}, {}]", below(3), below(3)); }
    std::string supervisor() {
        return fmt::format("{{ \"template\": {}, \"in\": {{{}}}, \"events\": {{{}}} }}", word(),
                           list(&PairMaker::word, "i"), list(&PairMaker::word, "e"));
    }
    std::string actor() {
        const size_t number = supervisors_++;
        return fmt::format(
            "{{ \"template\": {}, \"in\": {{{}}}, \"out\": {{{}}}, \"states\": {{{}}}, "
            "\"supervisors\": {{{}}} }}",
            word(), list(&PairMaker::word, "i"), list(&PairMaker::word, "o"),
            list(&PairMaker::word, "s"),
            list(&PairMaker::supervisor, fmt::format("n{}_", number % 6)));
    }

    SplitMix64 random_;
    size_t supervisors_ = 0;  // their names are unique in a plan (P1)
};

TEST(Differences, AppliedToTheOneTheyGiveTheOther) {
    size_t kinds[4] = {};
    for (uint64_t seed = 1; seed <= 200; ++seed) {
        PairMaker maker(seed);
        const std::string first = maker.plan();
        const std::string second = PairMaker(seed * 1000 + 7).plan();
        SCOPED_TRACE(fmt::format("seed {}\n{}\n{}", seed, first, second));
        const JsonValue before = tree(first);
        const JsonValue after = tree(second);
        const Differences all = differences(before, after);
        for (const Difference& one : all) ++kinds[static_cast<size_t>(one.kind)];
        const auto applied = apply_differences(all, before);
        ASSERT_TRUE(applied.ok()) << applied.error().what;
        EXPECT_EQ(format_json(applied.value()), format_plan(second, "p.plan.json").value());
        const auto back = apply_differences(differences(after, before), after);
        ASSERT_TRUE(back.ok()) << back.error().what;
        EXPECT_EQ(format_json(back.value()), format_plan(first, "p.plan.json").value());
        if (testing::Test::HasFailure()) return;
    }
    for (const size_t count : kinds) EXPECT_GT(count, 100u);  // nothing was compared with itself
}

}  // namespace
}  // namespace vagus::plan
