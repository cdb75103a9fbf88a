// The evaluator of the tree against the golden cases, and the compiler with the machine against the
// evaluator on programs made up from seeds. VAGUS_LONG runs 20 times as many; VAGUS_SEED=N one.
#include <gtest/gtest.h>

#include "our_run.hpp"
#include "reference/evaluate.hpp"
#include "reference/generate.hpp"

namespace vagus::aesl {
namespace {

constexpr uint64_t kPrograms = 3000;

// The reference must be right itself: all golden cases but those about sizes of bytecode and stack,
// at which it does not look.
TEST(Reference, TheEvaluatorPassesTheGoldenCases) {
    const NodeFile node = golden_node();
    size_t compared = 0;
    for (const std::string& name : golden_names()) {
        const Golden golden = golden_case(name);
        if (is_want_of_room(golden.outcome)) continue;
        const Outcome found = in_golden_form(evaluate(golden.program, node), node);
        EXPECT_EQ(to_string(found), to_string(golden.outcome)) << name;
        EXPECT_EQ(found, golden.outcome) << name;
        ++compared;
    }
    EXPECT_GE(compared, 240u);
}

TEST(Reference, TheCompilerPassesTheGoldenCases) {
    const NodeFile node = golden_node();
    for (const std::string& name : golden_names()) {
        const Golden golden = golden_case(name);
        const Outcome found = in_golden_form(run_ours(golden.program, node).outcome, node);
        EXPECT_EQ(to_string(found), to_string(golden.outcome)) << name;
        EXPECT_EQ(found, golden.outcome) << name;
    }
}

// What a set of programs was good for: a generator whose programs all fail would test nothing.
struct Tally {
    size_t ran_to_the_end = 0;
    size_t faulted = 0;
    size_t refused = 0;
    size_t left_out = 0;
};

TEST(Reference, MadeUpProgramsRunAsTheTreeSays) {
    const NodeFile node = roomy(golden_node());
    const std::vector<uint64_t> chosen = seeds(kPrograms);
    Tally tally;
    for (const uint64_t seed : chosen) {
        const Case program = generate(seed, node, Avoid::Nothing);
        const Outcome expected = evaluate(program, node);
        const Outcome found = run_ours(program, node).outcome;
        if (expected.out_of_steps || is_want_of_room(found)) {
            ++tally.left_out;
            continue;
        }
        if (expected.error) {
            ++tally.refused;
        } else if (expected.fault) {
            ++tally.faulted;
        } else {
            ++tally.ran_to_the_end;
        }
        ASSERT_EQ(found, expected) << explain(seed, program, to_string(expected), to_string(found));
    }
    RecordProperty("ran_to_the_end", static_cast<int>(tally.ran_to_the_end));
    RecordProperty("faulted", static_cast<int>(tally.faulted));
    RecordProperty("refused", static_cast<int>(tally.refused));
    RecordProperty("left_out", static_cast<int>(tally.left_out));
    std::printf("%zu ran to the end, %zu faulted, %zu were refused, %zu left out\n",
                tally.ran_to_the_end, tally.faulted, tally.refused, tally.left_out);
    if (chosen.size() == 1) return;
    EXPECT_GT(tally.ran_to_the_end, chosen.size() / 3);
    EXPECT_GT(tally.faulted, chosen.size() / 50);
    EXPECT_LT(tally.refused + tally.left_out, chosen.size() / 4);
}

}  // namespace
}  // namespace vagus::aesl
