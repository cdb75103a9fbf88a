// The golden cases and programs made up from seeds through our compiler and machine and through
// Debian's. VAGUS_LONG runs 20 times as many; VAGUS_SEED=N one.
#include <gtest/gtest.h>

#include "our_run.hpp"
#include "peer.hpp"
#include "reference/generate.hpp"

namespace vagus::aesl {
namespace {

constexpr uint64_t kPrograms = 2000;
// A jump reaches over 2047 words; the reference does not check it (section 3.10).
constexpr size_t kPeerWordsMax = 2000;

// First of all: is the peer that we compare with the one of the golden cases?
TEST(AeslPeer, ThePeerPassesTheGoldenCases) {
    const NodeFile node = golden_node();
    PeerCompiler peer(node);
    for (const std::string& name : golden_names()) {
        const Golden golden = golden_case(name);
        const Outcome found = in_golden_form(run_peer(peer, golden.program, node), node);
        EXPECT_EQ(to_string(found), to_string(golden.outcome)) << name;
        EXPECT_EQ(found, golden.outcome) << name;
    }
}

TEST(AeslPeer, MadeUpProgramsRunAsOnThePeer) {
    const NodeFile node = roomy(golden_node());
    PeerCompiler peer(node);
    const std::vector<uint64_t> chosen = seeds(kPrograms);
    size_t compared = 0;
    for (const uint64_t seed : chosen) {
        const Case program = generate(seed, node, Avoid::DefectsOfTheReference);
        const OurRun ours = run_ours(program, node);
        if (ours.outcome.out_of_steps || ours.bytecode_words > kPeerWordsMax) continue;
        const Outcome expected = run_peer(peer, program, node);
        if (expected.out_of_steps || is_want_of_room(expected)) continue;
        ++compared;
        ASSERT_EQ(ours.outcome, expected)
            << explain(seed, program, to_string(expected), to_string(ours.outcome));
    }
    RecordProperty("compared", static_cast<int>(compared));
    EXPECT_GE(compared, chosen.size() * 3 / 4);
}

}  // namespace
}  // namespace vagus::aesl
