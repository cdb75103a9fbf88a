// P31 of docs/plans.md for plans inside one another. The lines were worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/test_change.hpp"

namespace vagus::plan {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Calls the inner plan; "both" is shared with it.
const std::string kChangedOuter = R"({
  "format": "vagus-plan/1",
  "name": "Outer",
  "configuration": { "both": { "type": "int", "initial": 1 },
    "given": { "type": "int", "initial": 7 } },
  "start": { "actor": "call" },
  "actors": {
    "call": { "plan": "inner.plan.json", "in": { "from": "given" }, "out": { "to": "given" },
      "states": { "OK": "after", "Interrupted": "after", "Error": "after" },
      "supervisors": { "wall": { "template": "See", "events": { "Seen": "after" } } } },
    "after": { "template": "Drive", "in": { "speed": "given" }, "states": { "Done": "@terminate" } }
  }
})";
const std::string kChangedInner = R"({
  "format": "vagus-plan/1",
  "name": "Inner",
  "configuration": { "from": { "type": "int", "access": "in" },
    "to": { "type": "int", "initial": 0, "access": "out" },
    "both": { "type": "int", "access": "shared" },
    "own": { "type": "int", "initial": 3 } },
  "start": { "actor": "go", "supervisors": {
    "fire": { "template": "See", "events": { "Seen": "back" } } } },
  "actors": {
    "go": { "template": "Drive", "in": { "speed": "own" }, "out": { "way": "to" },
      "states": { "Done": "@terminate" } },
    "back": { "template": "Turn", "states": { "Done": "go" } }
  }
})";

Texts nested() {
    return {{"o.plan.json", kChangedOuter}, {"inner.plan.json", kChangedInner}};
}

// The inner plan is at "go"; nothing of how it came there is in the trace.
struct InsideTheInnerPlan : Running {
    InsideTheInnerPlan() : Running(nested()) {
        begin();  // the call
        begin();  // go
        trace();
    }
};

TEST(HotChange, AnInnerPlanChangesAndTheOuterDoesNot) {
    InsideTheInnerPlan run;
    const std::string next =
        with(kChangedInner, R"("own": {)", R"("new": { "type": "int", "initial": 2 }, "own": {)");
    EXPECT_THAT(run.change(Texts{{"inner.plan.json", next}}), IsEmpty());
    EXPECT_THAT(run.trace(), ElementsAre("Outer/call change", "Outer/call write new 2 change"));
    EXPECT_EQ(run.value("own", 1), "3");
    EXPECT_EQ(run.value("from", 1), "7");
}

TEST(HotChange, WhileTheOuterChangesASharedVariableStaysOne) {
    InsideTheInnerPlan run;
    const std::string next =
        with(kChangedOuter, R"("both": {)", R"("first": { "type": "int" }, "both": {)");
    EXPECT_THAT(run.change(Texts{{"o.plan.json", next}}), IsEmpty());
    EXPECT_THAT(run.trace(), ElementsAre("Outer change", "Outer write first 0 change"));
    ASSERT_TRUE(run.machine().write_outside(1, 2, Value(int64_t{12}), 10ms).ok());
    EXPECT_EQ(run.value("both", 1), "12");
    EXPECT_EQ(run.value("both", 0), "12");
}

TEST(HotChange, BothFilesTogetherAreOneChangeAndANewSharedVariableIsTheCallers) {
    InsideTheInnerPlan run;
    const std::string outer = with(kChangedOuter, R"("given": {)",
                                   R"("more": { "type": "int", "initial": 6 }, "given": {)");
    const std::string inner = with(kChangedInner, R"("own": {)",
                                   R"("more": { "type": "int", "access": "shared" }, "own": {)");
    EXPECT_THAT(run.change(Texts{{"o.plan.json", outer}, {"inner.plan.json", inner}}), IsEmpty());
    EXPECT_THAT(run.trace(),
                ElementsAre("Outer change", "Outer write more 6 change", "Outer/call change"));
    EXPECT_EQ(run.value("more", 1), "6");
}

TEST(HotChange, AnInnerPlanThatIsRefusedNamesItsInstance) {
    Running run(nested());
    run.begin();
    run.begin();
    const std::string next =
        with(kChangedInner, R"("go": { "template": "Drive")", R"("go": { "template": "Turn")");
    EXPECT_THAT(run.change(Texts{{"inner.plan.json", next}}),
                ElementsAre(HasSubstr("Outer/call: the actor \"go\" is active")));
}

TEST(HotChange, ACallOfAnotherPlanIsRefusedWhileItRuns) {
    Running run(nested());
    run.begin();
    run.begin();
    const std::string next =
        with(kChangedOuter, R"("plan": "inner.plan.json")", R"("plan": "other.plan.json")");
    EXPECT_THAT(run.change(Texts{{"o.plan.json", next}, {"other.plan.json", kChangedInner}}),
                ElementsAre(AllOf(HasSubstr("the actor \"call\" is active as the plan inner"),
                                  HasSubstr("other.plan.json"))));
}

TEST(HotChange, AFileThatDoesNotRunNowIsTakenAndTheOutermostPlanTellsIt) {
    Running run(nested());
    run.begin();
    run.begin();
    run.raise("wall");  // the call is over
    run.begin();
    run.trace();
    // Even its type: no such plan runs.
    const std::string next = with(kChangedInner, R"("own": { "type": "int", "initial": 3 })",
                                  R"("own": { "type": "string", "initial": "3" })");
    EXPECT_THAT(run.change(Texts{{"inner.plan.json", next}}), IsEmpty());
    EXPECT_THAT(run.trace(), ElementsAre("Outer change"));
}

TEST(HotChange, AVersionOfAnInnerPlanComesBeforeItsCallBegins) {
    Running run(nested());  // the call is active, its begin is due
    const std::string next = with(kChangedInner, R"("initial": 3)", R"("initial": 33)");
    EXPECT_THAT(run.change(Texts{{"inner.plan.json", next}}), IsEmpty());
    run.trace();
    run.begin();
    EXPECT_THAT(run.trace(), testing::Contains("Outer/call write own 33 initial"));
    EXPECT_EQ(run.value("from", 1), "7");
}

TEST(HotChange, WhatAnInnerPlanGivesIsOfItsNewestVersion) {
    Running run(nested());
    run.begin();
    run.begin();
    const std::string next =
        with(kChangedInner, R"("to": {)", R"("pad": { "type": "int" }, "to": {)");
    EXPECT_THAT(run.change(Texts{{"inner.plan.json", next}}), IsEmpty());
    run.end(21);  // its output "to"
    run.end_sub_plan();
    EXPECT_EQ(run.value("given"), "21");
}

TEST(HotChange, GlobalSupervisorsDoNotStartInAPlanThatIsBeingEnded) {
    Running run(nested());
    run.begin();
    run.begin();
    run.let_linger();
    run.raise("wall");  // of the outer plan: the inner one is being ended
    const std::string next =
        with(kChangedInner, R"("fire": {)",
             R"("new": { "template": "See", "events": { "Seen": "back" } }, "fire": {)");
    EXPECT_THAT(run.change(Texts{{"inner.plan.json", next}}), IsEmpty());
    EXPECT_FALSE(run.watches("new"));
    run.trace();
    run.stopped();
    EXPECT_THAT(run.trace(),
                ElementsAre("Outer/call interrupted go", "Outer/call plan-end Interrupted",
                            "Outer interrupted call"));
}

TEST(HotChange, APlanInsideItselfChangesInEachOfItsInstances) {
    const std::string self = R"({ "format": "vagus-plan/1", "name": "Self",
      "configuration": { "n": { "type": "int", "initial": 1 } },
      "start": { "actor": "again" },
      "actors": { "again": { "plan": "o.plan.json", "in": {},
        "states": { "OK": "@terminate", "Interrupted": "@terminate",
          "Error": "@terminate" } } } })";
    Running run(Texts{{"o.plan.json", self}});
    run.begin();
    run.begin();
    run.trace();
    const std::string next = with(self, R"("n": {)", R"("m": { "type": "int" }, "n": {)");
    EXPECT_THAT(run.change(Texts{{"o.plan.json", next}}), IsEmpty());
    EXPECT_THAT(run.trace(),
                ElementsAre("Self change", "Self write m 0 change", "Self/again change",
                            "Self/again write m 0 change", "Self/again/again change",
                            "Self/again/again write m 0 change"));
}

}  // namespace
}  // namespace vagus::plan
