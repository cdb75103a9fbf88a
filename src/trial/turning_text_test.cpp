#include "trial/turning_text.hpp"

#include <gtest/gtest.h>

using namespace vagus;
using namespace vagus::trial;
using namespace std::chrono_literals;

namespace {

TurningTold told_of(Turning turning) {
    return {.file = "run.mcap",
            .condition = "contact >= 2",
            .question = {.end = 4s, .came = true, .tries = 20},
            .run = {.came = 4s, .end = 4s},
            .turning = std::move(turning)};
}

// 10 of 20 has the interval 0.299 to 0.701, and 20 of 20 that from 0.839.
TEST(TurningText, TellsTheCurveTheTurnAndTheRecordings) {
    const Point open{.at = 0s, .share = {10, 20}, .with = 5, .without = 6};
    const Point decided{.at = 2s, .share = {20, 20}};
    const Point end{.at = 4s, .share = {20, 20}, .is_end = true};
    Turn turn{.before = open, .after = decided};
    turn.before.at = 999ms;
    turn.after.at = 1s;
    turn.with = Continuation{999ms, 5};
    turn.without = Continuation{999ms, 6};
    TurningTold told = told_of({.curve = {open, decided, end}, .turn = turn});
    told.there = {{.at = 1s,
                   .what = "the script of thymio-II called math.rand",
                   .place = "go.aesl:7",
                   .value = ""}};
    told.with = "turning-point/run.with.mcap";
    told.without = "turning-point/run.without.mcap";
    EXPECT_EQ(format_turning(told),
              R"(run.mcap: contact >= 2 became true at 4.000 s
of 20 continuations from an instant, it became true after it in (95 % interval):
      0.000 s  ##########..........    10 of 20    30 % to  70 %
      2.000 s  ####################    20 of 20    84 % to 100 %
      4.000 s  it became true
it turned between 0.999 s and 1.000 s: before in 10 of 20, from then on in 20 of 20
      1.000 s  the script of thymio-II called math.rand  go.aesl:7
with     turning-point/run.with.mcap  (--from 0.999 --reseed 5)
without  turning-point/run.without.mcap  (--from 0.999 --reseed 6)
  vagus compare turning-point/run.with.mcap turning-point/run.without.mcap
)");
    EXPECT_EQ(
        format_turning_json(told),
        R"({"condition":"contact >= 2","came":4.000000,"end":4.000000,"tries":20,)"
        R"("continuations":0,"curve":[)"
        "\n"
        R"({"t":0.000000,"came":10,"of":20,"low":0.2993,"high":0.7007,"end":false},)"
        "\n"
        R"({"t":2.000000,"came":20,"of":20,"low":0.8389,"high":1.0000,"end":false},)"
        "\n"
        R"({"t":4.000000,"came":20,"of":20,"low":0.8389,"high":1.0000,"end":true}],"turn":)"
        R"({"before":{"t":0.999000,"came":10,"of":20,"low":0.2993,"high":0.7007,"end":false},)"
        R"("after":{"t":1.000000,"came":20,"of":20,"low":0.8389,"high":1.0000,"end":false},)"
        R"("narrowed":true,"with":{"file":"turning-point/run.with.mcap","from":0.999000,)"
        R"("seed":5},"without":{"file":"turning-point/run.without.mcap","from":0.999000,)"
        R"("seed":6},"there":[)"
        "\n"
        R"({"t":1.000000,"what":"the script of thymio-II called math.rand",)"
        R"("place":"go.aesl:7","value":"","root":false,"element":""})"
        "\n]}}\n");
}

TEST(TurningText, TellsThatChanceDidNotDecide) {
    const Point all{.at = 0s, .share = {20, 20}};
    const Point end{.at = 4s, .share = {20, 20}, .is_end = true};
    const std::string always = format_turning(told_of({.curve = {all, end}}));
    EXPECT_NE(always.find("not decided by chance: it became true in all 20 continuations\n"),
              std::string::npos)
        << always;
    TurningTold never = told_of({.curve = {{.at = 0s, .share = {0, 20}}, end}});
    never.run = {.came = {}, .end = 4s};
    EXPECT_NE(format_turning(never).find("it became true in none of 20 continuations\n"),
              std::string::npos);
    EXPECT_TRUE(format_turning(never).starts_with(
        "run.mcap: contact >= 2 did not become true by 4.000 s\n"));
}

TEST(TurningText, TheEndOfARunGoesThroughAPipe) {
    for (const RunEnd& end : {RunEnd{.came = 1500ms, .end = 2s}, RunEnd{.came = {}, .end = 7s}}) {
        EXPECT_EQ(read_run_end(format_run_end(end)), end);
    }
}

}  // namespace
