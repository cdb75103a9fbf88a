// Every instruction, operators left out: sections 3.3 to 3.5.
#include <algorithm>

#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using isa::BinaryOperator;

// Runs the code, then compares the variables from `at`. They hold something else before.
Status gives(Bench& bench, uint16_t at, const Instructions& code, const Values& expected) {
    TRY(bench.set(at, Values(expected.size(), 0x5a5a)));
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, expected);
}

Status stop(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(gives(bench, at, Instructions().push(1).store(at).stop().push(2).store(at).stop(), {1}));
    // Its argument does not count; pc stays on it.
    TRY(bench.run_to_end(program_of(Instructions().word(0x0fff))));
    return bench.ask_state({kInitStart, 0});
}

Status small_immediate(Bench& bench) {
    const uint16_t at = TRY(bench.room(4));
    return gives(bench, at,
                 Instructions()
                     .small(0x7ff)
                     .store(at)
                     .small(0x800)
                     .store(at + 1)
                     .small(0xfff)
                     .store(at + 2)
                     .small(0)
                     .store(at + 3)
                     .stop(),
                 {2047, -2048, -1, 0});
}

Status large_immediate(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    return gives(bench, at,
                 Instructions()
                     .push(32767)
                     .store(at)
                     .push(-32768)
                     .store(at + 1)
                     .push(-1)
                     .store(at + 2)
                     .stop(),
                 {32767, -32768, -1});
}

Status load_and_store(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    TRY(bench.set(at, {-7, 9, 0}));
    const Instructions code = Instructions().load(at).load(at + 1).store(at).store(at + 1).stop();
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {9, -7, 0});
}

Status load_and_store_at_the_end(Bench& bench) {
    (void)TRY(bench.room(2));
    const uint16_t last =
        static_cast<uint16_t>(std::min<uint16_t>(bench.target().variables_size, 4096) - 1);
    const uint16_t before = static_cast<uint16_t>(last - 1);
    TRY(bench.set(before, {0, 321}));
    TRY(bench.run_to_end(
        program_of(Instructions().load(last).store(before).push(5).store(last).stop())));
    return bench.expect_values(before, {321, 5});
}

Status load_indirect(Bench& bench) {
    const uint16_t at = TRY(bench.room(5));
    TRY(bench.set(at, {10, 20, 30, 0, 0}));
    const Instructions code = Instructions()
                                  .push(0)
                                  .load_indirect(at, 3)
                                  .store(at + 3)
                                  .push(2)
                                  .load_indirect(at, 3)
                                  .store(at + 4)
                                  .stop();
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {10, 20, 30, 10, 30});
}

Status store_indirect(Bench& bench) {
    const uint16_t at = TRY(bench.room(4));
    TRY(bench.set(at, {1, 2, 3, 4}));
    const Instructions code = Instructions()
                                  .push(55)
                                  .push(1)
                                  .store_indirect(at, 3)
                                  .push(66)
                                  .push(2)
                                  .store_indirect(at, 3)
                                  .stop();
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {1, 55, 66, 4});
}

Status jump(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    // 3: jump to 11 | 4: 1 to at + 1 | 7: 8 to at | 10: stop | 11: jump back to 7
    const Instructions code =
        Instructions().jump(8).push(1).store(at + 1).push(8).store(at).stop().jump(-4);
    return gives(bench, at, code, {8, 0x5a5a});
}

// 10 rounds of `n = n + 1`, with the jumps that section 3.5 shows for while.
Status loop(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    Instructions code;
    code.load(at).push(10).branch(BinaryOperator::Smaller, 8);    // 0: load, 1: push, 3: branch
    code.load(at).push(1).binary(BinaryOperator::Add).store(at);  // 5: body, 5 words
    code.jump(-10).stop();                                        // 10
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {10});
}

// Left and right are compared in their order, and both ways are taken.
Status branch(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    Instructions code;
    code.push(1).push(2).branch(BinaryOperator::Smaller, 6).push(1).store(at).jump(4);
    code.push(0).store(at);
    code.push(2).push(1).branch(BinaryOperator::Smaller, 6).push(1).store(at + 1).jump(4);
    code.push(0).store(at + 1).stop();
    return gives(bench, at, code, {1, 0});
}

// Any operator may decide; what is not 0 holds.
Status branch_on_a_sum(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    Instructions code;
    code.push(3).push(-3).branch(BinaryOperator::Add, 6).push(1).store(at).jump(4);
    code.push(2).store(at);
    code.push(3).push(4).branch(BinaryOperator::Add, 6).push(1).store(at + 1).jump(4);
    code.push(2).store(at + 1).stop();
    return gives(bench, at, code, {2, 1});
}

// What is behind the `when` counts how often it was taken: `at` is compared with 1.
Instructions counting_when(uint16_t at) {
    Instructions code;
    code.load(at).push(1).when(BinaryOperator::Equal, 7);
    code.load(at + 1).push(1).binary(BinaryOperator::Add).store(at + 1).stop();
    return code;
}

// Section 3.5: of the conditions 0, 1, 1, 0, 1 the second and the fifth are edges.
Status when_sees_edges(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(bench.start(program_of({{kPing, counting_when(at).all()}})));
    TRY(bench.set(at, {0, 0}));
    for (const int16_t condition : Values{0, 1, 1, 0, 1}) {
        TRY(bench.set(at, {condition}));
        TRY(bench.event(kPing, {}));
        (void)TRY(bench.wait_for_end());
    }
    return bench.expect_values(at, {1, 2});
}

Status emit(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    TRY(bench.set(at, {5, -6, 7}));
    TRY(bench.run_to_end(
        program_of(Instructions().emit(kPong, at, 3).emit(kPong, at + 1, 1).stop())));
    TRY(bench.expect_event(kPong, {5, -6, 7}));
    TRY(bench.expect_event(kPong, {-6}));
    return bench.expect_silence();
}

Status emit_nothing(Bench& bench) {
    TRY(bench.run_to_end(program_of(Instructions().emit(kPong, 0, 0).stop())));
    TRY(bench.expect_event(kPong, {}));
    return bench.expect_silence();
}

// `count` words, 1000 and up.
Status emit_many(Bench& bench, uint16_t count) {
    const uint16_t at = TRY(bench.room(count));
    Values values;
    for (uint16_t i = 0; i < count; i++) values.push_back(static_cast<int16_t>(1000 + i));
    const auto half = values.begin() + count / 2;
    TRY(bench.set(at, Values(values.begin(), half)));
    TRY(bench.set(static_cast<uint16_t>(at + count / 2), Values(half, values.end())));
    TRY(bench.run_to_end(program_of(Instructions().emit(kPong, at, count).stop())));
    return bench.expect_event(kPong, values);
}

Status emit_as_many_as_are_stored(Bench& bench) {
    return emit_many(bench, 32);
}

// A node with little memory drops what it cannot send, and counts it.
Status emit_the_longest(Bench& bench) {
    const Result<uint16_t> dropped = bench.address_of(kDropped);
    const Values before = dropped.ok() ? TRY(bench.get(dropped.value(), 1)) : Values{0};
    const Status sent = emit_many(bench, wire::kArgumentsMax);
    if (sent.ok() || !dropped.ok()) return sent;
    if (TRY(bench.get(dropped.value(), 1)) == before) return sent;
    return lacking("room to send 522 bytes", std::string("has counted it in ") + kDropped);
}

// 3: call 9 | 4: call 9 | 5: push, store, stop | 9: at = at + 1, back
Status subroutines(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(bench.set(at, {0, 0}));
    Instructions code;
    code.call(kInitStart + 6).call(kInitStart + 6).push(9).store(at + 1).stop();
    code.load(at).push(1).binary(BinaryOperator::Add).store(at).back();
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {2, 9});
}

// One calls another, which comes back to the first.
Status nested_subroutines(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    if (bench.target().stack_size < 3)
        return lacking("a stack of 3 words", "has " + std::to_string(bench.target().stack_size));
    Instructions code;
    code.call(kInitStart + 5).push(3).store(at + 2).stop();   // 3
    code.call(kInitStart + 10).push(2).store(at + 1).back();  // 8
    code.push(1).store(at).back();                            // 13
    return gives(bench, at, code, {1, 2, 3});
}

}  // namespace

void add_opcode_checks(Checks& checks) {
    const char* const group = "opcodes";
    checks.insert(
        checks.end(),
        {{group, "Stop ends the event", "3.4", "", stop},
         {group, "SmallImm pushes -2048 to 2047", "3.4, C", "", small_immediate},
         {group, "LargeImm pushes a whole word", "3.4", "", large_immediate},
         {group, "Load and Store move variables", "3.4", "", load_and_store},
         {group, "Load and Store reach the last variable", "3.4", "", load_and_store_at_the_end},
         {group, "LoadInd reads an element", "3.4", "", load_indirect},
         {group, "StoreInd writes an element", "3.4", "", store_indirect},
         {group, "Jump goes both ways", "3.4", "", jump},
         {group, "Branch takes one way or the other", "3.5", "", branch},
         {group, "Branch closes a loop", "3.5", "", loop},
         {group, "Branch takes any operator", "3.5", "", branch_on_a_sum},
         {group, "Branch of `when` sees edges only", "3.5", "", when_sees_edges},
         {group, "Emit sends variables as an event", "3.4", "", emit},
         {group, "Emit sends an event without arguments", "3.4", "", emit_nothing},
         {group, "Emit sends 32 words", "3.10", "", emit_as_many_as_are_stored},
         {group, "Emit sends 258 words", "1.1, 8 D7", "", emit_the_longest},
         {group, "SubCall and SubRet", "3.4", "", subroutines},
         {group, "SubCall within a subroutine", "3.4", "", nested_subroutines}});
}

}  // namespace vagus::conformance
