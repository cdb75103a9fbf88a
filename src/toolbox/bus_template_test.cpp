// Templates of toolbox files in plans: what they say on the bus, and what they make of answers.
#include "toolbox/bus_template.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "run/real_time.hpp"
#include "toolbox/bus.hpp"
#include "toolbox/test_scripted_nodes.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::toolbox {
namespace {

using namespace std::chrono_literals;
using run::BusEvent;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view kToolbox = R"({
  "format": "vagus-toolbox/1", "name": "cart", "project": "cart.aesl",
  "templates": {
    "Go": { "kind": "actor", "node": ["cart", "sled"],
      "in": {
        "far": { "type": "float", "unit": "cm", "scale": 10, "words": 2 },
        "speed": { "type": "float", "default": 20, "range": [0.1, 31], "scale": 10 } },
      "out": {
        "way": { "type": "int", "words": 2 },
        "hot": { "type": "bool" } },
      "start": "go", "stop": "halt", "stopped": "halted", "alive": "alive", "ended": "over",
      "states": {
        "There": { "event": "there", "out": ["way", "hot"] },
        "Lost": { "event": "lost" } } },
    "Ask": { "kind": "actor", "node": "cart", "start": "ask",
      "out": { "heat": { "type": "float", "scale": 10 } },
      "states": { "Told": { "event": "told", "out": ["heat"] } } },
    "CheckTouch": { "kind": "supervisor", "node": "skin",
      "out": { "angle": { "type": "float", "scale": 10 } },
      "start": "watch", "stop": "leave",
      "events": { "Touched": { "event": "touch", "out": ["angle"] } } }
  }
})";

class BusTemplates : public testing::Test {
protected:
    BusTemplates() {
        for (const char* node : {"cart", "skin"}) nodes_.appeared(node);
        const Result<ToolboxFile> file = read_toolbox(kToolbox, "cart.toolbox.json", {});
        EXPECT_TRUE(file.ok());
        add_core(library_);
        library_.add("cart", "", code_of(file.value(), parts_));
    }

    BusNodes nodes_;
    Parts parts_{.bus = &nodes_};
    run::CodeLibrary library_;
};

// One Go, then the end. `more` are further members of the actor.
std::string go_plan(const std::string& in, const std::string& more = "") {
    return R"({ "format": "vagus-plan/1", "name": "P", "toolboxes": ["cart"],
      "configuration": { "way": { "type": "int" }, "hot": { "type": "bool" },
        "angle": { "type": "float" } },
      "start": { "actor": "go" },
      "actors": {
        "go": { "template": "Go", "in": )" +
           in + R"(, "out": { "way": "way", "hot": "hot" },
          "states": { "There": "rest", "Lost": "rest" })" +
           more + R"( },
        "rest": { "template": "Wait", "in": { "seconds": "0.01" },
          "states": { "Done": "@terminate" } } } })";
}

// What a line of the trace holds, from its time on.
std::string at(const char* seconds, const std::string& kind) {
    return fmt::format("\"t\":{},\"plan\":\"P\",\"kind\":{}", seconds, kind);
}

const std::string kTouch = R"(, "supervisors": { "touch": { "template": "CheckTouch",
    "out": { "angle": "angle" }, "events": { "Touched": "rest" } } })";

// ---- an actor and its node ----

// -1000 cm are -10000 mm: 0xFFFFD8F0, low word 0xD8F0 = -10000, high word -1. 31 cm/s are 310.
TEST_F(BusTemplates, StartCarriesTokenAndInputsLowWordFirst) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "go") bus.send(5ms, {"there", {event.arguments[0], 0x1234, 2, 7}});
    });
    const Driven driven = drive(go_plan(R"({ "far": -1000, "speed": 31 })"), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Ok) << driven.ended.message;
    EXPECT_THAT(nodes.said, ElementsAre("0 go 1 -10000 -1 310"));
    // 2 * 65536 + 0x1234 = 135732
    EXPECT_THAT(driven.trace, testing::Contains(HasSubstr(
                                  R"("kind":"write","variable":"way","value":135732,"by":"go")")));
    EXPECT_THAT(driven.trace,
                testing::Contains(HasSubstr(
                    at("0.005000", R"("actor-end","actor":"go","activation":1,"state":"There")"))));
    EXPECT_THAT(driven.trace, testing::Contains(HasSubstr(R"("variable":"hot","value":true)")));
}

// Half away from zero: 0.25 cm are 2.5 mm, 3 of them; -0.25 cm are -3 mm.
TEST_F(BusTemplates, ScaledValuesAreRoundedHalfAwayFromZero) {
    for (const auto& [far, words] : {std::pair{"0.25", "3 0"}, std::pair{"-0.25", "-3 -1"}}) {
        ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
            if (event.name == "go") bus.send(1ms, {"lost", {event.arguments[0]}});
        });
        drive(go_plan("{ \"far\": " + std::string(far) + " }"), library_, nodes);
        EXPECT_THAT(nodes.said, ElementsAre("0 go 1 " + std::string(words) + " 200"));
    }
}

TEST_F(BusTemplates, AValueOutsideItsRangeIsAnInternalErrorThatNamesIt) {
    ScriptedNodes nodes([](ScriptedNodes&, const BusEvent&) {});
    // A constant outside of the range would be refused before the run; `way` begins at 0.
    const Driven driven = drive(go_plan(R"({ "far": 1, "speed": "way + 31.1" })"), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(driven.ended.message,
                HasSubstr("the input \"speed\" is 31.1, but must be from 0.1 to 31"));
    EXPECT_TRUE(nodes.said.empty());
}

// 2147483647 mm fit two words, 2147483648 do not.
TEST_F(BusTemplates, AValueThatDoesNotFitItsWordsIsAnInternalErrorThatNamesIt) {
    const auto end_at_once = [](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "go") bus.send(1ms, {"lost", {event.arguments[0]}});
    };
    ScriptedNodes fits(end_at_once);
    EXPECT_EQ(drive(go_plan(R"({ "far": 214748364.7 })"), library_, fits).ended.result,
              plan::PlanResult::Ok);
    EXPECT_THAT(fits.said, ElementsAre("0 go 1 -1 32767 200"));
    ScriptedNodes not_fits(end_at_once);
    const Driven driven = drive(go_plan(R"({ "far": 214748364.8 })"), library_, not_fits);
    EXPECT_THAT(driven.ended.message, HasSubstr("the input \"far\" is 214748364.8 cm, which does "
                                                "not fit two words on the bus"));
}

TEST_F(BusTemplates, AliveIsSaidEvery100MsWhileTheActorRuns) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "go") bus.send(350ms, {"there", {event.arguments[0], 0, 0, 0}});
    });
    drive(go_plan(R"({ "far": 1 })"), library_, nodes);
    EXPECT_THAT(nodes.said,
                ElementsAre("0 go 1 10 0 200", "100 alive 1", "200 alive 1", "300 alive 1"));
}

TEST_F(BusTemplates, OtherTokensAreIgnored) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name != "go") return;
        bus.send(5ms, {"there", {99, 0, 0, 0}});
        bus.send(6ms, {"there", {}});
        bus.send(7ms, {"lost", {event.arguments[0]}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
    EXPECT_THAT(driven.trace,
                testing::Contains(HasSubstr(
                    at("0.007000", R"("actor-end","actor":"go","activation":1,"state":"Lost")"))));
}

TEST_F(BusTemplates, AnAnswerWithTooFewWordsIsAnInternalErrorAndTheNodeIsToldToStop) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "go") bus.send(5ms, {"there", {event.arguments[0], 1}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
    EXPECT_THAT(driven.ended.message, HasSubstr("the event \"there\" came with 1 words"));
    EXPECT_THAT(nodes.said, ElementsAre("0 go 1 10 0 200", "5 halt 1"));
}

// ---- a node that has ended the work by itself ----

TEST_F(BusTemplates, WorkThatTheNodeHasEndedIsAnInternalError) {
    // By the token of the actor, or by that of a node that has forgotten whose work it was.
    for (const int16_t token : {int16_t{1}, int16_t{-1}}) {
        ScriptedNodes nodes([token](ScriptedNodes& bus, const BusEvent& event) {
            if (event.name == "go") bus.send(50ms, {"over", {token}});
        });
        const Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
        EXPECT_EQ(driven.ended.result, plan::PlanResult::Error);
        EXPECT_THAT(driven.ended.message,
                    HasSubstr("go: the node \"cart\" has ended the work by itself"));
        EXPECT_THAT(nodes.said, ElementsAre("0 go 1 10 0 200", "50 halt 1"));
    }
}

TEST_F(BusTemplates, WorkOfAnotherTokenThatTheNodeHasEndedIsNoMatter) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name != "go") return;
        bus.send(5ms, {"over", {99}});
        bus.send(6ms, {"over", {}});
        bus.send(7ms, {"lost", {event.arguments[0]}});
    });
    EXPECT_EQ(drive(go_plan(R"({ "far": 1 })"), library_, nodes).ended.result,
              plan::PlanResult::Ok);
}

// It has stopped, whatever it says about that: nobody waits for the answer to `stop`.
TEST_F(BusTemplates, AnActorThatIsStoppedIsOverWhenItsNodeHasEndedTheWork) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "watch") bus.send(50ms, {"touch", {event.arguments[0], 0}});
        if (event.name == "halt") bus.send(10ms, {"over", {-1}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })", kTouch), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Ok) << driven.ended.message;
}

// ---- interruption ----

// The touch comes at 50 ms; the wheels rest 30 ms after they were told. Only then the next actor
// starts (P14). Tokens: the supervisor started first and is 1; having raised, it stops first (P23).
TEST_F(BusTemplates, AnInterruptedActorIsOverWhenItsNodeHasStopped) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "watch") bus.send(50ms, {"touch", {event.arguments[0], -450}});
        if (event.name == "halt") {
            bus.send(10ms, {"halted", {77}});  // of somebody else
            bus.send(30ms, {"halted", {event.arguments[0]}});
        }
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })", kTouch), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Ok) << driven.ended.message;
    EXPECT_THAT(nodes.said, ElementsAre("0 watch 1", "0 go 2 10 0 200", "50 leave 1", "50 halt 2"));
    EXPECT_THAT(driven.trace,
                testing::Contains(HasSubstr(at(
                    "0.080000",
                    R"("interrupted","actor":"go","activation":1,"ran":true,"stop_us":30000)"))));
    EXPECT_THAT(driven.trace, testing::Contains(HasSubstr(R"("variable":"angle","value":-45,)")));
    EXPECT_THAT(driven.trace,
                testing::Contains(HasSubstr(at("0.080000", R"("actor-start","actor":"rest")"))));
}

// Grace time 2 s: the answer at 2050 ms is in time, the one a millisecond later is not.
TEST_F(BusTemplates, ANodeThatDoesNotStopWithinTheGraceTimeEndsTheRun) {
    for (const auto& [after, result] :
         {std::pair{2000ms, plan::PlanResult::Ok}, std::pair{2001ms, plan::PlanResult::Error}}) {
        ScriptedNodes nodes([after = after](ScriptedNodes& bus, const BusEvent& event) {
            if (event.name == "watch") bus.send(50ms, {"touch", {event.arguments[0], 0}});
            if (event.name == "halt") bus.send(after, {"halted", {event.arguments[0]}});
        });
        const Driven driven = drive(go_plan(R"({ "far": 1 })", kTouch), library_, nodes);
        EXPECT_EQ(driven.ended.result, result);
        if (result == plan::PlanResult::Error) {
            EXPECT_THAT(driven.ended.message,
                        HasSubstr("go: it did not stop within its grace time of 2000 ms"));
        }
    }
}

// Messages cross: the first Go is interrupted at 50 ms, and its `there` of 52 ms is on its way when
// the second has started at 51 ms. It belongs to what is over.
TEST_F(BusTemplates, AnArrivalOfTheActivationBeforeDoesNotEndTheNewOne) {
    const std::string plan = R"({ "format": "vagus-plan/1", "name": "P", "toolboxes": ["cart"],
      "start": { "actor": "first" },
      "actors": {
        "first": { "template": "Go", "in": { "far": 1 },
          "states": { "There": "@terminate", "Lost": "@terminate" },
          "supervisors": { "touch": { "template": "CheckTouch",
            "events": { "Touched": "second" } } } },
        "second": { "template": "Go", "in": { "far": 2 },
          "states": { "There": "@terminate", "Lost": "@terminate" } } } })";
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "watch") bus.send(50ms, {"touch", {event.arguments[0], 0}});
        if (event.name == "halt") {
            bus.send(1ms, {"halted", {event.arguments[0]}});
            bus.send(2ms, {"there", {event.arguments[0], 0, 0, 0}});
        }
        if (event.name == "go" && event.arguments[0] == 3) {
            bus.send(20ms, {"there", {event.arguments[0], 0, 0, 0}});
        }
    });
    const Driven driven = drive(plan, library_, nodes);
    EXPECT_THAT(nodes.said, ElementsAre("0 watch 1", "0 go 2 10 0 200", "50 leave 1", "50 halt 2",
                                        "51 go 3 20 0 200"));
    EXPECT_THAT(
        driven.trace,
        testing::Contains(HasSubstr(
            at("0.071000", R"("actor-end","actor":"second","activation":2,"state":"There")"))));
}

// A template without `stop` is left as it is; a late answer finds nobody.
TEST_F(BusTemplates, AnActorWithoutStopIsOverAtOnce) {
    const std::string plan = R"({ "format": "vagus-plan/1", "name": "P", "toolboxes": ["cart"],
      "start": { "actor": "ask" },
      "actors": { "ask": { "template": "Ask", "states": { "Told": "@terminate" },
        "supervisors": { "late": { "template": "Timeout", "in": { "seconds": "0.1" },
          "events": { "Timeout": "@terminate" } } } } } })";
    ScriptedNodes nodes([](ScriptedNodes&, const BusEvent&) {});
    const Driven driven = drive(plan, library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Interrupted);
    EXPECT_THAT(nodes.said, ElementsAre("0 ask 2"));  // 1 is the number of `late`
    EXPECT_THAT(driven.trace.back(), HasSubstr("\"t\":0.100000"));
}

// ---- watching ----

TEST_F(BusTemplates, AGlobalSupervisorIsToldToLeaveWhenThePlanEndsAndWhenItRaised) {
    const std::string plan = R"({ "format": "vagus-plan/1", "name": "P", "toolboxes": ["cart"],
      "start": { "actor": "wait", "supervisors": {
        "touch": { "template": "CheckTouch", "events": { "Touched": "remedy" } } } },
      "actors": {
        "wait": { "template": "Wait", "in": { "seconds": 1 }, "states": { "Done": "@terminate" } },
        "remedy": { "template": "Wait", "in": { "seconds": "0.1" },
          "states": { "Done": "wait" } } } })";
    int watches = 0;
    ScriptedNodes nodes([&watches](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "watch" && ++watches == 1) {
            bus.send(20ms, {"touch", {event.arguments[0], 0}});
        }
    });
    const Driven driven = drive(plan, library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Ok) << driven.ended.message;
    // It rests while its remedy is active (P23): from 20 to 120 ms. Numbers: the first watching 1,
    // Wait 2, its remedy 3, the second watching 4.
    EXPECT_THAT(nodes.said, ElementsAre("0 watch 1", "20 leave 1", "120 watch 4", "1120 leave 4"));
}

TEST_F(BusTemplates, AnIgnoredEventLeavesTheSupervisorWatching) {
    const std::string touch = R"(, "supervisors": { "touch": { "template": "CheckTouch",
        "events": { "Touched": "@ignore" } } })";
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "watch") {
            bus.send(10ms, {"touch", {event.arguments[0], 0}});
            bus.send(20ms, {"touch", {event.arguments[0], 0}});
            bus.send(30ms, {"touch", {33, 0}});
        }
        if (event.name == "go") bus.send(50ms, {"lost", {event.arguments[0]}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })", touch), library_, nodes);
    const auto raised = std::count_if(
        driven.trace.begin(), driven.trace.end(),
        [](const auto& line) { return line.find("\"kind\":\"event\"") != std::string::npos; });
    EXPECT_EQ(raised, 2);
    EXPECT_EQ(nodes.said.back(), "50 leave 1");
}

// ---- nodes that are not there ----

TEST_F(BusTemplates, TheFirstNodeThatIsOnTheBusDoesTheWork) {
    nodes_.left("cart");
    nodes_.appeared("sled");
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "go") bus.send(5ms, {node_left("sled"), {}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
    EXPECT_THAT(driven.ended.message,
                HasSubstr("go: the node \"sled\", which does the work, has left the bus"));
}

TEST_F(BusTemplates, WorkForANodeThatIsNotThereIsAnErrorThatSaysWhatIs) {
    nodes_.left("cart");
    ScriptedNodes nodes([](ScriptedNodes&, const BusEvent&) {});
    Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(driven.ended.message,
                HasSubstr("the node \"cart\" or \"sled\", which does the work, is not on the bus; "
                          "there are: skin"));
    nodes_.left("skin");
    driven = drive(go_plan(R"({ "far": 1 })", kTouch), library_, nodes);
    EXPECT_THAT(driven.ended.message,
                HasSubstr("touch: the node \"skin\", which does the work, is not on the bus; no "
                          "node is"));
    EXPECT_TRUE(nodes.said.empty());
}

TEST_F(BusTemplates, ANodeThatLeavesWhileItWatchesIsAnErrorOfItsSupervisor) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "watch") {
            bus.send(40ms, {node_left("other"), {}});
            bus.send(50ms, {node_left("skin"), {}});
        }
        if (event.name == "halt") bus.send(1ms, {"halted", {event.arguments[0]}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })", kTouch), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(driven.ended.message,
                HasSubstr("touch: the node \"skin\", which does the work, has left the bus"));
}

TEST_F(BusTemplates, ANodeThatLeavesWhileItIsBeingStoppedIsLogged) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "watch") bus.send(50ms, {"touch", {event.arguments[0], 0}});
        if (event.name == "halt") bus.send(10ms, {node_left("cart"), {}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })", kTouch), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(driven.trace,
                testing::Contains(HasSubstr(
                    R"("kind":"log","actor":"go","text":"the node \"cart\", which does)")));
}

// A node whose program was stopped has stopped: nothing is waited for, and nothing is wrong.
TEST_F(BusTemplates, ANodeThatWasStoppedFromOutsideHasStopped) {
    for (const bool before : {false, true}) {
        ScriptedNodes nodes([before](ScriptedNodes& bus, const BusEvent& event) {
            if (event.name == "watch") bus.send(50ms, {"touch", {event.arguments[0], 0}});
            if (event.name == "watch" && before) bus.send(20ms, {node_stopped("cart"), {}});
            if (event.name == "halt" && !before) bus.send(10ms, {node_stopped("cart"), {}});
        });
        const Driven driven = drive(go_plan(R"({ "far": 1 })", kTouch), library_, nodes);
        EXPECT_EQ(driven.ended.result, plan::PlanResult::Ok) << driven.ended.message;
        EXPECT_THAT(driven.trace, testing::Contains(HasSubstr(fmt::format(
                                      R"("ran":true,"stop_us":{})", before ? 0 : 10000))));
    }
}

// One that runs again by then is told to stop as any other, and has to answer.
TEST_F(BusTemplates, ANodeThatRunsAgainIsWaitedFor) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "watch") {
            bus.send(10ms, {node_stopped("cart"), {}});
            bus.send(20ms, {node_runs("cart"), {}});
            bus.send(50ms, {"touch", {event.arguments[0], 0}});
        }
        if (event.name == "halt") bus.send(30ms, {"halted", {event.arguments[0]}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })", kTouch), library_, nodes);
    EXPECT_THAT(driven.trace, testing::Contains(HasSubstr(R"("ran":true,"stop_us":30000)")));
}

// Somebody else has stopped the node, and lets nobody wait for it for ever: 10 ms and kStoppedMax.
TEST_F(BusTemplates, ANodeThatStaysStoppedEndsTheActorWithAnError) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name == "go") bus.send(10ms, {node_stopped("cart"), {}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(driven.ended.message,
                HasSubstr("the node \"cart\", which does the work, was stopped"));
    EXPECT_THAT(driven.trace.back(), HasSubstr(at("3.010000", R"("plan-end")")));
}

// Nobody tells the actor: it was stopped while another one worked, or before the plan began.
TEST_F(BusTemplates, ANodeThatWasStoppedBeforeTheActorBeganEndsItToo) {
    ScriptedNodes nodes([](ScriptedNodes&, const BusEvent&) {});
    nodes_.stopped("cart");
    const Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Error);
    EXPECT_THAT(driven.ended.message,
                HasSubstr("the node \"cart\", which does the work, was stopped by somebody else"));
    EXPECT_THAT(driven.trace.back(), HasSubstr(at("3.000000", R"("plan-end")")));
    nodes_.runs("cart");
}

TEST_F(BusTemplates, ANodeThatRunsAgainInTimeGoesOn) {
    ScriptedNodes nodes([](ScriptedNodes& bus, const BusEvent& event) {
        if (event.name != "go") return;
        bus.send(10ms, {node_stopped("cart"), {}});
        bus.send(3009ms, {node_runs("cart"), {}});
        bus.send(4s, {"lost", {event.arguments[0]}});
    });
    const Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
    EXPECT_EQ(driven.ended.result, plan::PlanResult::Ok) << driven.ended.message;
}

// ---- many events ----

// kKeptEventsMax at one instant are all taken; one more is an error.
TEST_F(BusTemplates, AFloodOfAnswersIsAnInternalError) {
    for (const size_t count : {run::kKeptEventsMax, run::kKeptEventsMax + 1}) {
        ScriptedNodes nodes([count](ScriptedNodes& bus, const BusEvent& event) {
            if (event.name != "go") return;
            for (size_t i = 0; i + 1 < count; ++i) bus.send(5ms, {"lost", {99}});
            bus.send(5ms, {"lost", {event.arguments[0]}});
        });
        const Driven driven = drive(go_plan(R"({ "far": 1 })"), library_, nodes);
        EXPECT_EQ(driven.ended.result,
                  count == run::kKeptEventsMax ? plan::PlanResult::Ok : plan::PlanResult::Error)
            << driven.ended.message;
        if (count > run::kKeptEventsMax) {
            EXPECT_THAT(driven.ended.message, HasSubstr("more than 256 events came"));
        }
    }
}

TEST(Numbers, LeaveOutThoseThatNoScriptCanTellFromNobody) {
    run::Numbers numbers;
    for (int i = 1; i <= 0x7fff; ++i) EXPECT_EQ(numbers.next(), static_cast<uint64_t>(i));
    EXPECT_EQ(numbers.next(), 0x8001u);  // 0x8000 has the token 0
    EXPECT_EQ(token_of(0x8001), 1);
    EXPECT_EQ(token_of(0x7fff), 0x7fff);
}

// Tokens of a run on a bus begin anywhere; those after the last one begin again at 1.
TEST(Numbers, BeginAndGoOnWhereTheyAreTold) {
    run::Numbers numbers(0x7ffe);
    EXPECT_EQ(token_of(numbers.next()), 0x7ffe);
    EXPECT_EQ(token_of(numbers.next()), 0x7fff);
    EXPECT_EQ(token_of(numbers.next()), 1);
    numbers.move_to(0x1234);
    const uint64_t moved = numbers.next();
    EXPECT_EQ(token_of(moved), 0x1234);
    numbers.move_to(1);
    const uint64_t again = numbers.next();
    EXPECT_EQ(token_of(again), 1);
    EXPECT_GT(again, moved);  // no number comes twice
}

// ---- in real time ----

// The node answers from its own thread's point of view at once: what it says may come before the
// code waits for it.
TEST_F(BusTemplates, InRealTimeAnswersAreHeardHoweverFastTheyCome) {
    const std::string text = R"({ "format": "vagus-plan/1", "name": "P", "toolboxes": ["cart"],
      "configuration": { "n": { "type": "int", "initial": 0 } },
      "start": { "actor": "count" },
      "actors": {
        "count": { "template": "For", "in": { "counter": "n", "last": 199 },
          "out": { "counter": "n" }, "states": { "Loop": "go", "Done": "@terminate" } },
        "go": { "template": "Go", "in": { "far": 1 },
          "states": { "There": "@terminate", "Lost": "count" },
          "supervisors": { "touch": { "template": "CheckTouch",
            "events": { "Touched": "count" } } } } } })";
    const plan::Checked checked = plan::check("p", plan::OneText(text), library_.templates());
    ASSERT_TRUE(checked.ok()) << plan::format_findings_json(checked.findings);
    const plan::Graph graph = plan::make_graph(checked);
    int watches = 0, leaves = 0, halts = 0;
    run::RealTime* running = nullptr;
    run::RunOptions options;
    options.max_time = 60s;
    options.on_emit = [&](const BusEvent& event) {
        const int16_t token = event.arguments[0];
        if (event.name == "leave") ++leaves;
        if (event.name == "watch" && ++watches % 2 == 0) running->hear({"touch", {token, 0}});
        if (event.name == "go" && watches % 2 == 1) running->hear({"lost", {token}});
        if (event.name == "halt") {
            ++halts;
            running->hear({"there", {token, 0, 0, 0}});  // too late, and crossing
            running->hear({"halted", {token}});
        }
    };
    run::RealTime run(graph, library_, options);
    running = &run;
    const run::Ended ended = run.run();
    EXPECT_EQ(ended.result, plan::PlanResult::Ok) << ended.message;
    EXPECT_EQ(watches, 200);
    EXPECT_EQ(leaves, 200);
    EXPECT_LE(halts, 100);
}

TEST_F(BusTemplates, InRealTimeANodeThatLeavesIsAnError) {
    const plan::Checked checked =
        plan::check("p", plan::OneText(go_plan(R"({ "far": 1 })", kTouch)), library_.templates());
    const plan::Graph graph = plan::make_graph(checked);
    std::vector<std::string> said;
    run::RealTime* running = nullptr;
    run::RunOptions options;
    options.max_time = 60s;
    options.on_emit = [&](const BusEvent& event) {
        said.push_back(event.name);
        if (event.name == "go") running->hear({node_left("skin"), {}});
        if (event.name == "halt") running->hear({"halted", {event.arguments[0]}});
    };
    run::RealTime run(graph, library_, options);
    running = &run;
    const run::Ended ended = run.run();
    EXPECT_EQ(ended.result, plan::PlanResult::Error);
    EXPECT_THAT(ended.message, HasSubstr("the node \"skin\""));
    EXPECT_EQ(said.front(), "watch");
    EXPECT_THAT(said, testing::Contains("leave"));
}

}  // namespace
}  // namespace vagus::toolbox
