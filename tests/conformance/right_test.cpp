// A node that is right passes, and every row was really looked at.
#include <gtest/gtest.h>

#include <set>

#include "conformance/checks.hpp"
#include "virtual_line.hpp"

namespace vagus::conformance {
namespace {

const std::string kFlashStays =
    "flash: WriteBytecode leaves program and variables: it would overwrite the program that the "
    "node keeps: say --flash\n"
    "flash: a saved program starts by itself after Reboot: it would overwrite the program that the "
    "node keeps: say --flash\n";

const std::string kStaysAwake =
    "sleep: SuspendToRam leaves a node awake that cannot sleep: a node that can sleep would have "
    "to be switched on: say --sleep\n";

TEST(Conformance, TheSoftwareNodePassesEverything) {
    const Report report = examine_virtual(node_with());
    EXPECT_EQ(rows_with(report, Verdict::Failed), "");
    EXPECT_EQ(rows_with(report, Verdict::NotRun), "");
    EXPECT_EQ(rows_with(report, Verdict::Skipped),
              "description: fragments of the description can be asked for: needs protocol version "
              "8; the node has 5\n" +
                  kFlashStays + kStaysAwake);
    EXPECT_TRUE(report.left_clear);
}

TEST(Conformance, NoTwoChecksHaveOneName) {
    std::set<std::string> names;
    for (const Check& check : all_checks()) {
        EXPECT_TRUE(names.insert(check.name).second) << check.name;
        EXPECT_FALSE(check.section.empty()) << check.name;
    }
}

// A node with no free variable and hardly any bytecode: all that does not fit is skipped, nothing
// fails for it.
TEST(Conformance, ATinyNodeIsAskedForNoMoreThanItHas) {
    const Report report = examine_virtual(node_with({.bytecode = 1, .stack = 1, .variables = 38}));
    EXPECT_EQ(rows_with(report, Verdict::Failed), "");
    EXPECT_EQ(rows_with(report, Verdict::NotRun), "");
    EXPECT_GT(report.count(Verdict::Skipped), 25u);
    EXPECT_GT(report.count(Verdict::Passed), 5u);
}

// What docs/porting.md promises of a small node.
TEST(Conformance, ASmallNodeIsExaminedInNearlyEverything) {
    const Report report =
        examine_virtual(node_with({.bytecode = 64, .stack = 16, .variables = 78}));
    EXPECT_EQ(rows_with(report, Verdict::Failed), "");
    EXPECT_EQ(rows_with(report, Verdict::NotRun), "");
    EXPECT_EQ(rows_with(report, Verdict::Skipped),
              "description: fragments of the description can be asked for: needs protocol version "
              "8; the node has 5\n"
              "programs: a program of more than 256 words arrives whole: needs 264 words of "
              "bytecode; the node has 64\n"
              "opcodes: Emit sends 258 words: needs 258 free variables; the node has 40\n"
              "program: _program is the checksum of what was loaded: needs 266 words of bytecode; "
              "the node has 64\n" +
                  kFlashStays +
                  "limits: all variables asked for at once come in pieces: needs more than 257 "
                  "variables; the node has 78\n"
                  "limits: an Emit of 259 words: needs 259 variables; the node has 78\n" +
                  kStaysAwake);
}

// Frames that no host sends to a node (sections 2.4 and 3.9), and events with half a word.
bool is_taken_for_noise(const wire::Frame& frame) {
    if (wire::is_user_event(frame.type)) return frame.size % 2 != 0;
    return frame.type >= 0x9000 && (frame.type < 0xa000 || frame.type > 0xa01f);
}

// Page 0151: a line that may lose bytes may lose the frame behind noise, too.
TEST(Conformance, ANodeBehindALineThatTakesSomeFramesForNoisePasses) {
    bool lost_before = false;
    const auto robust = [&lost_before](const wire::Frame& frame) -> std::vector<wire::Frame> {
        const bool lost = lost_before;
        lost_before = is_taken_for_noise(frame);
        if (lost || lost_before) return {};
        return {frame};
    };
    const Report report = examine_virtual(node_with(), {.to_node = robust});
    EXPECT_EQ(rows_with(report, Verdict::Failed), "");
    EXPECT_EQ(rows_with(report, Verdict::NotRun), "");
}

TEST(Conformance, OnlySomeChecksAreMadeIfAskedSo) {
    const Report report = examine_virtual(node_with(), {}, "SubCall");
    EXPECT_EQ(report.rows.size(), 2u);
    EXPECT_EQ(report.count(Verdict::Passed), 2u);
}

}  // namespace
}  // namespace vagus::conformance
