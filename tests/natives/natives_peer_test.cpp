// Every standard native beside the same one of Debian's libasebavm: random calls, also with
// arguments that overlap, must leave the same variables and the same kind of fault. What we do
// otherwise on purpose is left out here and said there (docs/spec/aseba-wire-and-vm.md, section 8,
// D3 to D5).
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/rng.hpp"
#include "node/test_node.hpp"
#include "vm/natives.h"

namespace {

using vagus::SplitMix64;
using vagus::node::TestNode;

constexpr int kMemory = 300;  // words of variables that calls may use
constexpr int kCallsOfEach = 20'000;
constexpr uint16_t kStart = 3;  // of the code, behind the event vector

enum class Fault { None, DivisionByZero, OutOfBounds, Text };

// What the library calls in its surroundings ends here.
Fault peer_fault = Fault::None;

Fault fault_of(uint16_t type) {
    if (type == 0x9006) return Fault::OutOfBounds;
    if (type == 0x9007) return Fault::DivisionByZero;
    if (type == 0x9009) return Fault::Text;
    return Fault::None;
}

constexpr AsebaNativeFunctionPointer kPeerNatives[] = {ASEBA_NATIVES_STD_FUNCTIONS};

}  // namespace

extern "C" {
void AsebaSendMessage(AsebaVMState*, uint16_t id, const void*, uint16_t) {
    if (fault_of(id) != Fault::None) peer_fault = fault_of(id);
}
void AsebaSendVariables(AsebaVMState*, uint16_t, uint16_t) {}
void AsebaSendDescription(AsebaVMState*) {}
void AsebaNativeFunction(AsebaVMState* vm, uint16_t id) {
    kPeerNatives[id](vm);
}
void AsebaWriteBytecode(AsebaVMState*) {}
void AsebaResetIntoBootloader(AsebaVMState*) {}
void AsebaPutVmToSleep(AsebaVMState*) {}
void AsebaAssert(AsebaVMState*, int reason) {
    ADD_FAILURE() << "assertion " << reason;
}
}

namespace {

struct Call {
    uint16_t id;
    std::vector<uint16_t> addresses, sizes;
    std::vector<int16_t> memory = std::vector<int16_t>(kMemory);
};

struct Outcome {
    std::vector<int16_t> memory;
    Fault fault = Fault::None;
};

std::vector<uint16_t> code_of(const Call& call) {
    std::vector<uint16_t> code = {kStart, 0xffff, kStart};
    std::vector<uint16_t> pushed = call.addresses;
    pushed.insert(pushed.end(), call.sizes.begin(), call.sizes.end());
    std::reverse(pushed.begin(), pushed.end());
    for (uint16_t word : pushed) code.insert(code.end(), {0x2000, word});
    code.push_back(static_cast<uint16_t>(0xc000 | call.id));
    code.push_back(0);
    return code;
}

Outcome ours(const Call& call) {
    TestNode test;
    const auto code = code_of(call);
    std::copy(code.begin(), code.end(), test.bytecode.begin());
    std::copy(call.memory.begin(), call.memory.end(), test.variables.begin());
    vagus::vm::start_event(test.node.vm, vagus::isa::kInitEvent);
    vagus::node::run(test.node, 1000);
    Outcome outcome;
    outcome.memory.assign(test.variables.begin(), test.variables.begin() + kMemory);
    EXPECT_LE(test.sent.size(), 1u);
    if (!test.sent.empty()) outcome.fault = fault_of(test.sent[0].type);
    EXPECT_TRUE(std::all_of(test.variables.begin() + kMemory, test.variables.end(),
                            [](int16_t word) { return word == 0; }));
    return outcome;
}

Outcome theirs(const Call& call) {
    auto code = code_of(call);
    Outcome outcome;
    std::vector<int16_t> stack(64);
    outcome.memory = call.memory;
    AsebaVMState vm{};
    vm.bytecodeSize = static_cast<uint16_t>(code.size());
    vm.bytecode = code.data();
    vm.variablesSize = kMemory;
    vm.variables = outcome.memory.data();
    vm.stackSize = 64;
    vm.stack = stack.data();
    vm.sp = -1;
    AsebaVMSetupEvent(&vm, 0xffff);
    peer_fault = Fault::None;
    AsebaVMRun(&vm, 1000);
    outcome.fault = peer_fault;
    return outcome;
}

int16_t any_word(SplitMix64& rng) {
    constexpr int16_t kEdges[] = {0, 1, -1, 2, -2, 127, 128, 16384, -16384, 32767, -32768, 181};
    switch (rng.below(3)) {
        case 0:
            return kEdges[rng.below(std::size(kEdges))];
        case 1:
            return static_cast<int16_t>(static_cast<int>(rng.below(21)) - 10);
        default:
            return static_cast<int16_t>(static_cast<uint16_t>(rng.next()));
    }
}

// A call with legal addresses, near each other so that they often overlap.
Call random_call(uint16_t id, SplitMix64& rng) {
    const vagus::node::Native& native = vagus::node::kStandardNatives[id];
    Call call{.id = id, .addresses = {}, .sizes = {}};
    for (auto& word : call.memory) word = any_word(rng);
    const uint16_t lengths[] = {static_cast<uint16_t>(1 + rng.below(12)),
                                static_cast<uint16_t>(1 + rng.below(6))};
    const uint64_t spread = rng.below(2) == 0 ? 20 : 250;
    int templates = 0;
    for (uint16_t i = 0; i < native.parameter_count; ++i) {
        templates = std::max(templates, -native.parameters[i].size);
        call.addresses.push_back(static_cast<uint16_t>(rng.below(spread)));
    }
    call.sizes.assign(lengths, lengths + templates);
    return call;
}

void compare(const Call& call, uint64_t seed) {
    const Outcome mine = ours(call);
    const Outcome peer = theirs(call);
    ASSERT_EQ(mine.fault, peer.fault)
        << vagus::node::kStandardNatives[call.id].name << " seed " << seed;
    for (size_t i = 0; i < mine.memory.size(); ++i) {
        ASSERT_EQ(mine.memory[i], peer.memory[i])
            << vagus::node::kStandardNatives[call.id].name << " word " << i << " seed " << seed
            << " addresses " << testing::PrintToString(call.addresses) << " sizes "
            << testing::PrintToString(call.sizes) << " before "
            << testing::PrintToString(call.memory);
    }
}

uint64_t fresh_seed() {
    return std::random_device{}();
}

class NativesBesidePeer : public testing::TestWithParam<uint16_t> {};

TEST_P(NativesBesidePeer, SameMemoryAndFault) {
    const uint64_t seed = fresh_seed();
    SplitMix64 rng(seed);
    for (int i = 0; i < kCallsOfEach && !HasFatalFailure(); ++i) {
        compare(random_call(GetParam(), rng), seed);
    }
}

std::string test_name(const testing::TestParamInfo<uint16_t>& native) {
    std::string name = vagus::node::kStandardNatives[native.param].name;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

constexpr uint16_t kRand = 20;
constexpr uint16_t kDequeSize = 21;
INSTANTIATE_TEST_SUITE_P(Math, NativesBesidePeer, testing::Range(uint16_t{0}, kRand), test_name);

// The peer's random state is one for the process, ours one for the node: compared as one long
// sequence.
TEST(RandBesidePeer, HasTheSameSequence) {
    AsebaSetRandomSeed(0);
    TestNode test;
    const auto code = code_of({.id = kRand, .addresses = {100}, .sizes = {1}});
    std::copy(code.begin(), code.end(), test.bytecode.begin());
    for (int i = 0; i < 70'000; ++i) {
        vagus::vm::start_event(test.node.vm, vagus::isa::kInitEvent);
        vagus::node::run(test.node, 1000);
        ASSERT_EQ(static_cast<uint16_t>(test.variables[100]), AsebaGetRandom()) << i;
    }
}

// A deque of `cells` at 0 as the functions leave it, block at 100, index and length at 200.
Call deque_call(uint16_t id, SplitMix64& rng) {
    const uint16_t cells = static_cast<uint16_t>(1 + rng.below(9));
    const uint16_t block = static_cast<uint16_t>(1 + rng.below(4));
    Call call{.id = id, .addresses = {}, .sizes = {}};
    for (auto& word : call.memory) word = static_cast<int16_t>(rng.below(1000));
    call.memory[0] = static_cast<int16_t>(rng.below(cells + 1u));
    call.memory[1] = static_cast<int16_t>(rng.below(cells));
    call.memory[200] = static_cast<int16_t>(static_cast<int>(rng.below(cells + 3u)) - 1);
    call.memory[201] = static_cast<int16_t>(1 + rng.below(5));
    const vagus::node::Native& native = vagus::node::kStandardNatives[id];
    call.addresses = {0};
    call.sizes = {static_cast<uint16_t>(cells + 2)};
    uint16_t scalar = 200;
    for (uint16_t i = 1; i < native.parameter_count; ++i) {
        const bool is_block = native.parameters[i].size == -2;
        call.addresses.push_back(is_block ? uint16_t{100} : scalar++);
        if (is_block) call.sizes.push_back(block);
    }
    return call;
}

// D5: there the peer loses elements. Section 4.5: inserts before an element of the front half, not
// the first.
bool is_defect(const Call& call) {
    constexpr uint16_t kInsert = 24;
    return call.id == kInsert && call.memory[200] >= 1 && call.memory[200] < call.memory[0] / 2;
}

class DequesBesidePeer : public testing::TestWithParam<uint16_t> {};

TEST_P(DequesBesidePeer, SameMemoryAndFault) {
    const uint64_t seed = fresh_seed();
    SplitMix64 rng(seed);
    for (int i = 0; i < kCallsOfEach && !HasFatalFailure(); ++i) {
        const Call call = deque_call(GetParam(), rng);
        if (!is_defect(call)) compare(call, seed);
    }
}

INSTANTIATE_TEST_SUITE_P(Deque, DequesBesidePeer,
                         testing::Range(kDequeSize, vagus::node::kStandardNativeCount), test_name);

}  // namespace
