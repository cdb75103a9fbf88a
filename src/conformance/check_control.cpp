// Reset, Run, Pause, Step, Stop and the state that they lead to: sections 2.3, 2.8 and 3.2.
#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using isa::BinaryOperator;
using wire::MessageType;

// An event that never ends, on one spot.
Words endless() {
    return program_of(Instructions().jump(0));
}

Status then(Bench& bench, MessageType command, State expected) {
    TRY(bench.command(command));
    return bench.expect_state(expected);
}

// ---- Reset ----

Status reset_starts_init(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    TRY(bench.run_to_end(program_of(adding_one(at))));
    TRY(then(bench, MessageType::Reset, {kInitStart, 3}));
    TRY(bench.expect_values(at, {1}));  // kept, and nothing executed yet
    TRY(then(bench, MessageType::Run, {kInitStart, 1}));
    (void)TRY(bench.wait_for_end());
    return bench.expect_values(at, {2});
}

Status reset_without_init(Bench& bench) {
    TRY(bench.load(program_of({{kPing, Instructions().stop().all()}})));
    TRY(bench.command(MessageType::Run));
    (void)TRY(bench.hear("ExecutionStateChanged"));
    TRY(bench.command(MessageType::Reset));
    const wire::Frame frame = TRY(bench.hear("ExecutionStateChanged"));
    wire::ExecutionStateChanged state;
    if (wire::decode_message(frame, state) != wire::Error::None || state.flags != 2)
        return finding("expected ExecutionStateChanged with flags 2, found " + text_of(frame));
    return bench.expect_silence();
}

Status reset_ends_what_runs(Bench& bench) {
    TRY(bench.start(endless()));
    TRY(then(bench, MessageType::Reset, {kInitStart, 3}));
    return bench.expect_silence();
}

// `at + 1` counts how often the body of the `when` is entered.
Words with_a_when(uint16_t at) {
    Instructions code;
    code.load(at).push(1).when(BinaryOperator::Equal, 7);
    code.load(at + 1).push(1).binary(BinaryOperator::Add).store(at + 1).stop();
    return program_of(code);
}

Status reset_clears_when(Bench& bench) {
    const uint16_t at = TRY(bench.room(2));
    TRY(bench.set(at, {1, 0}));
    TRY(bench.run_to_end(with_a_when(at)));
    TRY(then(bench, MessageType::Reset, {kInitStart, 3}));
    TRY(then(bench, MessageType::Run, {kInitStart, 1}));
    (void)TRY(bench.wait_for_end());
    return bench.expect_values(at, {1, 2});
}

// Words that look like a Branch that was true, but are the second words of other instructions.
Status reset_leaves_operands(Bench& bench) {
    const uint16_t at = TRY(bench.room(3));
    const int looks = 0xa302;
    Instructions code;
    code.push(looks).store(at).push(looks).store(at + 1).jump(1).push(looks).store(at + 2).stop();
    TRY(bench.load(program_of(code)));
    TRY(then(bench, MessageType::Reset, {kInitStart, 3}));
    TRY(then(bench, MessageType::Run, {kInitStart, 1}));
    (void)TRY(bench.wait_for_end());
    const int16_t value = static_cast<int16_t>(looks);
    return bench.expect_values(at, {value, value, value});
}

// ---- Run, Pause, Stop ----

Status init_waits_for_run(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    TRY(bench.load(program_of(adding_one(at))));
    TRY(bench.expect_silence());
    return bench.expect_values(at, {0});
}

Status pause_while_idle(Bench& bench) {
    TRY(bench.run_to_end(program_of(Instructions().stop())));
    TRY(then(bench, MessageType::Pause, {kInitStart, 2}));
    return then(bench, MessageType::Run, {kInitStart, 0});
}

Status pause_in_an_event(Bench& bench) {
    TRY(bench.start(endless()));
    TRY(then(bench, MessageType::Pause, {kInitStart, 3}));
    TRY(bench.ask_state({kInitStart, 3}));
    TRY(then(bench, MessageType::Run, {kInitStart, 1}));
    return bench.ask_state({kInitStart, 1});
}

Status stop_abandons_the_event(Bench& bench) {
    TRY(bench.start(endless()));
    TRY(then(bench, MessageType::Stop, {kInitStart, 2}));
    TRY(then(bench, MessageType::Run, {kInitStart, 0}));
    return bench.ask_state({kInitStart, 0});
}

Status state_can_be_asked(Bench& bench) {
    TRY(bench.load(program_of(Instructions().stop())));
    TRY(bench.ask_state({kInitStart, 3}));
    TRY(bench.ask_state({kInitStart, 3}));
    return bench.expect_silence();
}

// ---- Step ----

Status step_by_step(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    const Instructions code =
        Instructions().push(5).small(6).binary(BinaryOperator::Add).store(at).stop();
    TRY(bench.set(at, {0}));
    TRY(bench.load(program_of(code)));
    for (const uint16_t pc : Words{5, 6, 7}) TRY(then(bench, MessageType::Step, {pc, 3}));
    TRY(bench.expect_values(at, {0}));
    TRY(then(bench, MessageType::Step, {8, 3}));
    TRY(bench.expect_values(at, {11}));
    TRY(then(bench, MessageType::Step, {8, 2}));  // Stop leaves the pc
    return bench.expect_silence();
}

Status step_while_idle(Bench& bench) {
    TRY(bench.run_to_end(program_of(Instructions().stop())));
    TRY(bench.command(MessageType::Step));
    return bench.expect_silence();
}

Status step_while_running(Bench& bench) {
    TRY(bench.start(endless()));
    TRY(then(bench, MessageType::Step, {kInitStart, 1}));
    return bench.ask_state({kInitStart, 1});
}

Status step_over_an_emit(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {42}));
    TRY(bench.load(program_of(Instructions().emit(kPong, at, 1).stop())));
    TRY(then(bench, MessageType::Step, {kInitStart + 3, 3}));
    return bench.expect_event(kPong, {42});
}

Status step_into_a_subroutine(Bench& bench) {
    Instructions code;
    code.call(kInitStart + 2).stop().back();
    TRY(bench.load(program_of(code)));
    TRY(then(bench, MessageType::Step, {kInitStart + 2, 3}));
    TRY(then(bench, MessageType::Step, {kInitStart + 1, 3}));
    return then(bench, MessageType::Step, {kInitStart + 1, 2});
}

Status step_into_a_fault(Bench& bench) {
    const Instructions code = Instructions().push(1).push(0).binary(BinaryOperator::Divide).stop();
    TRY(bench.load(program_of(code)));
    TRY(then(bench, MessageType::Step, {5, 3}));
    TRY(then(bench, MessageType::Step, {7, 3}));
    TRY(bench.command(MessageType::Step));
    TRY(bench.expect(MessageType::DivisionByZero, {7}));
    return bench.expect_state({8, 2});
}

}  // namespace

void add_control_checks(Checks& checks) {
    const char* const group = "control";
    checks.insert(
        checks.end(),
        {{group, "a loaded program waits for Run", "2.7", "", init_waits_for_run},
         {group, "GetExecutionState changes nothing", "2.3", "", state_can_be_asked},
         {group, "Reset starts init, paused, and keeps variables", "2.3", "", reset_starts_init},
         {group, "Reset without init stops", "2.3", "", reset_without_init},
         {group, "Reset ends a running event without a word of it", "2.3", "",
          reset_ends_what_runs},
         {group, "Reset clears what every `when` saw", "3.5", "D2", reset_clears_when},
         {group, "Reset leaves operands as they are", "8 D2", "D2", reset_leaves_operands},
         {group, "Pause while no event runs", "3.2", "", pause_while_idle},
         {group, "Pause in an event, and Run goes on", "3.2", "", pause_in_an_event},
         {group, "Stop abandons the event", "2.3", "", stop_abandons_the_event},
         {group, "Step executes one instruction", "2.3", "", step_by_step},
         {group, "Step does nothing while no event runs", "2.3", "", step_while_idle},
         {group, "Step works in running mode, too", "2.3", "", step_while_running},
         {group, "Step over an Emit", "3.7", "", step_over_an_emit},
         {group, "Step into a subroutine and back", "3.7", "", step_into_a_subroutine},
         {group, "Step into a fault tells both", "3.8", "", step_into_a_fault}});
}

}  // namespace vagus::conformance
