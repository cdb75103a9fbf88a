// What lies outside: the node refuses or ignores it, says so where the specification asks for it,
// and lives on (sections 2.3, 3.8, and D7, D9, D11 and D22 of section 8). The reference may end
// here, so these are the last.
#include <algorithm>

#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using isa::BinaryOperator;
using wire::MessageType;

constexpr uint16_t kFarAway = 0xfff0;

// What it is asked for now shows that it still works.
Status still_works(Bench& bench) {
    TRY(bench.expect_silence());
    return bench.run_to_end(program_of(Instructions().stop()));
}

// ---- memories ----

Status reads_all_variables(Bench& bench) {
    const uint16_t size = bench.target().variables_size;
    if (size <= wire::kVariablesReplyWordsMax)
        return lacking("more than 257 variables", "has " + std::to_string(size));
    (void)TRY(bench.get(0, size));
    return bench.expect_silence();
}

// Whatever of it exists may come, nothing else.
Status reads_beyond(Bench& bench, uint16_t start, uint16_t count) {
    TRY(bench.command(MessageType::GetVariables, {start, count}));
    TRY(bench.command(MessageType::GetExecutionState));
    const wire::Frame frame = TRY(bench.hear("Variables or ExecutionStateChanged"));
    if (frame.type == uint16_t(MessageType::ExecutionStateChanged)) return still_works(bench);
    wire::Variables part;
    const bool read = wire::decode_message(frame, part) == wire::Error::None;
    const int end = read ? part.start + part.values.count : 0;
    if (!read || (part.values.count > 0 && end > bench.target().variables_size))
        return finding("expected variables that exist, found " + text_of(frame));
    (void)TRY(bench.hear("ExecutionStateChanged"));
    return still_works(bench);
}

Status reads_over_the_end(Bench& bench) {
    if (bench.target().variables_size < 2) return lacking("2 variables", "has fewer");
    return reads_beyond(bench, static_cast<uint16_t>(bench.target().variables_size - 2), 8);
}

Status reads_far_away(Bench& bench) {
    return reads_beyond(bench, kFarAway, 8);
}

Status writes_over_the_end(Bench& bench) {
    (void)TRY(bench.room(1));
    const uint16_t last = static_cast<uint16_t>(bench.target().variables_size - 1);
    TRY(bench.set(last, {11, 22, 33}));
    TRY(bench.set(kFarAway, {44}));
    TRY(still_works(bench));
    return bench.expect_values(last, {11});
}

// Each SetBytecode is answered by a state, whatever of it is ignored.
Status loads_over_the_end(Bench& bench) {
    const uint16_t last = static_cast<uint16_t>(bench.target().bytecode_size - 1);
    for (const uint16_t start : Words{last, kFarAway}) {
        TRY(bench.command(MessageType::SetBytecode, {start, 0, 0, 0, 0}));
        (void)TRY(bench.hear("ExecutionStateChanged"));
    }
    return still_works(bench);
}

// It may be refused, or left without an answer.
Status breaks_outside(Bench& bench) {
    TRY(bench.command(MessageType::BreakpointSet, {bench.target().bytecode_size}));
    TRY(bench.command(MessageType::GetExecutionState));
    const wire::Frame frame = TRY(bench.hear("BreakpointSetResult"));
    if (frame.type != uint16_t(MessageType::ExecutionStateChanged)) {
        TRY(bench.is_message(frame, MessageType::BreakpointSetResult,
                             {bench.target().bytecode_size, 0}));
        (void)TRY(bench.hear("ExecutionStateChanged"));
    }
    return still_works(bench);
}

Status hears_commands_that_are_too_short(Bench& bench) {
    for (const MessageType type : {MessageType::SetBytecode, MessageType::BreakpointClear,
                                   MessageType::GetVariables, MessageType::SetVariables})
        TRY(bench.command(type));
    TRY(bench.send(uint16_t(MessageType::GetDescription), {}));
    TRY(bench.clear());
    return still_works(bench);
}

Status survives_a_vector_that_is_too_long(Bench& bench) {
    for (const uint16_t length : Words{0xffff, 0x7fff, 2}) {
        TRY(bench.command(MessageType::SetBytecode, {0, length}));
        (void)TRY(bench.hear("ExecutionStateChanged"));
        TRY(bench.command(MessageType::Run));
        (void)TRY(bench.hear("ExecutionStateChanged"));
        TRY(bench.event(kPing, {}));
        (void)TRY(bench.wait_for_end());
        TRY(bench.clear());
    }
    return still_works(bench);
}

// ---- programs that go astray ----

// Ends in one NodeSpecificError, stopped; a right program then runs.
Status goes_astray(Bench& bench, const Words& program) {
    const Ending ending = TRY(bench.run(program));
    if (ending.messages.empty())
        return finding("expected NodeSpecificError, found the node " +
                       text_of_flags(ending.state.flags));
    for (const wire::Frame& frame : ending.messages)
        if (frame.type != uint16_t(MessageType::NodeSpecificError))
            return finding("expected NodeSpecificError, found " + text_of(frame));
    if (ending.messages.size() > 1)
        return finding("expected one NodeSpecificError, found " +
                       std::to_string(ending.messages.size()));
    if (ending.state.flags != kStopped)
        return finding("expected the node stopped (2), found it " +
                       text_of_flags(ending.state.flags));
    return still_works(bench);
}

Status astray(Bench& bench, const Instructions& code) {
    return goes_astray(bench, program_of(code));
}

Status opcode_that_is_none(Bench& bench) {
    return astray(bench, Instructions().word(0xf000).stop());
}

Status binary_that_is_none(Bench& bench) {
    return astray(bench, Instructions().push(1).push(1).word(0x8012).stop());
}

Status unary_that_is_none(Bench& bench) {
    return astray(bench, Instructions().push(1).word(0x7003).stop());
}

Status stack_overflow(Bench& bench) {
    return astray(bench, Instructions().push(1).jump(-2));
}

Status stack_underflow(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {5}));
    TRY(astray(bench, Instructions().store(at).stop()));
    TRY(bench.expect_values(at, {5}));
    TRY(astray(bench, Instructions().push(1).binary(BinaryOperator::Add).stop()));
    return astray(bench, Instructions().back());
}

Status address_that_is_none(Bench& bench) {
    const uint16_t size = bench.target().variables_size;
    if (size > isa::kArgumentMask) return lacking("fewer than 4096 variables", "has more");
    TRY(astray(bench, Instructions().load(size).stop()));
    TRY(astray(bench, Instructions().push(1).store(size).stop()));
    return astray(bench, Instructions().push(9).load_indirect(size - 1, 100).stop());
}

Status jump_outside(Bench& bench) {
    const uint16_t size = bench.target().bytecode_size;
    TRY(astray(bench, Instructions().push(size).back()));
    TRY(astray(bench, Instructions().push(kFarAway).back()));
    return astray(bench, Instructions().jump(-4));
}

Status emit_outside(Bench& bench) {
    const uint16_t size = bench.target().variables_size;
    TRY(astray(bench, Instructions().emit(kPong, size - 1, 2).stop()));
    return astray(bench, Instructions().emit(kPong, kFarAway, 1).stop());
}

Status emit_too_long(Bench& bench) {
    constexpr uint16_t kTooMany = wire::kArgumentsMax + 1;
    const uint16_t size = bench.target().variables_size;
    if (size < kTooMany) return lacking("259 variables", "has " + std::to_string(size));
    return astray(bench, Instructions().emit(kPong, 0, kTooMany).stop());
}

Status native_that_is_none(Bench& bench) {
    const size_t count = bench.target().natives.size();
    return astray(bench, Instructions().native(static_cast<int>(count)).stop());
}

Status native_without_arguments(Bench& bench) {
    const uint16_t id = TRY(bench.native("math.fill"));
    return astray(bench, Instructions().native(id).stop());
}

Status native_outside(Bench& bench) {
    const uint16_t id = TRY(bench.native("math.fill"));
    const uint16_t size = bench.target().variables_size;
    TRY(astray(bench, Instructions().push(2).push(0).push(size - 1).native(id).stop()));
    return astray(bench, Instructions().push(0x7fff).push(0).push(kFarAway).native(id).stop());
}

}  // namespace

void add_limit_checks(Checks& checks) {
    const char* const group = "limits";
    checks.insert(
        checks.end(),
        {{group, "all variables asked for at once come in pieces", "8 D22", "D22",
          reads_all_variables},
         {group, "commands that are too short harm nothing", "8 D9, D11", "D9 D11",
          hears_commands_that_are_too_short},
         {group, "reading over the end of the variables", "8 D9", "D9", reads_over_the_end},
         {group, "reading far outside the variables", "8 D9", "D9", reads_far_away},
         {group, "writing over the end of the variables", "8 D9", "D9", writes_over_the_end},
         {group, "loading over the end of the bytecode", "8 D9", "D9", loads_over_the_end},
         {group, "a breakpoint outside the bytecode", "8 D9", "D9", breaks_outside},
         {group, "an event vector that is too long", "8 D9", "D9",
          survives_a_vector_that_is_too_long},
         {group, "an opcode that is none", "3.8, 8 D9", "D9", opcode_that_is_none},
         {group, "a binary operator that is none", "3.8, 8 D9", "D9", binary_that_is_none},
         {group, "a unary operator that is none", "3.8, 8 D9", "D9", unary_that_is_none},
         {group, "a stack that is full", "3.8, 8 D9", "D9", stack_overflow},
         {group, "a stack that is empty", "3.8, 8 D9", "D9", stack_underflow},
         {group, "an address outside the variables", "3.8, 8 D9", "D9", address_that_is_none},
         {group, "a jump out of the bytecode", "3.8, 8 D9", "D9", jump_outside},
         {group, "an Emit from outside the variables", "3.8, 8 D9", "D9", emit_outside},
         {group, "an Emit of 259 words", "8 D7", "D7", emit_too_long},
         {group, "a native that is none", "3.8, 8 D9", "D9", native_that_is_none},
         {group, "a native without arguments", "3.8, 8 D9", "D9", native_without_arguments},
         {group, "a native that works outside the variables", "4.1", "D9", native_outside}});
}

}  // namespace vagus::conformance
