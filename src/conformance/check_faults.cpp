// What stops a program, and how the node says so: section 3.8.
#include "conformance/checks.hpp"
#include "wire/reports.hpp"

namespace vagus::conformance {
namespace {

using isa::BinaryOperator;
using wire::MessageType;

constexpr uint16_t kDivisionAt = kInitStart + 4;

// The message that must come, and where the node is paused afterwards.
struct FaultRow {
    MessageType type;
    Words words;
    uint16_t pc_after = 0;
};

// Runs the program; the fault, and nothing else, is told. Then Step does nothing, and Run takes
// events again.
Status faults(Bench& bench, const Words& program, const FaultRow& row) {
    const Ending ending = TRY(bench.run(program));
    if (ending.messages.empty())
        return finding(std::string("expected ") + wire::message_name(uint16_t(row.type)) +
                       ", found the node " + text_of_flags(ending.state.flags));
    TRY(bench.is_message(ending.messages.front(), row.type, row.words));
    if (ending.messages.size() > 1)
        return finding("expected one message, found another: " + text_of(ending.messages[1]));
    TRY(bench.is_state(ending.state, {row.pc_after, kStopped}));
    TRY(bench.command(MessageType::Step));
    TRY(bench.ask_state({row.pc_after, kStopped}));
    TRY(bench.command(MessageType::Run));
    TRY(bench.expect_state({row.pc_after, 0}));
    return bench.expect_silence();
}

// 3: push 7 | 5: push 0 | 7: divide
Instructions division(BinaryOperator which) {
    return Instructions().push(7).push(0).binary(which).stop();
}

Status divide_by_zero(Bench& bench) {
    return faults(bench, program_of(division(BinaryOperator::Divide)),
                  {MessageType::DivisionByZero, {kDivisionAt}, kDivisionAt + 1});
}

Status modulo_by_zero(Bench& bench) {
    return faults(bench, program_of(division(BinaryOperator::Modulo)),
                  {MessageType::DivisionByZero, {kDivisionAt}, kDivisionAt + 1});
}

// It goes where it goes when the condition does not hold.
Status branch_by_zero(Bench& bench) {
    const Instructions code =
        Instructions().push(7).push(0).branch(BinaryOperator::Divide, 9).stop();
    Words program = program_of(code);
    program.resize(program.size() + 10, 0);
    return faults(bench, program, {MessageType::DivisionByZero, {kDivisionAt}, kDivisionAt + 9});
}

// What is behind the fault is not executed.
Status rest_of_the_event_is_lost(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {1}));
    const Instructions code =
        Instructions().push(7).push(0).binary(BinaryOperator::Divide).store(at).stop();
    (void)TRY(bench.run(program_of(code)));
    return bench.expect_values(at, {1});
}

Status load_out_of_bounds(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    const Instructions code = Instructions().push(3).load_indirect(at, 3).store(at).stop();
    return faults(bench, program_of(code),
                  {MessageType::ArrayAccessOutOfBounds, {kInitStart + 2, 3, 3}, kInitStart + 2});
}

// -1 is told as 65535.
Status load_below_the_array(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    const Instructions code = Instructions().push(-1).load_indirect(at, 3).store(at).stop();
    return faults(
        bench, program_of(code),
        {MessageType::ArrayAccessOutOfBounds, {kInitStart + 2, 3, 0xffff}, kInitStart + 2});
}

Status store_out_of_bounds(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    TRY(bench.set(at, {1, 2, 3}));
    const Instructions code = Instructions().push(9).push(2).store_indirect(at, 2).stop();
    TRY(faults(bench, program_of(code),
               {MessageType::ArrayAccessOutOfBounds, {kInitStart + 4, 2, 2}, kInitStart + 4}));
    return bench.expect_values(at, {1, 2, 3});
}

// After a fault and Run the next event is handled as ever.
Status events_after_a_fault(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    const Instructions handler = Instructions().push(6).store(at).stop();
    const Words program = program_of(
        {{kPing, handler.all()}, {isa::kInitEvent, division(BinaryOperator::Divide).all()}});
    (void)TRY(bench.run(program));
    TRY(bench.command(MessageType::Run));
    (void)TRY(bench.hear("ExecutionStateChanged"));
    TRY(bench.event(kPing, {}));
    (void)TRY(bench.wait_for_end());
    return bench.expect_values(at, {6});
}

}  // namespace

void add_fault_checks(Checks& checks) {
    const char* const group = "faults";
    checks.insert(
        checks.end(),
        {{group, "division by zero", "3.8, 2.10-4", "", divide_by_zero},
         {group, "remainder by zero", "3.8", "", modulo_by_zero},
         {group, "division by zero in a condition", "3.5, 3.8", "", branch_by_zero},
         {group, "the rest of the event is lost", "3.8", "", rest_of_the_event_is_lost},
         {group, "an index behind the array, read", "3.8, 2.10-5", "", load_out_of_bounds},
         {group, "an index before the array is told without sign", "3.4", "", load_below_the_array},
         {group, "an index behind the array, written", "3.8", "", store_out_of_bounds},
         {group, "Run after a fault lets events in again", "3.8", "", events_after_a_fault}});
}

}  // namespace vagus::conformance
