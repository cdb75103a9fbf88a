// vm::run() and fastvm::run() do the same: random programs on two machines, one for each, with
// random commands between runs of random limits. After each of them everything that can be seen of
// the machines is compared, and how they looked to their Hosts in every call.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "isa/isa.hpp"
#include "maker.hpp"
#include "our_vm.hpp"
#include "wire/protocol.hpp"

namespace vagus::vm_peer {

namespace {

using wire::MessageType;

constexpr int kProgramsShort = 20'000;
constexpr int kProgramsLong = 1'000'000;
constexpr int kActionsPerProgram = 60;

class Loops {
public:
    explicit Loops(uint64_t seed) : rng_(seed) {}

    void upload() {
        std::vector<uint16_t> image = make_program(rng_);
        if (rng_.below(8) == 0) spoil(image);
        if (rng_.below(8) == 0) tangle(image);
        image.insert(image.begin(), 0);
        receive(MessageType::SetBytecode, image);
        receive(MessageType::Run, {});
    }

    void act() {
        switch (rng_.below(8)) {
            case 0:
                return event();
            case 1:
                return local_event();
            case 2:
                return command();
            default:
                return run();
        }
    }

    bool equal() const {
        const State small = small_.state();
        const State fast = fast_.state();
        EXPECT_EQ(small.pc, fast.pc);
        EXPECT_EQ(small.flags, fast.flags);
        EXPECT_EQ(small.stack, fast.stack);
        EXPECT_EQ(small.variables, fast.variables);
        EXPECT_EQ(small.bytecode, fast.bytecode);
        EXPECT_EQ(small.breakpoints, fast.breakpoints);
        EXPECT_EQ(small_.sent(), fast_.sent());
        EXPECT_EQ(small_.seen(), fast_.seen());
        EXPECT_EQ(small_done_, fast_done_);
        return !testing::Test::HasFailure();
    }
    long instructions() const { return instructions_; }

private:
    // Words that no compiler would put together: any word, or another opcode.
    void spoil(std::vector<uint16_t>& words) {
        for (uint64_t count = 1 + rng_.below(20); count > 0; --count) {
            uint16_t& word = words[rng_.below(words.size())];
            const auto any = static_cast<uint16_t>(rng_.next());
            const bool opcode_only = rng_.below(2) == 0;
            word = static_cast<uint16_t>(opcode_only ? (word & 0x0fff) | (any & 0xf000) : any);
        }
    }

    // A jump into a LargeImm whose value is a branch, which changes it.
    void tangle(std::vector<uint16_t>& words) {
        const size_t to = 10 + rng_.below(words.size() - 20);
        const size_t from = 10 + rng_.below(words.size() - 20);
        words[to] = isa::instruction(isa::Opcode::LargeImm, 0);
        words[to + 1] = isa::instruction(
            isa::Opcode::Branch, static_cast<uint16_t>(rng_.below(4) << 8 | rng_.below(18)));
        words[to + 2] = static_cast<uint16_t>(rng_.below(8));
        words[from] = isa::instruction(isa::Opcode::SmallImm, static_cast<uint16_t>(rng_.below(2)));
        words[from + 1] = isa::instruction(isa::Opcode::Load, 1);
        words[from + 2] =
            isa::instruction(isa::Opcode::Jump, static_cast<uint16_t>(to + 1 - (from + 2)));
    }

    // Most limits are near what the stretches between two jumps need.
    uint16_t limit() {
        const uint64_t kind = rng_.below(16);
        if (kind == 0) return 5000;  // more than fastvm::run() does without coming up for air
        return static_cast<uint16_t>(kind < 5 ? rng_.below(4) : rng_.below(60));
    }

    void run() {
        const uint16_t most = limit();
        small_done_ = small_.run(most);
        fast_done_ = fast_.run(most);
        instructions_ += small_done_;
    }

    void receive(MessageType type, std::vector<uint16_t> words) {
        words.insert(words.begin(), Geometry::kId);
        small_.receive(static_cast<uint16_t>(type), words);
        fast_.receive(static_cast<uint16_t>(type), words);
    }

    void event() {
        const MadeEvent made = make_event(rng_);
        small_.receive_event(made.source, made.type, made.arguments);
        fast_.receive_event(made.source, made.type, made.arguments);
    }

    void local_event() {
        const auto index = static_cast<uint16_t>(rng_.below(2));
        small_.local_event(index);
        fast_.local_event(index);
    }

    void command() {
        switch (rng_.below(10)) {
            case 0:
                return receive(MessageType::Reset, {});
            case 1:
                return receive(MessageType::Pause, {});
            case 2:
                return receive(MessageType::Stop, {});
            case 3:
                return receive(MessageType::Step, {});
            case 4:
                return receive(MessageType::BreakpointSet, {some_word()});
            case 5:
                return receive(MessageType::BreakpointClear, {some_word()});
            case 6:
                return receive(MessageType::BreakpointClearAll, {});
            case 7:
                return receive(MessageType::SetVariables,
                               {static_cast<uint16_t>(rng_.below(Geometry::kVariables)),
                                make_value(rng_), make_value(rng_)});
            case 8:
                return overwrite();
            default:
                return receive(MessageType::Run, {});
        }
    }

    uint16_t some_word() { return static_cast<uint16_t>(rng_.below(Geometry::kBytecode)); }

    // A part of the program, which may run on: SetBytecode pauses it only.
    void overwrite() {
        std::vector<uint16_t> words(rng_.below(8));
        for (uint16_t& word : words) word = static_cast<uint16_t>(rng_.next());
        words.insert(words.begin(), some_word());
        receive(MessageType::SetBytecode, words);
        if (rng_.below(2) == 0) receive(MessageType::Run, {});
    }

    SplitMix64 rng_;
    OurVm small_{Loop::Small};
    OurVm fast_{Loop::Fast};
    uint16_t small_done_ = 0;
    uint16_t fast_done_ = 0;
    long instructions_ = 0;
};

}  // namespace

TEST(TwoLoops, LeaveTheSameMachine) {
    const uint64_t first = seed();
    const int programs = std::getenv("VAGUS_LONG") != nullptr ? kProgramsLong : kProgramsShort;
    long instructions = 0;
    for (int i = 0; i < programs && !HasFailure(); ++i) {
        const uint64_t number = first + static_cast<uint64_t>(i);
        SCOPED_TRACE(testing::Message() << "repeat with VAGUS_SEED=" << number);
        Loops loops(number);
        loops.upload();
        for (int k = 0; k < kActionsPerProgram && loops.equal(); ++k) loops.act();
        EXPECT_TRUE(loops.equal());
        instructions += loops.instructions();
    }
    std::printf("seed %llu, %d programs, %ld instructions compared\n",
                static_cast<unsigned long long>(first), programs, instructions);
}

// The state after every instruction of a run: its first n instructions, for every n.
TEST(TwoLoops, StopAfterAnyNumberOfInstructions) {
    constexpr uint16_t kInstructionsMax = 200;
    const uint64_t first = seed();
    const int programs = std::getenv("VAGUS_LONG") != nullptr ? 20'000 : 200;
    for (int i = 0; i < programs && !HasFailure(); ++i) {
        const uint64_t number = first + static_cast<uint64_t>(i);
        SCOPED_TRACE(testing::Message() << "repeat with VAGUS_SEED=" << number);
        SplitMix64 rng(number);
        std::vector<uint16_t> image = make_program(rng);
        image.insert(image.begin(), {Geometry::kId, 0});
        OurVm small(Loop::Small);
        const auto start = [&image](OurVm& vm) {
            vm.receive(static_cast<uint16_t>(MessageType::SetBytecode), image);
            vm.receive(static_cast<uint16_t>(MessageType::Run), {Geometry::kId});
            vm.receive_event(3, 0, {1, 2, 3});
        };
        start(small);
        for (uint16_t n = 1; n <= kInstructionsMax; ++n) {
            small.run(1);
            OurVm fast(Loop::Fast);
            start(fast);
            fast.run(n);
            ASSERT_EQ(small.state(), fast.state()) << "after " << n << " instructions";
            ASSERT_EQ(small.sent(), fast.sent()) << "after " << n << " instructions";
        }
    }
}

}  // namespace vagus::vm_peer
