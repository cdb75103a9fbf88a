// Tests of a world without a plan. A Thymio at 200 of 500 drives 200 / 500 * 16.6 = 6.64 cm/s.
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "record/replay.hpp"
#include "trial/kept_run.hpp"
#include "trial/report.hpp"
#include "trial/trial.hpp"

namespace vagus::trial {
namespace {

// It tells each second how often, and is at 0.1 + 0.0664 * t.
constexpr std::string_view kAhead = R"(var ticks = 0
timer.period[0] = 1000
motor.left.target = 200
motor.right.target = 200
onevent timer0
    ticks = ticks + 1
    if ticks == 3 then
        emit third
    end
    emit tick
)";
constexpr std::string_view kRobot = R"({"name":"a","type":"thymio2","at":[0.1,0.5],)"
                                    R"("script":"ahead.aesl"})";
constexpr std::string_view kSecond = R"(,{"name":"b","type":"thymio2","at":[1,0.8],)"
                                     R"("node":2,"script":"ahead.aesl"})";

class ScriptTrials : public ::testing::Test {
protected:
    void SetUp() override {
        folder_.write("ahead.aesl", kAhead);
        world(std::string(kRobot));
    }
    void world(const std::string& robots) {
        folder_.write("w.world.json",
                      R"({"format":"vagus-world/1","name":"W","seed":1,"size":[2,1],"robots":[)" +
                          robots + "]}");
    }
    Result<TestFile> read(std::string_view expect, std::string_view members) {
        const std::string text =
            R"({"format":"vagus-test/1","world":"w.world.json","max_time":6,)" +
            std::string(members) + R"("expect":[)" + std::string(expect) + "]}";
        return read_test(text, folder_ / "t.test.json");
    }
    Result<Outcome> run(std::string_view expect, std::string_view members = "",
                        const TrialOptions& options = {}) {
        const TestFile test = TRY(read(expect, members));
        return run_trial(test, 1, options);
    }
    // What is wrong with the only expectation; empty: nothing.
    std::string wrong(std::string_view expect, std::string_view members = "") {
        const auto outcome = run(expect, members);
        if (!outcome.ok()) return outcome.error().what;
        at_ = outcome.value().verdicts.at(0).at;
        return outcome.value().verdicts.at(0).what;
    }
    std::string in_file(const std::string& rest) {
        return (folder_ / "t.test.json").string() + rest;
    }

    test::Folder folder_;
    Time at_{};
};

TEST_F(ScriptTrials, ConditionsReadTheWorldAndTheScript) {
    EXPECT_EQ(wrong(R"({"eventually":"x > 0.4","within":5})"), "");
    EXPECT_EQ(wrong(R"({"always":"abs(y - 0.5) < 0.05 and contact == 0"})"), "");
    EXPECT_EQ(wrong(R"({"eventually":"node('thymio-II', 'ticks') == 5"})"), "");
    EXPECT_EQ(wrong(R"({"eventually":"node('a/thymio-II', 'motor.left.target') == 200"})"), "");
    EXPECT_EQ(wrong(R"({"eventually":"t == 6"})"), "");
    EXPECT_EQ(wrong(R"({"ends":"MaxTime"})"), "");
}

TEST_F(ScriptTrials, AFailureTellsTheValuesAndWhereTheRobotIs) {
    const std::string what = wrong(R"({"always":"x < 0.3"})");
    EXPECT_TRUE(what.starts_with("x = 0.3")) << what;
    EXPECT_NE(what.find(", y = 0."), std::string::npos) << what;
    // 0.2 m at 0.0664 m/s: 3 s.
    EXPECT_NEAR(seconds_of(at_), 3, 0.3);
    EXPECT_EQ(wrong(R"({"eventually":"x > 1"})").substr(0, 31), "it had not come about when the ");
}

TEST_F(ScriptTrials, EventIsTheOneOnTheBusAtTheInstantItIsSent) {
    EXPECT_EQ(wrong(R"({"eventually":"event == 'tick'","within":1.1})"), "");
    EXPECT_EQ(wrong(R"({"never":"event == 'third' and t < 2.9"})"), "");
    EXPECT_EQ(wrong(R"({"eventually":"event == 'third'","within":3.1})"), "");
    EXPECT_TRUE(wrong(R"({"never":"event == 'third'"})").starts_with("event = \"third\", x = "));
    EXPECT_NEAR(seconds_of(at_), 3, 0.01);
    EXPECT_EQ(wrong(R"({"never":"event == 'thrid'"})"),
              in_file(":1:72: never \"event == 'thrid'\": no script on the robot's bus knows an "
                      "event \"thrid\"; did you mean third?"));
}

TEST_F(ScriptTrials, OfSeveralRobotsOneIsNamed) {
    world(std::string(kRobot) + std::string(kSecond));
    EXPECT_EQ(
        wrong(R"({"always":"x < 1"})"),
        in_file(": conditions are about one robot, and " + (folder_ / "w.world.json").string() +
                " has 2; choose one, as \"robot\": \"a\"; there are: a, b"));
    EXPECT_EQ(wrong(R"({"eventually":"x > 1.2 and abs(y - 0.8) < 0.1"})", R"("robot":"b",)"), "");
    EXPECT_EQ(wrong(R"({"eventually":"node('b/thymio-II', 'ticks') == 5"})", R"("robot":"a",)"),
              "");
    EXPECT_NE(wrong(R"({"always":"x < 1"})", R"("robot":"c",)").find("no robot \"c\" in "),
              std::string::npos);
}

TEST_F(ScriptTrials, WhatDoesNotRunIsRefused) {
    EXPECT_NE(wrong(R"({"always":"node('thymio-II', 'tiks') < 9"})").find("did you mean ticks?"),
              std::string::npos);
    folder_.write("ahead.aesl", "x = \n");
    EXPECT_TRUE(
        wrong(R"({"ends":"MaxTime"})").starts_with((folder_ / "ahead.aesl").string() + ":1:"));
}

TEST_F(ScriptTrials, ScriptsAreLoadedBesideThoseOfTheWorld) {
    folder_.write("slow.aesl", "motor.left.target = 50\nmotor.right.target = 50\n");
    EXPECT_EQ(wrong(R"({"always":"x < 0.3"})", R"("scripts":["slow.aesl"],)"), "");
}

TEST_F(ScriptTrials, PlacesAndFaultsAreOfTheRun) {
    EXPECT_EQ(wrong(R"({"always":"x > 0.5 and y < 0.3"})",
                    R"("starts":{"robot":"a","within":[[0.6,0.2],[0.6,0.2]],"angle":0},)"),
              "");
    EXPECT_EQ(wrong(R"({"always":"x < 0.25"})",
                    R"("chaos":[{"kind":"hung","node":"thymio-II","at":0.5}],)")
                  .substr(0, 4),
              "x = ");
}

TEST_F(ScriptTrials, LinesOfScriptsAreCounted) {
    const auto outcome = run(R"({"ends":"MaxTime"})", "", {.scripts = true});
    ASSERT_TRUE(outcome.ok()) << outcome.error().what;
    const Coverage& coverage = outcome.value().coverage;
    EXPECT_TRUE(coverage.plans.empty());
    const auto& lines = coverage.scripts.at((folder_ / "ahead.aesl").string()).lines;
    EXPECT_EQ(lines.at(6), 5u);  // ticks = ticks + 1, each second before the end
    EXPECT_EQ(lines.at(8), 1u);  // emit third
    EXPECT_EQ(lines.at(3), 1u);  // as it is loaded
}

TEST_F(ScriptTrials, TheRecordingIsTheRun) {
    const std::string file = folder_ / "run.mcap";
    const auto outcome =
        run(R"({"ends":"MaxTime"})",
            R"("starts":{"robot":"a","within":[[0.2,0.4],[0.5,0.6]],"angle":"any"},)",
            {.record = file});
    ASSERT_TRUE(outcome.ok()) << outcome.error().what;
    const auto bytes = MappedFile::open(file);
    const auto reader = mcap::Reader::open(bytes.value().bytes(), file);
    ASSERT_TRUE(reader.ok());
    auto rerun = record::Rerun::open(reader.value(), {});
    ASSERT_TRUE(rerun.ok()) << rerun.error().what;
    EXPECT_EQ(rerun.value()->about().poses, outcome.value().poses);
    EXPECT_EQ(rerun.value()->recorded_until(), std::chrono::seconds(6));
}

// ---- kept ----

TEST_F(ScriptTrials, ARunIsKeptAsATestThatPasses) {
    const std::string file = folder_ / "run.mcap";
    ASSERT_TRUE(run(R"({"ends":"MaxTime"})", "", {.record = file}).ok());
    const auto bytes = MappedFile::open(file);
    const auto reader = mcap::Reader::open(bytes.value().bytes(), file);
    const auto kept = keep_run(reader.value(), {folder_ / "t.test.json", folder_ / "again.mcap"});
    ASSERT_TRUE(kept.ok()) << kept.error().what;
    EXPECT_FALSE(kept.value().differs);
    const std::string& text = kept.value().draft.text;
    for (const std::string_view part :
         {R"("world": "w.world.json")", R"("max_time": 6)", R"("always": "contact == 0")",
          R"("eventually": "event == 'tick'")", R"("eventually": "event == 'third'")",
          R"("eventually": "t > 5.9 and abs(x - 0.)", R"( and abs(y - 0.5) < 0.1")",
          R"({ "ends": "MaxTime" })"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    const auto test = read_test(text, folder_ / "t.test.json");
    ASSERT_TRUE(test.ok()) << test.error().what;
    EXPECT_TRUE(run_trial(test.value(), 1, {}).value().as_expected());
    // Another script drives elsewhere: the test expects that.
    folder_.write("ahead.aesl", "motor.left.target = 50\nmotor.right.target = 50\n");
    const auto other = keep_run(reader.value(), {folder_ / "t.test.json", folder_ / "again.mcap"});
    ASSERT_TRUE(other.ok()) << other.error().what;
    EXPECT_TRUE(other.value().differs);
    EXPECT_EQ(other.value().draft.text.find("event =="), std::string::npos);
}

}  // namespace
}  // namespace vagus::trial
