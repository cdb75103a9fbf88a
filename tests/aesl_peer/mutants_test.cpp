// Programs with mistakes through our compiler and through Debian's: whether there is an error, its
// code and its line must agree; and where both accept the program, its run. VAGUS_LONG makes 20
// times as many; VAGUS_SEED=N one.
#include <gtest/gtest.h>

#include <cstdio>
#include <regex>

#include "base/text.hpp"
#include "mutate.hpp"
#include "our_run.hpp"
#include "peer.hpp"
#include "reference/generate.hpp"
#include "survive.hpp"

namespace vagus::aesl {
namespace {

constexpr uint64_t kMutants = 20'000;
constexpr size_t kPeerWordsMax = 2000;  // a jump reaches over 2047 words; it does not check it

// The golden sources as they are, and their node.
struct Sources {
    NodeFile node = golden_node();
    NodeFile large = roomy(golden_node());
    std::vector<Case> golden;

    Sources() {
        for (const std::string& name : golden_names()) golden.push_back(golden_case(name).program);
    }
};

struct Mutant {
    Case program;
    const NodeFile& node;
};

Mutant mutant(uint64_t seed, const Sources& sources) {
    Dice dice(seed);
    const bool from_golden = dice.chance(60);
    const NodeFile& node = from_golden && dice.chance(50) ? sources.node : sources.large;
    Case program = from_golden ? dice.pick(sources.golden)
                               : generate(seed, sources.large, Avoid::DefectsOfTheReference);
    program.source = mutate(program.source, dice);
    return {program, node};
}

std::string_view line_of(const std::string& source, int line) {
    const auto lines = split(source, '\n');
    const auto index = static_cast<size_t>(line - 1);
    return line >= 1 && index < lines.size() ? lines[index] : std::string_view{};
}

// Why a difference is as it should be; empty: it is not. Each reason is in the specification.
std::string_view excuse(const Mutant& made, const OurRun& ours, const Outcome& theirs) {
    if (ours.outcome.error) {
        const std::string& code = ours.outcome.error->code;
        if (code == "ARRAY_ILLEGAL_ACCESS") return "3.5: every index of several words is refused";
        if (code == "NOT_CONST_EXPR" || code == "INDEX_EXPECTING_CONSTANT" ||
            ours.message.find("start of a slice must be a constant") != std::string::npos)
            return "3.6: a vector is no constant";
        static const std::regex bare("\\b0[xb](?![0-9A-Za-z_.])");
        const bool is_bad_number = code == "INVALID_BINARY_NUMBER" || code == "INVALID_HEXA_NUMBER";
        if (is_bad_number && std::regex_search(made.program.source, bare))
            return "1.4: 0x and 0b need digits";
        return {};
    }
    const bool is_room = theirs.error && (theirs.error->code == "STACK_OVERFLOW" ||
                                          theirs.error->code == "NOT_ENOUGH_TEMP_SPACE");
    if (is_room) return "4.5, 4.9: temporaries are released, the stack is counted exactly";
    if (theirs.error) return {};
    const auto has = [&](std::string_view word) {
        return made.program.source.find(word) != std::string::npos;
    };
    if (has("return") && has("sub ")) return "4.8: a return in an if at the end of a sub";
    const auto& fault = ours.outcome.fault;
    const bool is_deque =
        fault && fault->kind == FaultCause::ArrayOutOfBounds &&
        line_of(made.program.source, fault->line).find("deque.") != std::string_view::npos;
    return is_deque ? "A.2: an array of fewer than three words holds no deque" : "";
}

// "" if both agree, kExcused and the reason if they may differ, else the whole case.
constexpr char kExcused = '!';
std::string compared(uint64_t seed, const Sources& sources, PeerCompiler& small,
                     PeerCompiler& large) {
    const Mutant made = mutant(seed, sources);
    // The header colons of 2007 are errors to the peer.
    const OurRun ours = run_ours(made.program, made.node, Dialect::Modern);
    if (ours.outcome.out_of_steps || ours.bytecode_words > kPeerWordsMax) return {};
    PeerCompiler& peer = &made.node == &sources.node ? small : large;
    const Outcome theirs = run_peer(peer, made.program, made.node);
    if (theirs.out_of_steps || ours.outcome == theirs) return {};
    if (const std::string_view reason = excuse(made, ours, theirs); !reason.empty())
        return kExcused + std::string(reason);
    return explain(seed, made.program, to_string(theirs), to_string(ours.outcome));
}

TEST(Mutants, AreJudgedAndRunAsByThePeer) {
    const Sources sources;
    PeerCompiler small(sources.node);
    PeerCompiler large(sources.large);
    const std::vector<uint64_t> chosen = seeds(kMutants);
    const Survivors all = survive(
        chosen.size(), [&](size_t i) { return compared(chosen[i], sources, small, large); });
    size_t excused = 0;
    for (const std::string& said : all.said) {
        const bool is_excused = !said.empty() && said.front() == kExcused;
        excused += is_excused ? 1 : 0;
        EXPECT_TRUE(said.empty() || is_excused) << said;
    }
    // It is the peer that crashes: ours is done when it begins. Few do, or nothing was compared.
    EXPECT_LE(all.killed.size() + excused, 5 + chosen.size() / 500);
    for (const size_t i : all.killed) {
        const Mutant made = mutant(chosen[i], sources);
        run_ours(made.program, made.node, Dialect::Modern);  // ends this test if ours it was
    }
    std::printf(
        "figure: %zu programs with mistakes judged as by libasebacompiler, seeds %llu to "
        "%llu; %zu differ as the specification says, %zu crash it\n",
        chosen.size(), static_cast<unsigned long long>(chosen.front()),
        static_cast<unsigned long long>(chosen.back()), excused, all.killed.size());
}

}  // namespace
}  // namespace vagus::aesl
