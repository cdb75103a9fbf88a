// Rules P15 to P28 of docs/plans.md in the pure machine. The lines of the traces were worked out by
// hand from the rules.
#include "plan/machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/test_change.hpp"

namespace vagus::plan {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Two global supervisors; "drive" has two of its own; "turn" is the last.
const std::string kMain = R"({
  "format": "vagus-plan/1",
  "name": "Main",
  "configuration": {
    "n": { "type": "int", "initial": 5 },
    "way": { "type": "int", "initial": 1 }
  },
  "start": { "actor": "drive", "supervisors": {
    "stop": { "template": "See", "events": { "Seen": "turn" } },
    "end": { "template": "See", "events": { "Seen": "@terminate" } } } },
  "actors": {
    "drive": { "template": "Drive", "in": { "speed": "n" }, "out": { "way": "way" },
      "states": { "Done": "turn" }, "supervisors": {
        "wall": { "template": "See", "in": { "limit": "n + 1" }, "out": { "what": "n" },
          "events": { "Seen": "turn" } },
        "peek": { "template": "See", "out": { "what": "n" }, "events": { "Seen": "@ignore" } } } },
    "turn": { "template": "Turn", "in": { "speed": "n * 2" }, "states": { "Done": "@terminate" } }
  }
})";

const std::string kOuter = R"({
  "format": "vagus-plan/1",
  "name": "Outer",
  "configuration": { "given": { "type": "int", "initial": 7 },
    "both": { "type": "int", "initial": 1 } },
  "start": { "actor": "call" },
  "actors": {
    "call": { "plan": "inner.plan.json", "in": { "from": "given + 1" }, "out": { "to": "given" },
      "states": { "OK": "after", "Interrupted": "@terminate", "Error": "after" },
      "supervisors": { "wall": { "template": "See", "events": { "Seen": "after" } } } },
    "after": { "template": "Drive", "in": { "speed": "given" }, "states": { "Done": "@terminate" } }
  }
})";
const std::string kInner = R"({
  "format": "vagus-plan/1",
  "name": "Inner",
  "configuration": { "from": { "type": "int", "access": "in" },
    "to": { "type": "int", "initial": 0, "access": "out" },
    "both": { "type": "int", "access": "shared" } },
  "start": { "actor": "go", "supervisors": {
    "quit": { "template": "See", "events": { "Seen": "@terminate" } } } },
  "actors": {
    "go": { "template": "Drive", "in": { "speed": "from" }, "out": { "way": "to" },
      "states": { "Done": "@terminate" } }
  }
})";

struct Nested : Running {
    Nested() : Running(Texts{{"o.plan.json", kOuter}, {"inner.plan.json", kInner}}) {
        begin();  // the call
    }
};

// ---- one plan ----

TEST(PlanMachine, StartsGlobalSupervisorsThenThoseOfTheActorInFileOrder) {  // P15, P16
    const Checked checked =
        check("main.plan.json", ChangeTexts({{"main.plan.json", kMain}}), change_library());
    ASSERT_TRUE(checked.ok());
    const Graph graph = make_graph(checked);
    Machine machine(graph);
    machine.start({{0, Value(int64_t{9})}}, Time{0});
    std::vector<std::string> commands;
    for (const Command& command : machine.take_commands()) {
        if (const auto* watch = std::get_if<StartWatch>(&command)) {
            commands.push_back(watch->supervisor->name);
        } else {
            commands.emplace_back(std::holds_alternative<Activate>(command) ? "activate" : "other");
        }
    }
    EXPECT_THAT(commands, ElementsAre("stop", "end", "wall", "peek", "activate"));
    std::vector<std::string> kinds;
    for (const TraceEvent& event : machine.take_trace()) {
        const auto* write = std::get_if<VariableWritten>(&event.what);
        kinds.push_back(write ? std::string(write->variable) + " " + std::string(write->by)
                              : "plan-start");
    }
    EXPECT_THAT(kinds, ElementsAre("plan-start", "n initial", "way initial", "n outside"));
    EXPECT_EQ(machine.phase_at(0), Phase::Pending);
}

TEST(PlanMachine, AStateWritesTheOutputsAndLeadsOn) {  // P17
    Running run(kMain);
    run.begin();
    EXPECT_THAT(run.trace(), ElementsAre("Main actor-start drive speed:5,limit:0"));
    run.end(3);
    EXPECT_THAT(run.trace(), ElementsAre("Main actor-end drive turn", "Main write way 3 drive"));
    EXPECT_FALSE(run.watches("wall") || run.watches("peek"));
    EXPECT_TRUE(run.watches("stop") && run.watches("end"));
    run.begin();
    EXPECT_THAT(run.trace(), ElementsAre("Main actor-start turn speed:10,limit:0"));
}

TEST(PlanMachine, AnOutputThatWasNotSetIsNotWritten) {  // P17a
    Running run(kMain);
    run.begin();
    run.trace();
    run.machine().end(run.machine().activation_at(0), {0, {std::nullopt}}, 10ms);
    run.begin();
    EXPECT_THAT(run.trace(),
                ElementsAre("Main actor-end drive turn", "Main actor-start turn speed:10,limit:0"));
    EXPECT_EQ(run.value("way"), "1");
}

TEST(PlanMachine, AnEventInterruptsWritesWhatTheSupervisorSawAndWaitsForTheCode) {  // P18, P14
    Running run(kMain);
    run.let_linger();
    run.begin();
    run.trace();
    run.raise("wall", 7);
    EXPECT_THAT(run.trace(), ElementsAre("Main event wall turn", "Main write n 7 wall"));
    EXPECT_EQ(run.machine().phase_at(0), Phase::Stopping);
    EXPECT_EQ(run.machine().actor_at(0)->name, "drive");
    run.end(3);  // too late: its outputs are dropped (P20)
    EXPECT_THAT(run.trace(), IsEmpty());
    run.stopped();
    EXPECT_THAT(run.trace(), ElementsAre("Main interrupted drive"));
    EXPECT_EQ(run.value("way"), "1");
    run.begin();
    EXPECT_THAT(run.trace(), ElementsAre("Main actor-start turn speed:14,limit:0"));
}

TEST(PlanMachine, AnEventBeforeTheCodeHasBegunNeverStartsIt) {  // P16
    Running run(kMain);
    run.raise("wall", 6);
    EXPECT_THAT(run.trace(), ElementsAre("Main event wall turn", "Main write n 6 wall",
                                         "Main interrupted drive"));
    EXPECT_EQ(run.machine().actor_at(0)->name, "turn");
}

TEST(PlanMachine, AnIgnoredEventLeavesItsLineAndNothingElse) {  // P19
    Running run(kMain);
    run.begin();
    run.trace();
    run.raise("peek", 8);
    run.raise("peek", 9);
    EXPECT_THAT(run.trace(), ElementsAre("Main event peek @ignore", "Main event peek @ignore"));
    EXPECT_EQ(run.value("n"), "5");
    EXPECT_EQ(run.machine().phase_at(0), Phase::Running);
}

TEST(PlanMachine, OfAllThatEndAnActivationTheFirstWins) {  // P20
    Running run(kMain);
    run.begin();
    const ActivationId drive = run.machine().activation_at(0);
    run.end(3);
    run.begin();
    run.trace();
    run.machine().end(drive, {0, {Value(int64_t{4})}}, 10ms);
    run.machine().stopped(drive, 10ms);
    EXPECT_THAT(run.trace(), IsEmpty());
    EXPECT_EQ(run.value("way"), "3");
    EXPECT_EQ(run.machine().actor_at(0)->name, "turn");
}

TEST(PlanMachine, AGlobalSupervisorRestsDuringItsRemedyAndStartsAgainBehindIt) {  // P23
    const std::string circle =
        with(kMain, R"("in": { "speed": "n * 2" }, "states": { "Done": "@terminate" })",
             R"("in": { "speed": "n * 2" }, "states": { "Done": "drive" })");
    Running run(circle);
    run.begin();
    run.raise("stop");
    run.begin();
    EXPECT_FALSE(run.watches("stop"));
    EXPECT_TRUE(run.watches("end"));
    run.end();
    EXPECT_TRUE(run.watches("stop"));
    EXPECT_TRUE(run.watches("wall"));
}

TEST(PlanMachine, TerminateIsOkFromAStateAndInterruptedFromAnEvent) {  // P24
    Running by_state(kMain);
    by_state.begin();
    by_state.end(1);
    by_state.begin();
    by_state.trace();
    by_state.end();
    EXPECT_THAT(by_state.trace(),
                ElementsAre("Main actor-end turn @terminate", "Main plan-end OK"));
    EXPECT_TRUE(by_state.machine().over());
    EXPECT_FALSE(by_state.watches("stop") || by_state.watches("end"));

    Running by_event(kMain);
    by_event.begin();
    by_event.trace();
    by_event.raise("end");
    EXPECT_THAT(by_event.trace(), ElementsAre("Main event end @terminate", "Main interrupted drive",
                                              "Main plan-end Interrupted"));
    EXPECT_EQ(by_event.machine().result(), PlanResult::Interrupted);
}

TEST(PlanMachine, CodeThatFailsEndsThePlanWithItsName) {  // P27
    Running run(kMain);
    run.begin();
    run.trace();
    run.machine().fail(run.machine().activation_at(0), "no motor", 10ms);
    EXPECT_EQ(run.machine().result(), PlanResult::Error);
    EXPECT_THAT(run.machine().message(),
                testing::AllOf(testing::HasSubstr("Main"), testing::HasSubstr("drive"),
                               testing::HasSubstr("no motor")));
}

TEST(PlanMachine, AnAbortHasNoEventAndIsInterrupted) {  // P28
    Running run(kMain);
    run.begin();
    run.trace();
    run.machine().abort(10ms);
    run.stopped();
    EXPECT_THAT(run.trace(), ElementsAre("Main interrupted drive", "Main plan-end Interrupted"));
}

TEST(PlanMachine, CodeThatOverstaysEndsTheRun) {  // P27a
    Running run(kMain);
    run.let_linger();
    run.begin();
    run.raise("wall", 6);
    run.machine().overstayed(run.machine().activation_at(0), 10ms);
    EXPECT_TRUE(run.machine().over());
    EXPECT_EQ(run.machine().result(), PlanResult::Error);
    EXPECT_THAT(run.machine().message(), testing::HasSubstr("drive"));
}

// ---- plans inside one another ----

TEST(PlanMachine, ASubPlanGetsItsInputsAndGivesItsOutputsInOneStep) {  // P25, P26
    Nested run;
    EXPECT_EQ(run.value("from", 1), "8");  // given + 1
    run.begin();                           // go
    run.trace();
    run.end(4);
    EXPECT_THAT(run.trace(), ElementsAre("Outer/call actor-end go @terminate",
                                         "Outer/call write to 4 go", "Outer/call plan-end OK"));
    EXPECT_EQ(run.value("given"), "7");  // not before the actor of the caller ends
    run.end_sub_plan();
    run.begin();
    EXPECT_THAT(run.trace(), ElementsAre("Outer actor-end call after", "Outer write given 4 call",
                                         "Outer actor-start after speed:4,limit:0"));
}

TEST(PlanMachine, AnInterruptedSubPlanGivesItsOutputsTooAndGoesOnAtThatState) {  // P25, P26
    Nested run;
    run.begin();
    run.trace();
    run.raise("quit");
    run.end_sub_plan();
    EXPECT_THAT(run.trace(),
                ElementsAre("Outer/call event quit @terminate", "Outer/call interrupted go",
                            "Outer/call plan-end Interrupted", "Outer actor-end call @terminate",
                            "Outer write given 0 call", "Outer plan-end OK"));
}

TEST(PlanMachine, ASubPlanThatFailsGivesNothingAndTheCallerGoesOnAtError) {  // P25, P27
    Nested run;
    run.begin();
    run.machine().fail(run.machine().activation_at(1), "no motor", 10ms);
    run.end_sub_plan();
    EXPECT_EQ(run.machine().actor_at(0)->name, "after");
    EXPECT_EQ(run.value("given"), "7");
    EXPECT_FALSE(run.machine().over());
}

TEST(PlanMachine, TheCallersSupervisorInterruptsFromTheInsideOutwards) {  // P25a
    Nested run;
    run.begin();
    run.trace();
    run.raise("wall");
    EXPECT_THAT(run.trace(),
                ElementsAre("Outer event wall after", "Outer/call interrupted go",
                            "Outer/call plan-end Interrupted", "Outer interrupted call"));
    EXPECT_EQ(run.value("given"), "7");
    EXPECT_EQ(run.machine().depth(), 1);
    EXPECT_FALSE(run.watches("quit"));
}

TEST(PlanMachine, ASharedVariableIsTheCallers) {  // P5, P25
    Nested run;
    ASSERT_TRUE(run.machine().write_outside(1, 2, Value(int64_t{12}), 10ms).ok());
    EXPECT_EQ(run.value("both", 0), "12");
}

}  // namespace
}  // namespace vagus::plan
