// What a node hears and leaves, variables, and the upload of programs: sections 2.1, 2.3 and 2.7.
#include <algorithm>

#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

// ---- what it leaves ----

Status leaves_commands_to_others(Bench& bench) {
    const uint16_t other = bench.nobody();
    TRY(bench.send(number(MessageType::GetExecutionState), {other}));
    TRY(bench.send(number(MessageType::GetVariables), {other, 0, 1}));
    TRY(bench.send(number(MessageType::Pause), {other}));
    TRY(bench.send(number(MessageType::Reset), {other}));
    TRY(bench.send(number(MessageType::BreakpointSet), {other, 1}));
    TRY(bench.send(number(MessageType::GetNodeDescription), {other, wire::kProtocolVersion}));
    return bench.expect_silence();
}

Status leaves_empty_commands(Bench& bench) {
    for (uint16_t type = number(MessageType::SetBytecode);
         type <= number(MessageType::GetNodeDescription); type++)
        TRY(bench.send(type, {}));
    return bench.expect_silence();
}

Status leaves_unknown_types(Bench& bench) {
    for (const uint16_t type : Words{0xa020, 0xafff, 0xb000, 0xfffe}) {
        TRY(bench.send(type, {bench.id(), 0, 0}));
        TRY(bench.expect_silence_again());
    }
    return Status::done();
}

Status leaves_messages_of_nodes(Bench& bench) {
    for (const MessageType type :
         {MessageType::BootloaderAck, MessageType::Variables, MessageType::ExecutionStateChanged})
        TRY(bench.send(number(type), {bench.id(), 0}));
    return bench.expect_silence_again();
}

// A node whose program runs is in no boot loader (section 2.4).
Status leaves_commands_to_boot_loaders(Bench& bench) {
    for (const MessageType type :
         {MessageType::BootloaderReset, MessageType::BootloaderReadPage,
          MessageType::BootloaderWritePage, MessageType::BootloaderPageDataWrite})
        TRY(bench.send(number(type), {bench.id(), 0, 0}));
    return bench.expect_silence();
}

// ---- variables ----

Status keeps_variables(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(bench.set(at, {0x1234, -1}));
    TRY(bench.expect_values(at, {0x1234, -1}));
    TRY(bench.set(at, {-32768, 32767}));
    return bench.expect_values(at, {-32768, 32767});
}

Status writes_without_an_answer(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {1}));
    return bench.expect_silence();
}

Status writes_no_more_than_was_sent(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    TRY(bench.set(at, {1, 2, 3}));
    TRY(bench.set(static_cast<uint16_t>(at + 1), {20}));
    return bench.expect_values(at, {1, 20, 3});
}

Status reaches_the_last_variable(Bench& bench) {
    (void)TRY(bench.room(1));
    const uint16_t last = static_cast<uint16_t>(bench.target().variables_size - 1);
    TRY(bench.set(last, {-12345}));
    return bench.expect_values(last, {-12345});
}

// As many as one message takes, or the node has.
Status takes_many_variables_at_once(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    const uint16_t count = std::min<uint16_t>(bench.room_size(), wire::kSetVariablesWordsMax);
    Values values;
    for (uint16_t i = 0; i < count; i++) values.push_back(static_cast<int16_t>(0x7f00 - 3 * i));
    TRY(bench.set(at, values));
    return bench.expect_values(at, values);
}

Status sends_many_variables_at_once(Bench& bench) {
    const uint16_t size = bench.target().variables_size;
    (void)TRY(bench.get(0, std::min(size, wire::kVariablesReplyWordsMax)));
    return bench.expect_silence();
}

// ---- programs ----

Status has_no_program_after_an_empty_one(Bench& bench) {
    TRY(bench.event(kPing, {1}));
    TRY(bench.command(MessageType::GetExecutionState));
    const wire::Frame frame = TRY(bench.hear("ExecutionStateChanged"));
    wire::ExecutionStateChanged state;
    const bool is_state = wire::decode_message(frame, state) == wire::Error::None;
    if (is_state && state.flags == 0) return bench.expect_silence();
    return finding("expected a node that waits for events (flags 0), found " + text_of(frame));
}

// The second message changes one word of what the first one brought.
Status takes_a_program_in_pieces(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.load(program_of(Instructions().push(111).store(at).stop())));
    TRY(bench.command(MessageType::SetBytecode, {kInitStart + 1, 222}));
    TRY(bench.expect_state({kInitStart, 3}));
    TRY(bench.command(MessageType::Run));
    TRY(bench.expect_state({kInitStart, 1}));
    (void)TRY(bench.wait_for_end());
    return bench.expect_values(at, {222});
}

// Longer than one message: a chain of jumps through all of it.
Status takes_a_program_of_several_messages(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    const uint16_t filling = wire::kBytecodeWordsMax;
    Instructions code;
    code.jump(filling + 1);
    for (uint16_t i = 0; i < filling; i++) code.stop();
    code.push(77).store(at).stop();
    TRY(bench.set(at, {0}));
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {77});
}

Status fills_its_bytecode_memory(Bench& bench) {
    const uint16_t last = static_cast<uint16_t>(bench.target().bytecode_size - 1);
    if (last < kInitStart) return lacking("4 words of bytecode", "has " + std::to_string(last + 1));
    TRY(bench.load({kInitStart, isa::kInitEvent, last}));
    TRY(bench.command(MessageType::SetBytecode, {last, 0}));
    TRY(bench.expect_state({last, 3}));
    TRY(bench.command(MessageType::Run));
    TRY(bench.expect_state({last, 1}));
    (void)TRY(bench.wait_for_end());
    return bench.ask_state({last, 0});
}

Status keeps_variables_over_an_upload(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {4321}));
    TRY(bench.load(program_of(Instructions().stop())));
    return bench.expect_values(at, {4321});
}

}  // namespace

void add_message_checks(Checks& checks) {
    const char* const messages = "messages";
    const char* const variables = "variables";
    const char* const programs = "programs";
    checks.insert(
        checks.end(),
        {{messages, "commands to another id are ignored", "2.1", "", leaves_commands_to_others},
         {messages, "commands without a destination are ignored", "3.9", "", leaves_empty_commands},
         {messages, "messages of unknown types are ignored", "3.9", "", leaves_unknown_types},
         {messages, "messages that nodes send are ignored", "2.4", "", leaves_messages_of_nodes},
         {messages, "commands to a boot loader are ignored", "2.4, 3.9", "",
          leaves_commands_to_boot_loaders},
         {variables, "SetVariables and GetVariables agree", "2.3", "", keeps_variables},
         {variables, "SetVariables has no answer", "2.3", "", writes_without_an_answer},
         {variables, "SetVariables leaves its neighbours", "2.3", "", writes_no_more_than_was_sent},
         {variables, "the last variable can be reached", "2.3", "", reaches_the_last_variable},
         {variables, "256 variables are written at once, or all there are", "2.3", "",
          takes_many_variables_at_once},
         {variables, "257 variables are read at once, or all there are", "2.3", "",
          sends_many_variables_at_once},
         {programs, "without a program an event starts nothing", "3.3", "",
          has_no_program_after_an_empty_one},
         {programs, "a later SetBytecode changes words of the program", "2.7", "",
          takes_a_program_in_pieces},
         {programs, "a program of more than 256 words arrives whole", "2.7", "",
          takes_a_program_of_several_messages},
         {programs, "the last word of the bytecode can be used", "2.3", "",
          fills_its_bytecode_memory},
         {programs, "SetBytecode keeps the variables", "2.3", "", keeps_variables_over_an_upload}});
}

}  // namespace vagus::conformance
