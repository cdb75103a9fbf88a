#include "serve/run/plan_breakpoints.hpp"

#include "serve/json.hpp"

#include <gtest/gtest.h>

namespace vagus::serve {
namespace {

PlanBreakpoint at_actor(const std::string& actor) {
    PlanBreakpoint one;
    one.doc = "W.plan.json";
    one.kind = "actor";
    one.element = actor;
    return one;
}

TEST(PlanBreakpoints, OneAPlaceIsChangedWhereItStands) {
    PlanBreakpoints all;
    const uint64_t number = all.set(at_actor("go")).value()->number;
    PlanBreakpoint changed = at_actor("go");
    changed.condition = "n > 2";
    EXPECT_EQ(all.set(changed).value()->number, number);
    ASSERT_EQ(all.all().size(), 1u);
    EXPECT_EQ(all.all()[0].condition, "n > 2");

    PlanBreakpoint when = at_actor("");
    when.kind = "condition";
    when.condition = "n == 1";
    const uint64_t second = all.set(when).value()->number;
    when.number = second;
    when.condition = "n == 2";
    EXPECT_TRUE(all.set(when).ok());
    EXPECT_EQ(all.all()[1].condition, "n == 2");
    EXPECT_EQ(all.all().size(), 2u);
}

TEST(PlanBreakpoints, WhatLacksItsPlaceIsRefused) {
    PlanBreakpoints all;
    EXPECT_EQ(all.set(at_actor("")).error().what,
              "a breakpoint on an actor needs the name of the actor");
    PlanBreakpoint when = at_actor("");
    when.kind = "condition";
    EXPECT_EQ(all.set(when).error().what, "a breakpoint on a condition needs one, as distance < 5");
    PlanBreakpoint gone = at_actor("go");
    gone.number = 7;
    EXPECT_EQ(all.set(gone).error().code, Code::NotFound);
}

TEST(PlanBreakpoints, OneMoreThanTheLimitIsRefused) {
    PlanBreakpoints all;
    for (size_t i = 0; i < kPlanBreakpointsMax; ++i) {
        ASSERT_TRUE(all.set(at_actor("a" + std::to_string(i))).ok());
    }
    EXPECT_EQ(all.set(at_actor("more")).error().code, Code::Limit);
}

TEST(PlanBreakpoints, AreKeptWithoutWhatBelongsToARun) {
    PlanBreakpoints all;
    PlanBreakpoint one = at_actor("go");
    one.stop_at = 3;
    one.enabled = false;
    const uint64_t number = all.set(one).value()->number;
    EXPECT_TRUE(all.note({{.number = number, .hits = 4, .set = true, .why = ""}}));
    EXPECT_EQ(all.list()[0]["hits"], 4);

    const Json kept = all.to_json();
    EXPECT_EQ(kept, Json::parse(R"([{"doc": "W.plan.json", "kind": "actor", "element": "go",
                                     "stop_at": 3, "enabled": false}])"));
    PlanBreakpoints read;
    read.from_json(kept);
    read.from_json(Json::parse(R"([1, {"doc": "W.plan.json", "kind": "moon", "element": "x"}])"));
    ASSERT_EQ(read.all().size(), 1u);
    EXPECT_EQ(read.all()[0].stop_at, 3u);
    EXPECT_EQ(read.all()[0].hits, 0u);
    EXPECT_FALSE(read.all()[0].enabled);
}

TEST(PlanBreakpoints, FollowTheNewNameOfAFile) {
    PlanBreakpoints all;
    (void)all.set(at_actor("go")).ok();
    all.rename("W.plan.json", "plans/W.plan.json");
    all.rename("plans/W", "no");
    EXPECT_EQ(all.all()[0].doc, "plans/W.plan.json");
    all.clear(std::nullopt, "W.plan.json");
    EXPECT_EQ(all.all().size(), 1u);
    all.clear(all.all()[0].number, std::nullopt);
    EXPECT_TRUE(all.all().empty());
}

}  // namespace
}  // namespace vagus::serve
