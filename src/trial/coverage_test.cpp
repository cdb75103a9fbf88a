#include "trial/coverage.hpp"

#include <gtest/gtest.h>

#include "base/test_folder.hpp"
#include "embed/loaded_plan.hpp"
#include "session/toolboxes.hpp"
#include "trial/drawing.hpp"

namespace vagus::trial {
namespace {

TEST(Coverage, IsSummedAndGoesThroughAPipe) {
    Coverage one;
    one.plans["p"].actors = {{"a", 1}, {"b", 0}};
    one.plans["p"].pairs = {{"a, b", 0}};
    one.scripts["s"].lines = {{3, 2}, {4, 0}};
    one.scripts["s"].branches[{3, 0}] = {2, 0};
    const auto json = read_json(format_coverage(one));
    Coverage sum = read_coverage(std::get<JsonValue>(json));
    sum.add(one);
    EXPECT_EQ(sum.plans["p"].actors, (PlanCoverage::Counts{{"a", 2}, {"b", 0}}));
    EXPECT_EQ(sum.scripts["s"].lines, (std::map<int, uint64_t>{{3, 4}, {4, 0}}));
    EXPECT_EQ((sum.scripts["s"].branches[{3, 0}]), (std::array<uint64_t, 2>{4, 0}));
    EXPECT_EQ(format_table(one),
              "p\n  actors       1 of 2\n  states       0 of 0\n  supervisors  0 of 0\n"
              "  events       0 of 0\n  pairs        0 of 1\n"
              "s\n  lines        1 of 2\n  branches     1 of 2\n");
    EXPECT_EQ(format_missing(one.plans["p"]), "  actors       b\n  pairs        a, b\n");
}

// man geninfo, "FILES": the lines of a tracefile.
TEST(Coverage, IsATracefileOfLcov) {
    Coverage one;
    one.scripts["/x/s.aesl"].lines = {{3, 2}, {4, 0}};
    one.scripts["/x/s.aesl"].branches[{3, 0}] = {2, 0};
    one.scripts["/x/s.aesl"].branches[{4, 0}] = {0, 0};
    EXPECT_EQ(format_lcov(one),
              "TN:\nSF:/x/s.aesl\nBRDA:3,0,0,2\nBRDA:3,0,1,0\nBRDA:4,0,0,-\nBRDA:4,0,1,-\n"
              "BRF:4\nBRH:1\nDA:3,2\nDA:4,0\nLF:2\nLH:1\nend_of_record\n");
}

// Of a real robot nobody knows which other lines there are.
TEST(Coverage, OfAScriptThatOnlyFramesTellOfNoOtherLineIsKnown) {
    Coverage told;
    told.scripts["s"].lines = {{8, 5}};
    told.scripts["s"].only_told = true;
    EXPECT_EQ(format_table(told), "s\n  lines        1 that frames tell of\n");
    EXPECT_EQ(format_told(told.scripts["s"]), "  line         8: 5\n");
    EXPECT_EQ(format_lcov(told), "");
    Coverage sum;
    sum.add(told);
    EXPECT_TRUE(sum.scripts["s"].only_told);
    Coverage counted;
    counted.scripts["s"].lines = {{8, 1}, {9, 0}};
    sum.add(counted);
    EXPECT_FALSE(sum.scripts["s"].only_told);
    EXPECT_EQ(sum.scripts["s"].lines, (std::map<int, uint64_t>{{8, 6}, {9, 0}}));
}

TEST(Coverage, ALineThatNoRunOfThePlanSaysDoesNotFit) {
    toolbox::Parts parts;
    run::CodeLibrary library;
    ASSERT_TRUE(session::add_toolboxes(library, parts, {}).ok());
    const auto loaded = embed::LoadedPlan::from_text(
        R"({"format":"vagus-plan/1","name":"P","start":{"actor":"a"},"actors":{
            "a":{"template":"Wait","in":{"seconds":2},"states":{"Done":"@terminate"}}}})",
        "P.plan.json", library);
    ASSERT_TRUE(loaded.ok()) << loaded.report();
    PlanCounter counter(loaded.graph());
    const auto event = [](const char* path, auto what) {
        return plan::TraceEvent{.at = {}, .plan = path, .what = std::move(what)};
    };
    EXPECT_FALSE(counter.fits(event("P", plan::ActorStarted{"a", 1, {}})));  // nothing runs yet
    EXPECT_TRUE(counter.fits(event("P", plan::PlanStarted{})));
    counter.see(event("P", plan::PlanStarted{}));
    EXPECT_TRUE(counter.fits(event("P", plan::ActorStarted{"a", 1, {}})));
    EXPECT_FALSE(counter.fits(event("P", plan::ActorStarted{"b", 1, {}})));
    counter.see(event("P", plan::ActorStarted{"a", 1, {}}));
    EXPECT_FALSE(counter.fits(event("P/a", plan::PlanStarted{})));  // a is no plan
    EXPECT_FALSE(counter.fits(event("P/a/b", plan::PlanStarted{})));
    EXPECT_FALSE(counter.fits(event("P/a", plan::ActorStarted{"a", 1, {}})));
    EXPECT_TRUE(counter.fits(event("P", plan::ActorEnded{"a", 1, "Done", ""})));
    EXPECT_FALSE(counter.fits(event("P", plan::ActorEnded{"a", 1, "Undone", ""})));
    EXPECT_FALSE(counter.fits(event("P", plan::EventRaised{"soon", "Timeout", "", false, 1})));
}

TEST(Drawing, ColoursWhatWasTaken) {
    plan::Plan plan;
    plan.name = "P";
    plan.actors.resize(2);
    plan.actors[0].name = "a";
    plan.actors[0].states.push_back({"Done", {}, "b"});
    plan.actors[1].name = "b<c";
    PlanCoverage coverage;
    coverage.actors = {{"a", 2}, {"b<c", 0}};
    coverage.states = {{"a: Done", 2}};
    const std::string svg = draw_coverage(plan, coverage);
    EXPECT_NE(svg.find(">a</text>"), std::string::npos);
    EXPECT_NE(svg.find("b&lt;c"), std::string::npos);
    EXPECT_EQ(svg.find("stroke-dasharray"), std::string::npos);  // the only arrow leads nowhere
    plan.actors.back().name = "b";
    EXPECT_NE(draw_coverage(plan, coverage).find("url(#taken)"), std::string::npos);
    coverage.states.clear();
    EXPECT_NE(draw_coverage(plan, coverage).find("url(#never)"), std::string::npos);
}

}  // namespace
}  // namespace vagus::trial
