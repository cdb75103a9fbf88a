// P31 of docs/plans.md in the pure machine, sentence by sentence: what is refused, what takes over,
// what the trace says. The texts are here; the lines were worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/test_change.hpp"

namespace vagus::plan {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// drive and turn take turns, both under two global supervisors; each has one of its own.
const std::string kChangedMain = R"({
  "format": "vagus-plan/1",
  "name": "Main",
  "configuration": {
    "n": { "type": "int", "initial": 5 },
    "f": { "type": "float", "initial": 1.5 },
    "way": { "type": "int", "initial": 0 }
  },
  "start": { "actor": "drive", "supervisors": {
    "stop": { "template": "See", "in": { "limit": "n" }, "events": { "Seen": "turn" } },
    "end": { "template": "See", "events": { "Seen": "@terminate" } } } },
  "actors": {
    "drive": { "template": "Drive", "in": { "speed": "n" }, "out": { "way": "way" },
      "states": { "Done": "turn" }, "supervisors": {
        "wall": { "template": "See", "period_ms": 20, "in": { "limit": "n + 1" },
          "out": { "what": "n" }, "events": { "Seen": "turn" } } } },
    "turn": { "template": "Turn", "in": { "speed": "n * 2" }, "states": { "Done": "drive" } },
    "rest": { "template": "Drive", "states": { "Done": "@terminate" } }
  }
})";

// ---- what takes over ----

TEST(HotChange, OneThatChangesNothingLeavesOneLine) {
    Running run(kChangedMain);
    run.begin();
    run.trace();
    EXPECT_THAT(run.change(kChangedMain), IsEmpty());
    EXPECT_THAT(run.trace(), ElementsAre("Main change"));
    EXPECT_TRUE(run.watches("stop") && run.watches("end") && run.watches("wall"));
}

TEST(HotChange, VariablesKeepTheirValuesNewOnesBeginAndThoseThatAreGoneVanish) {
    Running run(kChangedMain);
    run.begin();
    ASSERT_TRUE(run.machine().write_outside(0, Value(int64_t{9}), 10ms).ok());
    run.trace();
    // f is gone, two are new, one of them before n: it has n's place in the list.
    std::string next = with(kChangedMain, R"("f": { "type": "float", "initial": 1.5 },)", "");
    next = with(next, R"("n": {)", R"("a": { "type": "string", "initial": "x" }, "n": {)");
    next = with(next, R"("way": {)", R"("z": { "type": "bool" }, "way": {)");
    EXPECT_THAT(run.change(next), IsEmpty());
    EXPECT_THAT(run.trace(), ElementsAre("Main write n 9 outside", "Main change",
                                         "Main write a x change", "Main write z false change"));
    EXPECT_EQ(run.value("n"), "9");
    EXPECT_EQ(run.value("way"), "0");
    EXPECT_EQ(run.value("f"), "gone");
}

TEST(HotChange, NewGlobalSupervisorsStart) {
    Running run(kChangedMain);
    run.begin();
    const std::string next = with(kChangedMain, R"("stop": {)",
                                  R"("first": { "template": "See", "in": { "limit": 4 },
                                     "events": { "Seen": "rest" } }, "stop": {)");
    EXPECT_THAT(run.change(next), IsEmpty());
    ASSERT_TRUE(run.watches("first"));
    EXPECT_EQ(run.limit_of("first"), "4");
    run.trace();
    run.raise("first");
    EXPECT_EQ(run.trace().front(), "Main event first rest");
}

TEST(HotChange, AGlobalSupervisorThatRestsMayGoAndDoesNotStartAnew) {
    Running run(kChangedMain);
    run.begin();
    run.raise("stop");  // to turn, its remedy: it rests
    run.begin();
    const std::string next = with(
        kChangedMain,
        R"("stop": { "template": "See", "in": { "limit": "n" }, "events": { "Seen": "turn" } },)",
        "");
    EXPECT_THAT(run.change(next), IsEmpty());
    run.end();  // to drive: with it the supervisor would have started again
    EXPECT_FALSE(run.watches("stop"));
    EXPECT_TRUE(run.watches("end"));
}

TEST(HotChange, AGlobalSupervisorThatRestsStartsAnewAsTheNewVersionSays) {
    Running run(kChangedMain);
    run.begin();
    run.raise("stop");
    run.begin();
    const std::string next =
        with(kChangedMain, R"("stop": { "template": "See", "in": { "limit": "n" })",
             R"("stop": { "template": "Hear", "period_ms": 50, "in": { "limit": "n + 30" })");
    EXPECT_THAT(run.change(next), IsEmpty());
    run.end();
    EXPECT_EQ(run.limit_of("stop"), "35");
}

TEST(HotChange, TargetsAreThoseOfTheNewVersionAtOnce) {
    const std::string state =
        with(kChangedMain, R"("states": { "Done": "turn" })", R"("states": { "Done": "rest" })");
    Running by_state(kChangedMain);
    by_state.begin();
    EXPECT_THAT(by_state.change(state), IsEmpty());
    by_state.end();
    EXPECT_EQ(by_state.trace().back(), "Main write way 0 drive");
    EXPECT_EQ(by_state.machine().actor_at(0)->name, "rest");

    const std::string own =
        with(kChangedMain, R"("out": { "what": "n" }, "events": { "Seen": "turn" })",
             R"("out": { "what": "n" }, "events": { "Seen": "rest" })");
    Running by_own(kChangedMain);
    by_own.begin();
    EXPECT_THAT(by_own.change(own), IsEmpty());
    by_own.raise("wall");
    EXPECT_EQ(by_own.machine().actor_at(0)->name, "rest");

    const std::string global =
        with(kChangedMain, R"("in": { "limit": "n" }, "events": { "Seen": "turn" })",
             R"("in": { "limit": "n" }, "events": { "Seen": "@ignore" })");
    Running by_global(kChangedMain);
    by_global.begin();
    EXPECT_THAT(by_global.change(global), IsEmpty());
    by_global.trace();
    by_global.raise("stop");
    EXPECT_THAT(by_global.trace(), ElementsAre("Main event stop @ignore"));
    EXPECT_EQ(by_global.machine().actor_at(0)->name, "drive");
}

TEST(HotChange, WhatAnActivationWasStartedWithStaysUntilItsEnd) {
    // Other formulas everywhere, another variable for the output, another supervisor beside "wall".
    std::string next = with(kChangedMain, R"("limit": "n + 1")", R"("limit": "n + 100")");
    next = with(next, R"("in": { "limit": "n" }, "events")",
                R"("in": { "limit": "n + 200" }, "events")");
    next = with(next, R"("out": { "way": "way" })", R"("out": { "way": "n" })");
    next = with(next, R"("in": { "speed": "n" })", R"("in": { "speed": "n + 300" })");
    next = with(next, R"("wall": {)",
                R"("more": { "template": "See", "events": { "Seen": "rest" } }, "wall": {)");
    Running run(
        kChangedMain);  // drive is active, and its begin is due: it was started with the old one
    EXPECT_THAT(run.change(next), IsEmpty());
    EXPECT_FALSE(run.watches("more"));
    EXPECT_EQ(run.limit_of("wall"), "6");
    EXPECT_EQ(run.limit_of("stop"), "5");
    run.trace();
    run.begin();
    EXPECT_EQ(run.trace().front(), "Main actor-start drive speed:5,limit:0");
    run.end(8);
    EXPECT_EQ(run.value("way"), "8");
    EXPECT_EQ(run.value("n"), "5");
    // From the next activation on all is new.
    EXPECT_EQ(run.limit_of("stop"), "205");
    run.begin();
    run.end();
    EXPECT_TRUE(run.watches("more"));
    EXPECT_EQ(run.limit_of("wall"), "105");
    run.trace();
    run.begin();
    EXPECT_EQ(run.trace().front(), "Main actor-start drive speed:305,limit:0");
    run.end(8);
    EXPECT_EQ(run.value("n"), "8");
}

TEST(HotChange, WhatWasStartedBeforeStillReadsAVariableThatIsGoneAndItsOutputIsDropped) {
    std::string next = with(kChangedMain, R"("n": { "type": "int", "initial": 5 },)", "");
    next = with(next, R"("way": { "type": "int", "initial": 0 })",
                R"("m": { "type": "int", "initial": 40 })");
    next = with(next, R"("limit": "n + 1")", R"("limit": "m")");
    next = with(next, R"("in": { "limit": "n" }, "events")", R"("in": { "limit": "m" }, "events")");
    next = with(next, R"("out": { "way": "way" })", "\"out\": {}");
    next = with(next, R"("out": { "what": "n" })", R"("out": { "what": "m" })");
    next = with(next, R"("in": { "speed": "n" })", R"("in": { "speed": "m" })");
    next = with(next, R"("in": { "speed": "n * 2" })", R"("in": { "speed": "m" })");
    Running run(kChangedMain);
    run.begin();
    EXPECT_THAT(run.change(next), IsEmpty());
    EXPECT_EQ(run.limit_of("wall"), "6");
    run.trace();
    run.raise("wall", 77);
    EXPECT_THAT(run.trace(), ElementsAre("Main event wall turn", "Main interrupted drive"));
    run.begin();
    EXPECT_EQ(run.trace().front(), "Main actor-start turn speed:40,limit:0");
}

// ---- what is refused ----

TEST(HotChange, AVariableOfAnotherTypeOrAccessIsRefused) {
    Running run(kChangedMain);
    run.begin();
    run.trace();
    std::string next = with(kChangedMain, R"("f": { "type": "float", "initial": 1.5 })",
                            R"("f": { "type": "int", "initial": 1 })");
    next = with(next, R"("way": { "type": "int", "initial": 0 })",
                R"("way": { "type": "int", "initial": 0, "access": "out" })");
    EXPECT_THAT(run.change(next), ElementsAre(AllOf(HasSubstr("Main: the variable \"f\""),
                                                    HasSubstr("float"), HasSubstr("says int")),
                                              AllOf(HasSubstr("\"way\""), HasSubstr("says out"))));
    EXPECT_THAT(run.trace(), IsEmpty());
    EXPECT_EQ(run.value("f"), "1.5");
}

TEST(HotChange, AnActiveActorThatIsMissingOrAnotherIsRefused) {
    Running run(kChangedMain);
    run.begin();
    std::string gone = with(kChangedMain, R"("drive": {)", R"("ride": {)");
    gone = with(gone, R"({ "actor": "drive")", R"({ "actor": "ride")");
    gone = with(gone, R"("Done": "drive")", R"("Done": "ride")");
    EXPECT_THAT(run.change(gone), ElementsAre(HasSubstr("the actor \"drive\" is active")));
    EXPECT_THAT(run.change(with(kChangedMain, R"("drive": { "template": "Drive")",
                                R"("drive": { "template": "Turn")")),
                ElementsAre(AllOf(HasSubstr("as Drive"), HasSubstr("makes it Turn"))));
    EXPECT_THAT(run.change(with(kChangedMain, R"("in": { "speed": "n" })",
                                R"("in": { "speed": "n", "limit": 3 })")),
                ElementsAre(AllOf(HasSubstr("inputs speed,"), HasSubstr("feeds limit, speed"))));
    // One that is not active may change in any way.
    EXPECT_THAT(
        run.change(with(kChangedMain, R"("turn": { "template": "Turn", "in": { "speed": "n * 2" })",
                        R"("turn": { "template": "Drive", "in": {})")),
        IsEmpty());
    run.end();
    EXPECT_EQ(run.machine().actor_at(0)->of->name, "Drive");
}

TEST(HotChange, OneOfItsOwnSupervisorsThatIsMissingOrAnotherIsRefused) {
    Running run(kChangedMain);
    run.begin();
    const std::string own =
        R"("wall": { "template": "See", "period_ms": 20, "in": { "limit": "n + 1" })";
    const auto reasons = [&run, &own](const std::string& instead) {
        return run.change(with(kChangedMain, own, instead));
    };
    EXPECT_THAT(reasons(R"("door": { "template": "See", "period_ms": 20, "in": { "limit": 1 })"),
                ElementsAre(HasSubstr("the supervisor \"wall\" watches")));
    EXPECT_THAT(reasons(R"("wall": { "template": "Hear", "period_ms": 20, "in": { "limit": 1 })"),
                ElementsAre(HasSubstr("makes it Hear")));
    EXPECT_THAT(reasons(R"("wall": { "template": "See", "period_ms": 30, "in": { "limit": 1 })"),
                ElementsAre(AllOf(HasSubstr("period_ms 20"), HasSubstr("says 30"))));
    EXPECT_THAT(reasons(R"("wall": { "template": "See", "period_ms": 20)"),
                ElementsAre(AllOf(HasSubstr("inputs limit"), HasSubstr("feeds none"))));
    run.end();  // turn is active
    EXPECT_THAT(reasons(R"("door": { "template": "Hear")"), IsEmpty());
}

TEST(HotChange, AGlobalSupervisorThatWatchesAndIsMissingOrAnotherIsRefusedWithEveryReason) {
    Running run(kChangedMain);
    run.begin();
    std::string next =
        with(kChangedMain, R"("stop": { "template": "See")", R"("stop": { "template": "Hear")");
    next = with(next, R"("end": {)", R"("fin": {)");
    next = with(next, R"("template": "Drive", "in": { "speed": "n" })",
                R"("template": "Turn", "in": {})");
    EXPECT_THAT(run.change(next),
                ElementsAre(HasSubstr("makes it Turn"), HasSubstr("feeds none"),
                            AllOf(HasSubstr("global supervisor \"stop\""), HasSubstr("Hear")),
                            HasSubstr("global supervisor \"end\" watches, and in the new")));
}

TEST(HotChange, BeforeTheStartAndAfterTheEndThereIsNothingToChange) {
    Running run(kChangedMain);
    run.begin();
    run.raise("end");
    ASSERT_TRUE(run.machine().over());
    EXPECT_THAT(run.change(kChangedMain), ElementsAre(HasSubstr("nothing to change")));
}

TEST(HotChange, OneMoreThanTheMostIsRefused) {
    Running run(kChangedMain);
    run.begin();
    for (size_t i = 0; i < kChangesMax; ++i) ASSERT_THAT(run.change(kChangedMain), IsEmpty());
    EXPECT_THAT(run.change(kChangedMain), ElementsAre(HasSubstr("1000 new versions")));
}

// ---- while an actor is being stopped ----

TEST(HotChange, WhileAnActorIsBeingStoppedWhatFollowsIsOfTheNewVersion) {
    Running run(kChangedMain);
    run.begin();
    run.let_linger();
    run.raise("wall");  // to turn
    const std::string next =
        with(kChangedMain, R"("in": { "speed": "n * 2" })", R"("in": { "speed": 60 })");
    EXPECT_THAT(run.change(next), IsEmpty());
    run.trace();
    run.stopped();
    run.begin();
    EXPECT_THAT(run.trace(),
                ElementsAre("Main interrupted drive", "Main actor-start turn speed:60,limit:0"));
}

TEST(HotChange, TheActorThatAnEventHasLedToIsNeeded) {
    Running run(kChangedMain);
    run.begin();
    run.let_linger();
    run.raise("wall");
    std::string next = kChangedMain;
    for (int i = 0; i < 3; ++i) next = with(next, R"(": "turn")", R"(": "rest")");
    next = with(next, R"("turn": {)", R"("spin": {)");
    EXPECT_THAT(run.change(next), ElementsAre(HasSubstr("the actor \"turn\" follows")));
}

}  // namespace
}  // namespace vagus::plan
