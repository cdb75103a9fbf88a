// Shrinking against functions of which it is known what they fail by. Numbers of runs are worked
// out by hand.
#include "trial/shrink.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/rng.hpp"
#include "base/test_folder.hpp"
#include "trial/test_file.hpp"
#include "trial/with_chaos.hpp"

namespace vagus::trial {
namespace {

using namespace std::chrono_literals;

sim::ChaosFault reset_of(const std::string& node, Time at) {
    return {.kind = sim::ChaosKind::Reset, .where = node, .from = at};
}

sim::ChaosFault lost(Time from, std::optional<Time> until) {
    return {.kind = sim::ChaosKind::Lost, .where = "main", .from = from, .until = until};
}

bool has(const Faults& faults, const std::string& node) {
    return std::ranges::any_of(faults, [&node](const auto& one) { return one.where == node; });
}

// Fails at 9 s if all of these nodes are reset.
Breaks failing_by(std::vector<std::string> nodes) {
    return [nodes = std::move(nodes)](const Faults& faults) -> std::optional<Time> {
        const bool all =
            std::ranges::all_of(nodes, [&](const auto& node) { return has(faults, node); });
        return all ? std::optional<Time>(9s) : std::nullopt;
    };
}

std::vector<std::string> nodes_of(const Faults& faults) {
    std::vector<std::string> nodes;
    for (const sim::ChaosFault& one : faults) nodes.push_back(one.where);
    return nodes;
}

const Faults kFour = {reset_of("a", 1s), reset_of("b", 2s), reset_of("c", 3s), reset_of("d", 4s)};
using Nodes = std::vector<std::string>;

// The second half, then d alone.
TEST(Shrinking, FindsTheLastOfFourInTwoRuns) {
    const Shrunk least = shrink(kFour, 9s, failing_by({"d"}));
    EXPECT_EQ(nodes_of(least.faults), Nodes{"d"});
    EXPECT_EQ(least.runs, 2u);
}

// c d: not. a b: fails. b: not. a: fails.
TEST(Shrinking, FindsTheFirstOfFourInFourRuns) {
    const Shrunk least = shrink(kFour, 9s, failing_by({"a"}));
    EXPECT_EQ(nodes_of(least.faults), Nodes{"a"});
    EXPECT_EQ(least.runs, 4u);
}

TEST(Shrinking, KeepsTwoThatAreNeededTogether) {
    const Shrunk least = shrink(kFour, 9s, failing_by({"a", "d"}));
    EXPECT_EQ(nodes_of(least.faults), (Nodes{"a", "d"}));
}

// What begins behind the failure, or lasts longer, needs no run.
TEST(Shrinking, LeavesOutWhatCameTooLate) {
    const Shrunk least = shrink({reset_of("a", 1s), reset_of("late", 5s)}, 4s, failing_by({"a"}));
    EXPECT_EQ(nodes_of(least.faults), Nodes{"a"});
    EXPECT_EQ(least.runs, 0u);
    const Breaks only_as_it_is = [](const Faults&) -> std::optional<Time> { return std::nullopt; };
    const Shrunk cut = shrink({lost(1s, std::nullopt)}, 4005ms, only_as_it_is);
    EXPECT_EQ(cut.faults[0].until, Time(4010ms));
}

// Fails while frames are lost at 2.5 s: each end of 0 to 8 s is found to 20 ms.
TEST(Shrinking, ShortensAWindowToItsInstant) {
    size_t runs = 0;
    const Breaks breaks = [&runs](const Faults& faults) -> std::optional<Time> {
        ++runs;
        const bool hit =
            faults.size() == 1 && faults[0].from <= 2500ms && *faults[0].until > 2500ms;
        return hit ? std::optional<Time>(9s) : std::nullopt;
    };
    const Shrunk least = shrink({lost(0s, 8s)}, 9s, breaks);
    ASSERT_EQ(least.faults.size(), 1u);
    EXPECT_LE(least.faults[0].from, 2500ms);
    EXPECT_GT(*least.faults[0].until, 2500ms);
    EXPECT_LE(*least.faults[0].until - least.faults[0].from, 2 * kShortestFault);
    EXPECT_EQ(least.runs, runs);
    EXPECT_LE(runs, 9u + 8u);  // so many halvings of 8 s, and of what is left before 2.5 s
}

TEST(Shrinking, WeakensWhatIsStrongerThanNeeded) {
    const sim::ChaosFault slow{
        .kind = sim::ChaosKind::Slow, .from = 1s, .until = 1020ms, .by = 0.8};
    const Breaks breaks = [](const Faults& faults) -> std::optional<Time> {
        return !faults.empty() && faults[0].by >= 0.15 ? std::optional<Time>(9s) : std::nullopt;
    };
    EXPECT_EQ(shrink({slow}, 9s, breaks).faults[0].by, 0.2);
}

TEST(Shrinking, EndsAfterSoManyRuns) {
    size_t runs = 0;
    const Breaks never = [&runs](const Faults&) -> std::optional<Time> {
        ++runs;
        return std::nullopt;
    };
    Faults many;
    for (int i = 0; i < 200; ++i) many.push_back(reset_of(std::to_string(i), 1s));
    EXPECT_EQ(shrink(many, 9s, never).runs, kShrinkRunsMax);
    EXPECT_EQ(runs, kShrinkRunsMax);
}

// Against trying all subsets: as few faults as any set that fails whose parts do not.
TEST(Shrinking, GivesASetWithoutAFaultTooMany) {
    for (uint64_t seed = 1; seed <= 200; ++seed) {
        SplitMix64 random(seed);
        Faults faults;
        for (int i = 0; i < 6; ++i) {
            faults.push_back(reset_of(std::string(1, static_cast<char>('a' + i)), 1s));
        }
        Nodes needed;
        for (const sim::ChaosFault& one : faults) {
            if (random.below(3) == 0) needed.push_back(one.where);
        }
        if (needed.empty()) needed.emplace_back("a");
        const Shrunk least = shrink(faults, 9s, failing_by(needed));
        EXPECT_EQ(nodes_of(least.faults), needed) << "seed " << seed;
    }
}

// ---- the test that is written ----

TEST(TestsWithChaos, ReadTheFaultsOfTheirFile) {
    const auto error_of = [](std::string_view members) {
        const auto read = read_test(R"({"format":"vagus-test/1","plan":"a.plan.json",)" +
                                        std::string(members) + R"("expect":[{"ends":"OK"}]})",
                                    "t");
        return read.ok() ? "" : read.error().what;
    };
    EXPECT_EQ(error_of(R"("world":"w","chaos":[{"kind":"reset","node":"a","at":1}],)"), "");
    EXPECT_EQ(error_of(R"("chaos":[{"kind":"reset","node":"a","at":1}],)"),
              "t:1:55: \"chaos\" of the test breaks what a world simulates; give the test a "
              "\"world\"");
    EXPECT_TRUE(error_of(R"("world":"w","chaos":[{"kind":"rest","node":"a","at":1}],)")
                    .starts_with("t:1:76: \"kind\" of fault 1"));
}

TEST(TestsWithChaos, AreWrittenWithPathsFromTheirFolder) {
    const test::Folder folder;
    const std::string text =
        R"({"format":"vagus-test/1","plan":"P.plan.json","world":"../w.world.json","seeds":[1,9],)"
        R"("expect":[{"ends":"OK"}]})";
    const std::string path = folder.write("tests/t.test.json", text);
    const auto test = read_test(text, path);
    ASSERT_TRUE(test.ok()) << test.error().what;
    const auto written = with_chaos(test.value(), text, {7, {reset_of("a", 1500ms)}},
                                    (folder / "found/t.chaos-1.test.json").string());
    ASSERT_TRUE(written.ok()) << written.error().what;
    EXPECT_EQ(written.value(), R"({
  "format": "vagus-test/1",
  "plan": "../tests/P.plan.json",
  "world": "../w.world.json",
  "seeds": [7, 7],
  "chaos": [{ "kind": "reset", "node": "a", "at": 1.5 }],
  "expect": [{ "ends": "OK" }]
}
)");
}

}  // namespace
}  // namespace vagus::trial
