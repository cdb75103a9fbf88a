// Breakpoints: sections 2.3, 2.8, 3.7 and the sixth dump of 2.10.
#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

constexpr uint16_t kBreakpointsMax = 16;  // section 2.3
// Hosts look at these two only: RUNNING stays set on some nodes (D8).
constexpr uint16_t kFlagsThatCount = wire::kFlagActive | wire::kFlagStep;

// 3: push 1 | 4: store | 5: push 2 | 6: store | 7: stop, as in the sixth dump.
Words two_stores(uint16_t at) {
    return program_of(Instructions().small(1).store(at).small(2).store(at + 1).stop());
}
constexpr uint16_t kSecond = 5;

Status set_breakpoint(Bench& bench, uint16_t pc) {
    TRY(bench.command(MessageType::BreakpointSet, {pc}));
    return bench.expect(MessageType::BreakpointSetResult, {pc, 1});
}

// The next message is a state with these flags, of those that count.
Status expect_flags(Bench& bench, State expected) {
    const wire::Frame frame = TRY(bench.hear("ExecutionStateChanged"));
    wire::ExecutionStateChanged state;
    if (wire::decode_message(frame, state) != wire::Error::None)
        return finding("expected ExecutionStateChanged, found " + text_of(frame));
    const uint16_t flags = state.flags & kFlagsThatCount;
    return bench.is_state({state.pc, flags}, expected);
}

Status run_into(Bench& bench, uint16_t from, uint16_t to) {
    TRY(bench.command(MessageType::Run));
    TRY(expect_flags(bench, {from, 1}));
    return expect_flags(bench, {to, 3});
}

Status run_through(Bench& bench) {
    TRY(bench.command(MessageType::Run));
    TRY(expect_flags(bench, {kInitStart, 1}));
    const Ending ending = TRY(bench.wait_for_end());
    if (ending.messages.empty() && ending.state.flags == 0) return Status::done();
    return finding("expected the program to end, found pc " + std::to_string(ending.state.pc) +
                   ", " + text_of_flags(ending.state.flags));
}

// Gives where the two variables lie.
Result<uint16_t> load_two_stores(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(bench.set(at, {0, 0}));
    TRY(bench.load(two_stores(at)));
    return at;
}

Status the_sixth_dump(Bench& bench) {
    const uint16_t at = TRY(load_two_stores(bench));
    TRY(set_breakpoint(bench, kSecond));
    TRY(run_into(bench, kInitStart, kSecond));
    TRY(bench.expect_values(at, {1, 0}));
    TRY(run_into(bench, kSecond, kSecond));  // no progress
    TRY(bench.command(MessageType::Step));
    TRY(expect_flags(bench, {kSecond + 1, 3}));
    TRY(bench.command(MessageType::Step));
    TRY(expect_flags(bench, {kSecond + 2, 3}));
    TRY(bench.command(MessageType::Run));
    TRY(expect_flags(bench, {kSecond + 2, 1}));
    (void)TRY(bench.wait_for_end());
    return bench.expect_values(at, {1, 2});
}

Status before_the_first_instruction(Bench& bench) {
    const uint16_t at = TRY(load_two_stores(bench));
    TRY(set_breakpoint(bench, kInitStart));
    TRY(run_into(bench, kInitStart, kInitStart));
    return bench.expect_values(at, {0, 0});
}

// 3: push 1 | 4: negate | 5: store | 6: back to 3
Status in_a_loop(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    const Instructions code =
        Instructions().small(1).unary(isa::UnaryOperator::Negate).store(at).jump(-3);
    TRY(bench.load(program_of(code)));
    TRY(set_breakpoint(bench, kInitStart + 1));
    TRY(run_into(bench, kInitStart, kInitStart + 1));
    TRY(bench.command(MessageType::Step));
    TRY(expect_flags(bench, {kInitStart + 2, 3}));
    return run_into(bench, kInitStart + 2, kInitStart + 1);
}

Status in_a_handler(Bench& bench) {
    const Instructions handler = Instructions().small(1).unary(isa::UnaryOperator::Negate).stop();
    TRY(bench.start(program_of({{kPing, handler.all()}})));
    TRY(set_breakpoint(bench, kInitStart + 1));
    TRY(bench.event(kPing, {}));
    return expect_flags(bench, {kInitStart + 1, 3});
}

Status clear_one(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(bench.load(two_stores(at)));
    TRY(set_breakpoint(bench, kSecond));
    TRY(set_breakpoint(bench, kSecond + 1));
    TRY(bench.command(MessageType::BreakpointClear, {kSecond}));
    TRY(bench.expect_silence());
    return run_into(bench, kInitStart, kSecond + 1);
}

Status clear_all(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(bench.load(two_stores(at)));
    TRY(set_breakpoint(bench, kSecond));
    TRY(set_breakpoint(bench, kSecond + 1));
    TRY(bench.command(MessageType::BreakpointClearAll));
    TRY(bench.expect_silence());
    return run_through(bench);
}

Status kept_over_reset(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(set_breakpoint(bench, kSecond));
    TRY(bench.load(two_stores(at)));
    TRY(bench.command(MessageType::Reset));
    TRY(bench.expect_state({kInitStart, 3}));
    return run_into(bench, kInitStart, kSecond);
}

Status sixteen_fit(Bench& bench) {
    const uint16_t size = bench.target().bytecode_size;
    if (size < kBreakpointsMax + 2)
        return lacking("18 words of bytecode", "has " + std::to_string(size));
    for (uint16_t pc = 1; pc <= kBreakpointsMax; pc++) TRY(set_breakpoint(bench, pc));
    constexpr uint16_t kOneMore = kBreakpointsMax + 1;
    TRY(bench.command(MessageType::BreakpointSet, {kOneMore}));
    TRY(bench.expect(MessageType::BreakpointSetResult, {kOneMore, 0}));
    TRY(bench.command(MessageType::BreakpointClear, {1}));
    return set_breakpoint(bench, kOneMore);
}

Status set_twice_cleared_once(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(bench.load(two_stores(at)));
    TRY(set_breakpoint(bench, kSecond));
    TRY(set_breakpoint(bench, kSecond));
    TRY(bench.command(MessageType::BreakpointClear, {kSecond}));
    return run_through(bench);
}

// One that is there already succeeds, and takes no place of another.
Status set_twice_takes_one_place(Bench& bench) {
    const uint16_t size = bench.target().bytecode_size;
    if (size < kBreakpointsMax + 2)
        return lacking("18 words of bytecode", "has " + std::to_string(size));
    TRY(set_breakpoint(bench, 1));
    for (uint16_t pc = 1; pc <= kBreakpointsMax; pc++) TRY(set_breakpoint(bench, pc));
    TRY(set_breakpoint(bench, kBreakpointsMax));  // also when all places are taken
    constexpr uint16_t kOneMore = kBreakpointsMax + 1;
    TRY(bench.command(MessageType::BreakpointSet, {kOneMore}));
    return bench.expect(MessageType::BreakpointSetResult, {kOneMore, 0});
}

// The place of the one that was removed is used again, and no other is lost by that.
Status others_stay_when_one_goes(Bench& bench) {
    const uint16_t at = TRY(load_two_stores(bench));
    TRY(set_breakpoint(bench, kSecond));
    TRY(set_breakpoint(bench, kSecond + 1));
    TRY(set_breakpoint(bench, kSecond + 2));
    TRY(bench.command(MessageType::BreakpointClear, {kSecond}));
    TRY(run_into(bench, kInitStart, kSecond + 1));
    TRY(bench.command(MessageType::Step));
    TRY(expect_flags(bench, {kSecond + 2, 3}));
    TRY(bench.expect_values(at, {1, 2}));
    return run_into(bench, kSecond + 2, kSecond + 2);
}

// No breakpoint is there: to clear it removes none of the others.
Status clearing_none_takes_none(Bench& bench) {
    (void)TRY(load_two_stores(bench));
    TRY(set_breakpoint(bench, kSecond));
    TRY(bench.command(MessageType::BreakpointClear, {kSecond + 1}));
    TRY(bench.expect_silence());
    return run_into(bench, kInitStart, kSecond);
}

}  // namespace

void add_breakpoint_checks(Checks& checks) {
    const char* const group = "breakpoints";
    checks.insert(
        checks.end(),
        {{group, "a breakpoint stops, Step leaves it", "2.10-6", "", the_sixth_dump},
         {group, "a breakpoint on the first instruction", "3.7", "", before_the_first_instruction},
         {group, "a breakpoint in a loop stops each time", "3.7", "", in_a_loop},
         {group, "a breakpoint in the handler of an event", "3.7", "", in_a_handler},
         {group, "BreakpointClear removes one", "2.3", "", clear_one},
         {group, "BreakpointClearAll takes all away", "2.3", "", clear_all},
         {group, "breakpoints stay over SetBytecode and Reset", "2.3", "", kept_over_reset},
         {group, "16 breakpoints fit, the next is refused", "2.3", "", sixteen_fit},
         {group, "a breakpoint set twice is one", "8 D17", "D17", set_twice_cleared_once},
         {group, "a breakpoint set twice takes one place", "2.3, 8 D17", "D17",
          set_twice_takes_one_place},
         {group, "the other breakpoints stay when one is cleared", "2.3", "",
          others_stay_when_one_goes},
         {group, "clearing a breakpoint that is none clears no other", "2.3", "",
          clearing_none_takes_none}});
}

}  // namespace vagus::conformance
