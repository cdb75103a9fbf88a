#include "trial/coverage.hpp"

#include <gtest/gtest.h>

#include "base/test_folder.hpp"
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
