// Each kind of finding on plans small enough to walk through by hand, beside plans that have none.
// Against a slow and obvious search: explore_random_test.cpp.
#include "plan/explore.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "plan/test_explore.hpp"

namespace vagus::plan {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Exploration explored_files(const ExploreFiles& texts, const ExploreOptions& options = {}) {
    const Checked checked = checked_plans(texts);
    return explore(checked.plans, make_graph(checked), options);
}

Exploration explored(const PlanParts& parts, const ExploreOptions& options = {}) {
    return explored_files(ExploreFiles{{"main.plan.json", plan_text(parts)}}, options);
}

// "kind element: step; step", the steps without their plans.
std::vector<std::string> told(const Exploration& found) {
    std::vector<std::string> lines;
    for (const ExploreFinding& finding : found.findings) {
        std::string line = fmt::format("{} {}:", name_of(finding.kind), finding.element);
        for (const ExploreStep& step : finding.path) {
            line += fmt::format("{} {} {} {}", &step == &finding.path.front() ? "" : ";",
                                step.element, step.outcome, step.target);
        }
        lines.push_back(line);
    }
    return lines;
}

const std::string kToEnd = R"("template": "Go", "states": {"Done": "@terminate",
                              "Blocked": "@terminate"})";

TEST(Explore, APlanWithoutFaultsHasNoFindings) {
    const Exploration found =
        explored({.globals = R"("stop": {"template": "See", "events":
                     {"Seen": "@terminate", "Lost": "@ignore"}})",
                  .actors = R"("a": {"template": "Go", "states": {"Done": "b", "Blocked": "a"}},
                     "b": {)" +
                            kToEnd + "}"});
    EXPECT_THAT(told(found), IsEmpty());
    EXPECT_EQ(found.situations, 2u);  // a, b
    EXPECT_TRUE(found.complete);
    EXPECT_FALSE(found.skipped);
}

// ---- what can never be reached ----

TEST(Explore, AnActorToWhichNothingLeadsIsFound) {
    const Exploration found =
        explored({.actors = "\"a\": {" + kToEnd + "},\n\"lost\": {" + kToEnd + "}"});
    ASSERT_THAT(told(found), ElementsAre("unreached lost:"));
    EXPECT_EQ(found.findings[0].at.line, 7);  // behind four of plan_text() and two of a
    EXPECT_THAT(found.findings[0].message, HasSubstr("no state or event leads to it"));
}

// `vagus plan check` follows the arrow of Interrupted; but the sub-plan has no event that ends it.
TEST(Explore, AnActorBehindAResultThatNeverComesIsFound) {
    const Exploration found = explored_files(
        {{"main.plan.json",
          plan_text({.actors = R"("a": {"plan": "sub.plan.json", "states": {"OK": "@terminate",
                         "Interrupted": "never", "Error": "@terminate"}},
                         "never": {)" +
                               kToEnd + "}"})},
         {"sub.plan.json", plan_text({.name = "Sub", .actors = "\"s\": {" + kToEnd + "}"})}});
    ASSERT_THAT(told(found), ElementsAre("unreached never:"));
    EXPECT_THAT(found.findings[0].message, HasSubstr("never happens: a's Interrupted"));
}

TEST(Explore, AnActorBehindAnErrorOfASubPlanCanBeReached) {
    const Exploration found = explored_files(
        {{"main.plan.json",
          plan_text({.actors = R"("a": {"plan": "sub.plan.json", "states": {"OK": "@terminate",
                         "Interrupted": "@terminate", "Error": "sorry"}},
                         "sorry": {)" +
                               kToEnd + "}"})},
         {"sub.plan.json", plan_text({.name = "Sub", .actors = "\"s\": {" + kToEnd + "}"})}});
    EXPECT_THAT(told(found), IsEmpty());
    // a before its sub-plan; s in a; a with OK; a with Error; sorry.
    EXPECT_EQ(found.situations, 5u);
}

// ---- the end cannot be reached any more ----

TEST(Explore, ATrapIsFoundWithTheShortestPathToIt) {
    const Exploration found =
        explored({.actors = R"("a": {"template": "Go", "states": {"Done": "b", "Blocked": "c"}},
                     "b": {"template": "Go", "states": {"Done": "c", "Blocked": "@terminate"}},
                     "c": {"template": "Go", "states": {"Done": "d", "Blocked": "d"}},
                     "d": {"template": "Go", "states": {"Done": "c", "Blocked": "c"}})"});
    EXPECT_THAT(told(found), ElementsAre("no-end c: a Blocked c"));
    EXPECT_EQ(found.trapped, 2u);  // c, d
    EXPECT_THAT(found.findings[0].message, HasSubstr("nor from what follows: \"d\""));
}

// The global supervisor ends the plan from everywhere else, but it rests while its remedy runs,
// and this has no states (P23). Its arrows look fine, so the checks of a plan have nothing to say.
TEST(Explore, ARemedyWithoutAnEndIsATrapWhileItsSupervisorRests) {
    const PlanParts parts = {
        .globals = R"("stop": {"template": "See", "events": {"Seen": "@terminate",
                       "Lost": "wait"}})",
        .actors = R"("a": {"template": "Go", "states": {"Done": "a", "Blocked": "a"}},
                     "wait": {"template": "Sit"})"};
    const Exploration found = explored(parts);
    EXPECT_THAT(told(found), ElementsAre("no-end wait: stop Lost wait"));
    for (const Finding& finding : checked_plans({{"main.plan.json", plan_text(parts)}}).findings) {
        EXPECT_NE(finding.rule, "W7") << finding.message;
    }
}

TEST(Explore, TheSameActorIsNoTrapWhereTheSupervisorWatches) {
    const Exploration found =
        explored({.globals = R"("stop": {"template": "See", "events": {"Seen": "@terminate",
                       "Lost": "wait"}})",
                  .actors = R"("a": {"template": "Go", "states": {"Done": "wait", "Blocked": "a"}},
                     "wait": {"template": "Sit"})"});
    ASSERT_THAT(told(found), ElementsAre("no-end wait: stop Lost wait"));
    EXPECT_EQ(found.situations, 3u);  // a; wait; wait while stop rests
    EXPECT_EQ(found.trapped, 1u);
    EXPECT_THAT(found.findings[0].message, HasSubstr("while \"stop\" rests"));
}

TEST(Explore, AnEndlessSubPlanIsATrapUnlessItsCallerWatches) {
    const std::string sub = plan_text(
        {.name = "Sub",
         .actors = R"("s": {"template": "Go", "states": {"Done": "s", "Blocked": "s"}})"});
    const std::string call = R"("a": {"plan": "sub.plan.json", "states": {"OK": "@terminate",
        "Interrupted": "@terminate", "Error": "@terminate"})";
    const Exploration alone = explored_files(
        {{"main.plan.json", plan_text({.actors = call + "}"})}, {"sub.plan.json", sub}});
    // Its Error would lead to the end, but an error is no way that is meant.
    EXPECT_THAT(told(alone), ElementsAre("no-end a:"));
    const std::string with_watch = call + R"(, "supervisors": {"w":
        {"template": "See", "events": {"Seen": "@terminate", "Lost": "@ignore"}}}})";
    const Exploration watched = explored_files(
        {{"main.plan.json", plan_text({.actors = with_watch})}, {"sub.plan.json", sub}});
    EXPECT_THAT(told(watched), IsEmpty());
}

TEST(Explore, AnActorThatOnlyFailsIsAnEndThatIsMeant) {
    EXPECT_THAT(told(explored({.actors = R"("a": {"template": "Break"})"})), IsEmpty());
    EXPECT_THAT(told(explored({.actors = R"("a": {"template": "Sit"})"})),
                ElementsAre("no-end a:"));
}

// ---- loops that take no time ----

TEST(Explore, ALoopOfComputationsIsFoundAndSaysWhetherValuesCanEndIt) {
    const Exploration found = explored(
        {.actors = R"("a": {"template": "Go", "states": {"Done": "x", "Blocked": "@terminate"}},
                     "x": {"template": "Step", "states": {"Yes": "y", "No": "a"}},
                     "y": {"template": "Step", "states": {"Yes": "x", "No": "x"}})"});
    ASSERT_THAT(told(found), ElementsAre("no-time x: a Done x; x Yes y; y Yes x"));
    EXPECT_THAT(found.findings[0].message, HasSubstr("only values can end this loop"));
    const Exploration endless =
        explored({.actors = R"("a": {"template": "Go", "states": {"Done": "x", "Blocked":
                     "@terminate"}},
                     "x": {"template": "Step", "states": {"Yes": "x", "No": "x"}})"});
    ASSERT_THAT(told(endless), ElementsAre("no-end x: a Done x", "no-time x: a Done x; x Yes x"));
    EXPECT_THAT(endless.findings[1].message, HasSubstr("no state leads out of this loop"));
}

TEST(Explore, ALoopWithAnActorThatWaitsTakesTime) {
    EXPECT_THAT(
        told(explored({.actors = R"("a": {"template": "Go", "states": {"Done": "x", "Blocked":
                     "@terminate"}},
                     "x": {"template": "Step", "states": {"Yes": "a", "No": "a"}})"})),
        IsEmpty());
}

TEST(Explore, ASubPlanOfComputationsTakesNoTimeEither) {
    const Exploration found = explored_files(
        {{"main.plan.json",
          plan_text({.actors = R"("a": {"plan": "sub.plan.json", "states": {"OK": "a",
                         "Interrupted": "@terminate", "Error": "@terminate"},
                         "supervisors": {"w": {"template": "See", "events": {"Seen": "@terminate",
                         "Lost": "@ignore"}}}})"})},
         {"sub.plan.json",
          plan_text(
              {.name = "Sub", .actors = R"("s": {"template": "Step", "states": {"Yes": "@terminate",
                                "No": "@terminate"}})"})}});
    EXPECT_THAT(told(found), ElementsAre("no-time a: a  s; s Yes @terminate; a OK a"));
}

// ---- supervisors that can never win ----

TEST(Explore, ASupervisorWhoseEventsAreAllIgnoredNeverWins) {
    const Exploration found =
        explored({.actors = "\"a\": {" + kToEnd + R"(, "supervisors": {"w": {"template": "See",
            "events": {"Seen": "@ignore", "Lost": "@ignore"}}}})"});
    EXPECT_THAT(told(found), ElementsAre("never-wins w:"));
}

// Both look at the same at the same instants, and the first in the file is taken (P21).
TEST(Explore, TheSecondOfTwoThatLookAtTheSameNeverWins) {
    const std::string actors = "\"a\": {" + kToEnd + R"(, "supervisors": {
        "first": {"template": "See", "in": {"n": "1"}, "events": {"Seen": "b", "Lost": "@ignore"}},
        "second": {"template": "See", "in": {"n": "%"}, "events": {"Seen": "c",
                   "Lost": "@ignore"}}}},
        "b": {)" + kToEnd + "},\n\"c\": {" +
                               kToEnd + "}";
    std::string same = actors;
    same.replace(same.find('%'), 1, "1");
    const Exploration found = explored({.actors = same});
    ASSERT_THAT(told(found), ElementsAre("unreached c:", "never-wins second:"));
    EXPECT_THAT(found.findings[1].message, HasSubstr("one that ranks before it"));
    std::string other = actors;
    other.replace(other.find('%'), 1, "2");
    EXPECT_THAT(told(explored({.actors = other})), IsEmpty());
}

TEST(Explore, TheSecondWinsWithAnEventThatTheFirstIgnores) {
    EXPECT_THAT(told(explored({.actors = "\"a\": {" + kToEnd + R"(, "supervisors": {
        "first": {"template": "See", "events": {"Seen": "b", "Lost": "@ignore"}},
        "second": {"template": "See", "events": {"Seen": "@ignore", "Lost": "b"}}}},
        "b": {)" + kToEnd + "}"})),
                IsEmpty());
}

// Both hear the word at the same instant; the outer plan is first (P21). A global one of the same
// plan would only rest while its remedy runs.
TEST(Explore, AWordThatAnOuterPlanHearsIsNeverTakenInside) {
    const std::string inner =
        plan_text({.name = "Sub",
                   .globals = R"("inner": {"template": "Hear", "in": {"word": "'stop'"},
                     "events": {"Heard": "@terminate"}})",
                   .actors = "\"s\": {" + kToEnd + "}"});
    const auto outer = [](const std::string& word) {
        return plan_text({.globals = R"("outer": {"template": "Hear", "in": {"word": "')" + word +
                                     R"('"}, "events": {"Heard": "@terminate"}})",
                          .actors = R"("a": {"plan": "sub.plan.json", "states": {
                     "OK": "@terminate", "Interrupted": "@terminate", "Error": "@terminate"}})"});
    };
    EXPECT_THAT(told(explored_files({{"main.plan.json", outer("stop")}, {"sub.plan.json", inner}})),
                ElementsAre("never-wins inner:"));
    EXPECT_THAT(told(explored_files({{"main.plan.json", outer("go")}, {"sub.plan.json", inner}})),
                IsEmpty());
}

// P21a: the first is taken, the second is still due and taken against the activation that follows.
TEST(Explore, OfTwoGlobalSupervisorsThatHearTheSameBothCanWin) {
    EXPECT_THAT(told(explored({.globals = R"(
        "first": {"template": "Hear", "events": {"Heard": "b"}},
        "second": {"template": "Hear", "events": {"Heard": "@terminate"}})",
                               .actors = "\"a\": {" + kToEnd + "},\n\"b\": {" + kToEnd + "}"})),
                IsEmpty());
}

// ---- variables that are read before anything wrote them ----

TEST(Explore, AVariableReadBeforeItIsWrittenIsFound) {
    const PlanParts parts = {
        .configuration = R"("v": {"type": "int"})",
        .actors = R"("a": {"template": "Go", "out": {"r": "v"}, "states": {"Done": "b",
                     "Blocked": "@terminate"}, "supervisors": {"w": {"template": "See",
                     "events": {"Seen": "b", "Lost": "@ignore"}}}},
                     "b": {"template": "Go", "in": {"n": "v + 1"}, "states": {"Done": "@terminate",
                     "Blocked": "b"}})"};
    EXPECT_THAT(told(explored(parts)), ElementsAre("unwritten v: w Seen b"));
    PlanParts written = parts;
    written.actors.replace(written.actors.find("\"events\""), 0, R"("out": {"r": "v"}, )");
    EXPECT_THAT(told(explored(written)), IsEmpty());
    PlanParts initial = parts;
    initial.configuration = R"("v": {"type": "int", "initial": 0})";
    EXPECT_THAT(told(explored(initial)), IsEmpty());
}

TEST(Explore, AVariableThatASubPlanWritesForItsCallerIsWritten) {
    const auto main = [](const std::string& first) {
        return plan_text({.configuration = R"("v": {"type": "int"})",
                          .actors = R"("a": {"plan": "sub.plan.json", "states": {"OK": "b",
                     "Interrupted": "@terminate", "Error": ")" +
                                    first + R"("}},
                     "b": {"template": "Go", "in": {"n": "v"}, "states": {"Done": "@terminate",
                     "Blocked": "@terminate"}})"});
    };
    const std::string sub = plan_text(
        {.name = "Sub",
         .configuration = R"("v": {"type": "int", "access": "shared"})",
         .actors = R"("s": {"template": "Go", "out": {"r": "v"}, "states": {"Done": "@terminate",
                     "Blocked": "@terminate"}})"});
    EXPECT_THAT(
        told(explored_files({{"main.plan.json", main("@terminate")}, {"sub.plan.json", sub}})),
        IsEmpty());
    EXPECT_THAT(told(explored_files({{"main.plan.json", main("b")}, {"sub.plan.json", sub}})),
                ElementsAre("unwritten v: a  s; s  ; a Error b"));
}

TEST(Explore, ASubPlanBeginsWithItsVariablesUnwrittenEachTime) {
    const Exploration found = explored_files(
        {{"main.plan.json",
          plan_text({.actors = R"("a": {"plan": "sub.plan.json", "states": {"OK": "@terminate",
                         "Interrupted": "@terminate", "Error": "@terminate"}})"})},
         {"sub.plan.json",
          plan_text({.name = "Sub",
                     .configuration = R"("v": {"type": "int"})",
                     .actors = R"("s": {"template": "Go", "in": {"n": "v"}, "out": {"r": "v"},
                         "states": {"Done": "@terminate", "Blocked": "@terminate"}})"})}});
    ASSERT_THAT(told(found), ElementsAre("unwritten v: a  s"));
    EXPECT_EQ(found.findings[0].file, "sub.plan.json");
}

// ---- sub-plans that call each other ----

ExploreFiles circle(const std::string& back) {
    const auto call = [](const std::string& name, const std::string& plan,
                         const std::string& start) {
        return plan_text({.name = name,
                          .actors = start + "\"call\": {\"plan\": \"" + plan +
                                    R"(.plan.json", "states": {"OK": "@terminate",
                         "Interrupted": "@terminate", "Error": "@terminate"}, "supervisors": {"w":
                         {"template": "See", "events": {"Seen": "@terminate",
                         "Lost": "@ignore"}}}})"});
    };
    const std::string go = R"("go": {"template": "Go", "states": {"Done": "call",
                           "Blocked": "@terminate"}},)";
    return {{"main.plan.json", call("Main", "one", "")},
            {"one.plan.json", call("One", "two", go)},
            {"two.plan.json", call("Two", back, go)}};
}

TEST(Explore, PlansThatCallEachOtherAreFoundWithTheWayIn) {
    const Exploration found = explored_files(circle("one"));
    ASSERT_THAT(told(found),
                ElementsAre("endless-calls call: call  go; go Done call; call  go; go Done call; "
                            "call  go"));
    EXPECT_THAT(found.findings[0].message, HasSubstr("One -> Two -> One"));
    EXPECT_EQ(found.findings[0].file, "two.plan.json");
    EXPECT_TRUE(found.skipped);
}

// ---- limits ----

// Below the depth a call is one step that may end in each state.
TEST(Explore, BelowTheDepthACallIsOneStep) {
    const Exploration found = explored_files(
        {{"main.plan.json",
          plan_text({.actors = R"("a": {"plan": "sub.plan.json", "states": {"OK": "@terminate",
                         "Interrupted": "b", "Error": "b"}}, "b": {)" +
                               kToEnd + "}"})},
         {"sub.plan.json", plan_text({.name = "Sub", .actors = "\"s\": {" + kToEnd + "}"})}},
        {.depth = 1});
    EXPECT_TRUE(found.skipped);
    EXPECT_TRUE(found.complete);
    EXPECT_THAT(told(found), IsEmpty());
    EXPECT_EQ(found.situations, 5u);  // a; a with each of three results; b
    EXPECT_THAT(format_summary(found), HasSubstr("--depth looks deeper"));
}

TEST(Explore, BeyondTheLimitOnlyWhatWasMetIsTold) {
    const PlanParts parts = {
        .configuration = R"("v": {"type": "int"})",
        .actors = R"("a": {"template": "Go", "in": {"n": "v"}, "states": {"Done": "b",
                     "Blocked": "b"}}, "b": {"template": "Go", "states": {"Done": "c", "Blocked":
                     "c"}}, "c": {)" +
                  kToEnd + "}, \"d\": {" + kToEnd + "}"};
    EXPECT_THAT(told(explored(parts)), ElementsAre("unreached d:", "unwritten v:"));
    const Exploration at_limit = explored(parts, {.situations = 5});  // a, b, c, two ends
    EXPECT_TRUE(at_limit.complete);
    const Exploration beyond = explored(parts, {.situations = 2});
    EXPECT_FALSE(beyond.complete);
    EXPECT_THAT(told(beyond), ElementsAre("unwritten v:"));
    EXPECT_THAT(format_summary(beyond), HasSubstr("a limit was reached"));
    EXPECT_FALSE(explored(parts, {.steps = 1}).complete);
}

// Each actor has a supervisor of its own, and ten global ones lead to a tenth of them each.
TEST(Explore, AThousandActorsAreFarFromTheLimit) {
    std::string globals;
    for (int i = 0; i < 10; ++i) {
        globals += fmt::format(R"({}"g{}": {{"template": "See", "events": {{"Seen": "a{}",
            "Lost": "@terminate"}}}})",
                               i == 0 ? "" : ",", i, i * 100);
    }
    std::string actors;
    for (int i = 0; i < 1000; ++i) {
        actors += fmt::format(R"({}"a{}": {{"template": "Go", "states": {{"Done": "a{}", "Blocked":
            "a{}"}}, "supervisors": {{"s{}": {{"template": "See", "events": {{"Seen": "a{}",
            "Lost": "@ignore"}}}}}}}})",
                              i == 0 ? "" : ",\n", i, (i + 1) % 1000, (i * 7) % 1000, i,
                              (i * 13 + 5) % 1000);
    }
    const Exploration found = explored({.globals = globals, .actors = actors});
    EXPECT_TRUE(found.complete);
    EXPECT_THAT(told(found), IsEmpty());
    EXPECT_EQ(found.situations, 1010u);  // ten of the actors also while a global one rests
}

// ---- texts ----

TEST(Explore, TextAndJsonSayTheSame) {
    const Exploration found =
        explored({.actors = R"("a": {"template": "Go", "states": {"Done": "b", "Blocked":
                     "@terminate"}},
                     "b": {"template": "Sit"})"});
    ASSERT_EQ(found.findings.size(), 1u);
    EXPECT_EQ(format_text(found.findings[0]),
              "main.plan.json:7:22: b: from \"b\" the end cannot be reached any more [no-end]\n"
              "    Main: a ends in Done: on to b\n");
    EXPECT_EQ(format_summary(found),
              "2 situations seen, 1 thing found; these are all that there are\n");
    EXPECT_EQ(format_json(found),
              "{\n  \"situations\": 2,\n  \"trapped\": 1,\n  \"complete\": true,\n  \"depth\": 8,\n"
              "  \"skipped\": false,\n  \"findings\": [\n"
              "    {\"kind\": \"no-end\", \"file\": \"main.plan.json\", \"plan\": \"Main\", "
              "\"element\": \"b\", \"line\": 7, \"column\": 22, "
              "\"message\": \"from \\\"b\\\" the end cannot be reached any more\", \"path\": [\n"
              "      {\"plan\": \"Main\", \"kind\": \"end\", \"element\": \"a\", "
              "\"outcome\": \"Done\", \"target\": \"b\"}]}\n  ]\n}\n");
}

}  // namespace
}  // namespace vagus::plan
