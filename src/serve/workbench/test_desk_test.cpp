// Tests of behaviour as pages run them; what runs them is played by the test.
#include "serve/workbench/test_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "serve/edit/test_page.hpp"
#include "serve/workbench/test_runner.hpp"
#include "serve/workbench/test_talk.hpp"

namespace vagus::serve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kTest =
    "{ \"format\": \"vagus-test/1\", \"plan\": \"P.plan.json\", \"expect\": [{ \"ends\": \"OK\" "
    "}] }\n";

class TestDeskTest : public EditTest {
protected:
    TestDeskTest() {
        write("A.test.json", kTest);
        write("sub/B.test.json", kTest);
        write("P.plan.json", "{}");
        enter({});
        editing.on_text_changed([this](const std::string& path) { tests.text_changed(path); });
    }

    // What it was ordered.
    trial::TestOrder begin(const Json& in = Json::object()) {
        ask("tests.run", in);
        const auto packets = host->receive();
        EXPECT_EQ(packets.size(), 1u);
        return trial::read_order(packets.at(0).bytes);
    }
    void hear_host() {
        now += 1s;
        tests.tick(now);
    }
    void plan(const std::vector<trial::PlannedTest>& planned) {
        host->send(kTestsPlanned, trial::format_planned(planned));
        hear_host();
    }
    void tell(const trial::SeedTold& told) {
        host->send(kSeedTold, trial::format_seed(told));
        hear_host();
    }
    Json shown() { return document("tests"); }
    std::string real(const std::string& path) const { return (root / path).string(); }

    std::optional<Pipe> host;
    bool saves = true;
    TestDesk tests{
        desk,
        files,
        scripts,
        [this] { return start_scripted(host); },
        {.doc_of =
             [this](const std::string& file) { return file.substr(root.string().size() + 1); },
         .shorten = [](const std::string& text) { return text; },
         .save_all =
             [this](const Call& call) {
                 if (!saves) call.fail("conflict", "P.plan.json has changed on disk");
                 return saves;
             }}};
};

TEST_F(TestDeskTest, AllTestsOfTheProjectAreRunAndCounted) {
    const trial::TestOrder order = begin();
    EXPECT_THAT(order.tests, ElementsAre(real("A.test.json"), real("sub/B.test.json")));
    EXPECT_FALSE(order.scripts);
    plan({{.seeds = {1, 2}, .world = true}, {.seeds = {5, 5}}});
    EXPECT_EQ(shown()["runs"], 3);
    EXPECT_EQ(shown()["state"], "running");
    tell({.test = 0, .seed = 2});
    tell({.test = 1, .seed = 5});
    EXPECT_EQ(shown()["done"], 2);
    tell({.test = 0, .seed = 1});
    EXPECT_EQ(shown()["state"], "done");
    EXPECT_EQ(shown()["failed"], 0);
    EXPECT_EQ(tests.next_tick(), Time::max());
}

TEST_F(TestDeskTest, AFailureHasItsPlaceInstantAndRecording) {
    const trial::TestOrder order = begin({{"tests", {"A.test.json"}}, {"scripts", true}});
    EXPECT_TRUE(order.scripts);
    plan({{.seeds = {7, 7}, .world = true}});
    tell({.seed = 7,
          .recording = order.results + "/1/A.seed-7.mcap",
          .failures = {{.at = {3, 9}, .t = 1.5, .expected = "ends OK", .what = "it ended Error"}}});
    const Json failure = shown()["tests"][0]["failures"][0];
    EXPECT_EQ(failure["seed"], 7);
    EXPECT_EQ(failure["t"], 1.5);
    EXPECT_EQ(failure["at"], at(3, 9));
    EXPECT_EQ(failure["recording"], ".vagus/test-results/1/A.seed-7.mcap");
    EXPECT_TRUE(tests.has_recording(".vagus/test-results/1/A.seed-7.mcap"));
    EXPECT_FALSE(tests.has_recording(".vagus/journal"));
    EXPECT_FALSE(tests.has_recording(""));
}

TEST_F(TestDeskTest, ATestThatCannotBeRunSaysWhyAndTheOthersAreRun) {
    begin();
    plan(
        {{.refused = real("A.test.json") + ":4:11: \"plan\": expected a text"}, {.seeds = {1, 2}}});
    EXPECT_EQ(shown()["tests"][0]["at"], at(4, 11));
    EXPECT_THAT(shown()["tests"][0]["why"], HasSubstr("expected a text"));
    // Whose runs cannot be is known by the first of them.
    tell({.test = 1, .seed = 1, .refused = "P.plan.json:1:1: no plan"});
    EXPECT_EQ(shown()["tests"][1]["at"], at(1, 1));
    EXPECT_EQ(shown()["state"], "done");
}

TEST_F(TestDeskTest, OneRunAtATimeAndStoppedItKeepsWhatWasTold) {
    begin();
    EXPECT_THAT(refusal("tests.run", Json::object()), HasSubstr("wait for them, or stop them"));
    plan({{.seeds = {1, 9}}, {.seeds = {1, 9}}});
    tell({.test = 0, .seed = 1});
    ask("tests.stop", Json::object());
    EXPECT_EQ(shown()["state"], "stopped");
    EXPECT_EQ(shown()["done"], 1);
    EXPECT_FALSE(host->send(kSeedTold, "") && (host->receive(), !host->closed()));
    begin();
    EXPECT_EQ(shown()["done"], 0);
}

TEST_F(TestDeskTest, AProcessThatDiesOrIsSilentEndsTheRunWithASentence) {
    begin();
    plan({{.seeds = {1, 9}}, {.seeds = {1, 1}}});
    host.reset();
    hear_host();
    EXPECT_EQ(shown()["state"], "failed");
    EXPECT_THAT(shown()["why"], HasSubstr("the process that ran them has gone"));
    begin();
    plan({{.seeds = {1, 9}}, {.seeds = {1, 1}}});
    now += kTestsSilentMax - 2s;
    hear_host();
    EXPECT_EQ(shown()["state"], "running");
    hear_host();
    EXPECT_THAT(shown()["why"], StartsWith("no run of A.test.json has ended for 300 s"));
}

TEST_F(TestDeskTest, FailuresAreToldToTheirLimit) {
    begin({{"tests", {"A.test.json"}}});
    plan({{.seeds = {0, kFailuresToldMax + 1}}});
    for (uint64_t seed = 0; seed <= kFailuresToldMax; ++seed) {
        host->send(kSeedTold, trial::format_seed({.seed = seed, .trouble = "it crashed"}));
        tests.tick(now);
    }
    EXPECT_EQ(shown()["tests"][0]["failed"], kFailuresToldMax + 1);
    EXPECT_EQ(shown()["tests"][0]["failures"].size(), kFailuresToldMax);
    EXPECT_EQ(shown()["tests"][0]["failures"][0]["what"], "it crashed");
}

TEST_F(TestDeskTest, CoverageIsSummedByDocumentUntilItsTextChanges) {
    begin({{"tests", {"A.test.json"}}});
    plan({{.seeds = {1, 2}}});
    for (const uint64_t seed : {uint64_t{1}, uint64_t{2}}) {
        trial::SeedTold told{.seed = seed};
        trial::PlanCoverage& plan = told.coverage.plans[real("sub/../P.plan.json")];
        plan.actors = {{"go", seed}, {"stay", 0}};
        told.coverage.scripts[real("one.aesl")].lines = {{1, 4}};
        tell(told);
    }
    const Json coverage = document("coverage", {{"doc", "P.plan.json"}});
    EXPECT_EQ(coverage["plan"]["actors"], Json({{"go", 3}, {"stay", 0}}));
    EXPECT_EQ(coverage["changed"], false);
    EXPECT_EQ(shown()["coverage"][0]["path"], "P.plan.json");
    EXPECT_EQ(shown()["coverage"][0]["kinds"][0],
              Json({{"name", "actors"}, {"taken", 1}, {"of", 2}}));
    edit("P.plan.json", 0, 0, " ");
    EXPECT_EQ(document("coverage", {{"doc", "P.plan.json"}})["changed"], true);
    EXPECT_EQ(shown()["changed"], Json({"P.plan.json"}));
    EXPECT_FALSE(document("coverage", {{"doc", "A.test.json"}}).contains("plan"));
}

TEST_F(TestDeskTest, WhatWasMadeBeforeTheRunAndIsToldOfDuringItHasNotChanged) {
    ASSERT_TRUE(files.make("New.test.json", kTest).ok());
    begin({{"tests", {"New.test.json"}}});
    tests.text_changed("New.test.json");
    EXPECT_EQ(shown()["changed"], Json::array());
    // What comes, changes or goes after its beginning has.
    ASSERT_TRUE(files.make("Later.test.json", kTest).ok());
    EXPECT_EQ(shown()["changed"], Json({"Later.test.json"}));
    write("A.test.json", "{}");
    tests.text_changed("A.test.json");
    ASSERT_TRUE(files.remove("New.test.json").ok());
    EXPECT_EQ(shown()["changed"], Json({"A.test.json", "Later.test.json", "New.test.json"}));
}

TEST_F(TestDeskTest, LinesOfAScriptCountFromItsBeginning) {
    write("two.aesl",
          "<!DOCTYPE aesl-source>\n<network>\n<node nodeId=\"1\" name=\"a\">var x\nx = 1\n"
          "if x == 1 then\nx = 2\nend\n</node>\n</network>\n");
    files.enter(root);
    scripts.reread();
    ASSERT_EQ(scripts.parts().size(), 1u);
    begin({{"tests", {"A.test.json"}}});
    plan({{.seeds = {1, 1}}});
    trial::SeedTold told{.seed = 1};
    trial::ScriptCoverage& script = told.coverage.scripts[real("two.aesl")];
    script.lines = {{4, 5}, {5, 5}, {6, 0}};
    script.branches[{5, 0}] = {0, 5};
    tell(told);
    const Json lines = document("coverage", {{"doc", scripts.parts()[0].doc}})["lines"];
    const int first = scripts.lines_in("two.aesl").at(0).first;
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0], Json({{"line", 4 - first + 1}, {"count", 5}}));
    EXPECT_EQ(lines[1], Json({{"line", 5 - first + 1}, {"count", 5}, {"ways", 2}, {"taken", 1}}));
    EXPECT_EQ(lines[2]["count"], 0);
}

TEST_F(TestDeskTest, WhatIsNoTestIsRefusedAndSoIsWhatCannotBeSaved) {
    EXPECT_THAT(refusal("tests.run", {{"tests", {"P.plan.json"}}}),
                StartsWith("bad_input: P.plan.json: expected a test"));
    EXPECT_THAT(refusal("tests.run", {{"tests", {"No.test.json"}}}), StartsWith("not_found: "));
    saves = false;
    EXPECT_THAT(refusal("tests.run", Json::object()), StartsWith("conflict: "));
    EXPECT_EQ(shown()["state"], "none");
    ask("tests.stop", Json::object());
    EXPECT_EQ(shown()["state"], "none");
}

}  // namespace
}  // namespace vagus::serve
