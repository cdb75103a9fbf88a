// Runs of tests: each kind of expectation as expected and not, with values worked out by hand from
// the plan below. What needs a world is in tests/trials.
#include "trial/trial.hpp"

#include <gtest/gtest.h>

#include "base/test_folder.hpp"
#include "trial/report.hpp"

namespace vagus::trial {
namespace {

// a from 0 to 2 s, then b, which its supervisor ends at 3 s; c ends at once, n is written, and the
// plan ends. Between an end and the next beginning no actor runs.
constexpr std::string_view kPlan = R"({
  "format": "vagus-plan/1", "name": "P", "toolboxes": ["core"],
  "configuration": { "n": { "type": "int", "initial": 1 } },
  "start": { "actor": "a" },
  "actors": {
    "a": { "template": "Wait", "in": { "seconds": 2 }, "states": { "Done": "b" } },
    "b": { "template": "Wait", "in": { "seconds": 9 }, "states": { "Done": "c" },
      "supervisors": { "soon": { "template": "Timeout", "in": { "seconds": 1 },
                                 "events": { "Timeout": "c" } } } },
    "c": { "template": "Assign", "in": { "value": 7 }, "out": { "result": "n" },
      "states": { "Done": "@terminate" } } } })";

class Trials : public ::testing::Test {
protected:
    Result<Outcome> run(std::string_view expect, std::string_view members = "") {
        folder_.write("P.plan.json", kPlan);
        const std::string text = R"({"format":"vagus-test/1","plan":"P.plan.json",)" +
                                 std::string(members) + R"("expect":[)" + std::string(expect) +
                                 "]}";
        const auto test = read_test(text, folder_ / "t.test.json");
        if (!test.ok()) return test.error();
        return run_trial(test.value(), 1, {});
    }
    // What is wrong with the only expectation; empty: nothing.
    std::string wrong(std::string_view expect, std::string_view members = "") {
        const auto outcome = run(expect, members);
        if (!outcome.ok()) return outcome.error().what;
        const Verdict& verdict = outcome.value().verdicts.at(0);
        at_ = verdict.at;
        return verdict.what;
    }

    test::Folder folder_;
    Time at_{};
};

TEST_F(Trials, OrderIsOfTheStartsOfActors) {
    EXPECT_EQ(wrong(R"({"order":["a","b","c"]})"), "");
    EXPECT_EQ(wrong(R"({"order":["a","c"]})"), "");
    EXPECT_EQ(wrong(R"({"order":["a","c","b"]})"),
              "the plan came to c at 3 s, and never to b after that");
    EXPECT_EQ(wrong(R"({"order":["b","a"]})"),
              "the plan came to b at 2 s, and never to a after that");
}

TEST_F(Trials, EventuallyHoldsOnceAndInTime) {
    EXPECT_EQ(wrong(R"({"eventually":"actor == 'b'"})"), "");
    EXPECT_EQ(wrong(R"({"eventually":"actor == 'b'","within":2})"), "");
    EXPECT_EQ(wrong(R"({"eventually":"actor == 'b'","within":1.9})"),
              "it did not come about within 1.9 s; then actor = \"\"");
    EXPECT_EQ(wrong(R"({"eventually":"n == 8"})"),
              "it had not come about when the run ended, at 3 s");
}

TEST_F(Trials, AlwaysAndNeverAreAskedAfterEachLine) {
    EXPECT_EQ(wrong(R"({"always":"n < 8"})"), "");
    EXPECT_EQ(wrong(R"({"always":"n < 7"})"), "n = 7, actor = \"\"");
    EXPECT_EQ(at_, std::chrono::seconds(3));
    EXPECT_EQ(wrong(R"({"never":"event == 'Timeout' and actor == 'a'"})"), "");
    EXPECT_EQ(wrong(R"({"never":"event == 'Timeout' and actor == 'b'"})"),
              "event = \"Timeout\", actor = \"b\"");
    EXPECT_EQ(at_, std::chrono::seconds(3));
}

TEST_F(Trials, AConditionThatCannotBeAskedFails) {
    EXPECT_EQ(wrong(R"({"always":"10 / (n - 7) < 100"})").substr(0, 6), "10 / 0");
    EXPECT_EQ(at_, std::chrono::seconds(3));
}

TEST_F(Trials, EndsTellsHowAndByWhom) {
    EXPECT_EQ(wrong(R"({"ends":"OK"})"), "");
    EXPECT_EQ(wrong(R"({"ends":"Interrupted"})"), "it ended OK, at 3 s");
    EXPECT_EQ(wrong(R"({"ends":"MaxTime"})", R"("max_time":2.5,)"), "");
    EXPECT_EQ(wrong(R"({"ends":"OK"})", R"("max_time":2.5,)").substr(0, 35),
              "it had not ended after its max_time");
}

TEST_F(Trials, ValuesAreSet) {
    EXPECT_EQ(wrong(R"({"always":"n == 7"})", R"("set":{"n":7},)"), "");
    EXPECT_EQ(wrong(R"({"always":"n == 7"})", R"("set":{"m":7},)")
                  .find((folder_ / "t.test.json").string() + ": --set m=7: the plan "),
              0u);
    EXPECT_NE(wrong(R"({"always":"n == 7"})", R"("set":{"m":7},)")
                  .find("has no variable \"m\"; did you mean n?"),
              std::string::npos);
}

TEST_F(Trials, NamesThatCanNeverComeAreRefusedWithTheirPlace) {
    EXPECT_EQ(wrong(R"({"order":["a","cc"]})"),
              (folder_ / "t.test.json").string() +
                  ":1:57: order a, cc: the plan has no actor \"cc\"; did you mean c?");
    EXPECT_NE(wrong(R"({"ends":"Interrupted","by":"son"})").find("did you mean soon?"),
              std::string::npos);
    EXPECT_EQ(wrong(R"({"never":"event == 'Timeot' and actor == 'b'"})"),
              (folder_ / "t.test.json").string() +
                  ":1:57: never \"event == 'Timeot' and actor == 'b'\": no supervisor of the plan "
                  "raises \"Timeot\"; did you mean Timeout?");
    EXPECT_NE(wrong(R"({"always":"x > 1"})").find("give the test a \"world\""), std::string::npos);
    EXPECT_NE(
        wrong(R"({"ends":"OK"})", R"("starts":{"robot":"r","within":[[0,0],[1,1]],"angle":0},)")
            .find("give the test a \"world\""),
        std::string::npos);
}

TEST_F(Trials, CoverageCountsWhatTheRunWentThrough) {
    const auto outcome = run(R"({"ends":"OK"})");
    ASSERT_TRUE(outcome.ok());
    const PlanCoverage& plan =
        outcome.value().coverage.plans.at((folder_ / "P.plan.json").string());
    using Counts = PlanCoverage::Counts;
    EXPECT_EQ(plan.actors, (Counts{{"a", 1}, {"b", 1}, {"c", 1}}));
    EXPECT_EQ(plan.states, (Counts{{"a: Done", 1}, {"b: Done", 0}, {"c: Done", 1}}));
    EXPECT_EQ(plan.supervisors, (Counts{{"b.soon", 1}}));
    EXPECT_EQ(plan.events, (Counts{{"b.soon: Timeout", 1}}));
    EXPECT_EQ(plan.pairs, (Counts{{"a, b", 1}, {"b, c", 1}}));
}

// ---- answers instead of work ----

// It drives until something is in the way, then turns and drives on.
constexpr std::string_view kDrives = R"({
  "format": "vagus-plan/1", "name": "D", "toolboxes": ["carbot"],
  "start": { "actor": "go" },
  "actors": {
    "go": { "template": "Forward", "in": { "distance": 100 },
      "states": { "ForwardSuccessful": "@terminate" },
      "supervisors": { "touch": { "template": "CheckTouchSensor",
                                  "events": { "TouchSensorPressed": "aside" } } } },
    "aside": { "template": "Turn", "in": { "angle": 90 },
               "states": { "TurnSuccessful": "go" } } } })";

TEST_F(Trials, CodeAnswersWithoutAWorld) {
    folder_.write("D.plan.json", kDrives);
    const auto run = [this](std::string_view answers, std::string_view expect) -> std::string {
        const std::string text = R"({"format":"vagus-test/1","plan":"D.plan.json","answers":)" +
                                 std::string(answers) + R"(,"expect":[)" + std::string(expect) +
                                 "]}";
        const auto test = read_test(text, folder_.write("t.test.json", text));
        if (!test.ok()) return test.error().what;
        const auto outcome = run_trial(test.value(), 1, {});
        return outcome.ok() ? outcome.value().verdicts.at(0).what : outcome.error().what;
    };
    // go for 1.5 s, until the touch; aside for 1 s; go again for 5 s: 7.5 s.
    constexpr std::string_view kAnswers =
        R"({"Forward":[{"after":5}],"aside":[{"after":1}],
            "touch.TouchSensorPressed":[{"at":1.5}]})";
    EXPECT_EQ(run(kAnswers, R"({"order":["go","aside","go"]})"), "");
    EXPECT_EQ(run(kAnswers, R"({"never":"t > 7.501"})"), "");
    EXPECT_EQ(run(kAnswers, R"({"eventually":"t >= 7.5"})"), "");
    // Nothing is in the way: the supervisor is silent.
    EXPECT_EQ(run(R"({"Forward":[{"after":5}],"Turn":[{}]})", R"({"order":["go","aside"]})"),
              "the plan came to go at 0 s, and never to aside after that");
    EXPECT_EQ(run(R"({"Forward":[{"after":5}]})", R"({"ends":"OK"})"),
              (folder_ / "t.test.json").string() +
                  ": the actor \"aside\" of the plan D works over a bus (Turn), and there is none; "
                  "give it or its template an answer, as \"Turn\": [{ \"state\": "
                  "\"TurnSuccessful\" }], or the run a world");
    EXPECT_NE(run(R"({"Forwad":[{"after":5}]})", R"({"ends":"OK"})").find("t.test.json:1:58: "),
              std::string::npos);
}

TEST_F(Trials, AnOutcomeGoesThroughAPipe) {
    const auto outcome = run(R"({"ends":"Interrupted"},{"ends":"OK"})");
    ASSERT_TRUE(outcome.ok());
    const Outcome again = read_outcome(format_outcome(outcome.value()));
    EXPECT_EQ(again.verdicts, outcome.value().verdicts);
    EXPECT_EQ(again.end, std::chrono::seconds(3));
    EXPECT_EQ(again.ended, "OK");
    EXPECT_FALSE(again.as_expected());
}

TEST_F(Trials, FailuresHaveTheirPlaceAndGoIntoJUnit) {
    folder_.write("P.plan.json", kPlan);
    TestResult result;
    result.test = read_test(R"({"format":"vagus-test/1","plan":"P.plan.json",
  "expect":[{"never":"n == 7 and actor < 'd'","help":"a & b"}]})",
                            folder_ / "t.test.json")
                      .value();
    result.test.path = "t.test.json";
    const auto outcome = run_trial(result.test, 4, {});
    ASSERT_TRUE(outcome.ok()) << outcome.error().what;
    result.seeds.push_back({.seed = 4, .outcome = outcome.value()});
    result.seeds.push_back({.seed = 5, .trouble = "its process crashed (Aborted)"});
    result.faults.push_back({.words = "random:1:1:3", .result = {.seed = 6, .seconds = 0.5}});
    EXPECT_EQ(describe_failure(result.test, result.seeds[0]),
              "t.test.json:2:13: seed 4, at 3 s: never \"n == 7 and actor < 'd'\": n = 7, actor = "
              "\"\" (a & b)");
    EXPECT_EQ(
        format_junit({result}),
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
        "  <testsuite name=\"t.test.json\" tests=\"3\" failures=\"1\" errors=\"1\" "
        "time=\"0.500\">\n"
        "    <testcase classname=\"t.test.json\" name=\"seed 4\" time=\"0.000\">\n"
        "      <failure message=\"t.test.json:2:13: seed 4, at 3 s: never &quot;n == 7 and actor "
        "&lt; 'd'&quot;: n = 7, actor = &quot;&quot; (a &amp; b)\">t.test.json:2:13: seed 4, at 3 "
        "s: never &quot;n == 7 and actor &lt; 'd'&quot;: n = 7, actor = &quot;&quot; (a &amp; "
        "b)</failure>\n    </testcase>\n"
        "    <testcase classname=\"t.test.json\" name=\"seed 5\" time=\"0.000\">\n"
        "      <error message=\"t.test.json: seed 5: its process crashed (Aborted)\">t.test.json: "
        "seed 5: its process crashed (Aborted)</error>\n    </testcase>\n"
        "    <testcase classname=\"t.test.json\" name=\"seed 6 --chaos random:1:1:3\" "
        "time=\"0.500\"/>\n"
        "  </testsuite>\n</testsuites>\n");
}

}  // namespace
}  // namespace vagus::trial
