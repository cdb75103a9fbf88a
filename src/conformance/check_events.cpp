// User events and local events: sections 2.5, 2.8, 3.6 and 3.10.
#include <algorithm>

#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using isa::BinaryOperator;
using wire::MessageType;

constexpr uint16_t kSourceAt = 1;  // section 3.10
constexpr uint16_t kArgumentsAt = 2;
constexpr uint16_t kHighestEvent = 0x7fff;
constexpr Duration kTimerWithin = std::chrono::seconds(5);
constexpr int16_t kTimerPeriod_ms = 20;

// Words that the node keeps of an event's arguments.
Result<uint16_t> capacity(const Bench& bench, uint16_t wanted) {
    const auto& variables = bench.target().variables;
    const uint16_t size = variables.size() < 3 ? uint16_t{0} : variables[2].size;
    if (size >= wanted) return size;
    return lacking("room for " + std::to_string(wanted) + " arguments",
                   "keeps " + std::to_string(size));
}

// Waits for events, paused: what an event stores is then not changed by the node itself.
Status start_paused(Bench& bench, const Words& program) {
    TRY(bench.load(program));
    return bench.expect_silence();
}

Status ping(Bench& bench, const Values& arguments) {
    TRY(bench.event(kPing, arguments));
    return bench.expect_state({kInitStart, 3});
}

Words ping_handler(const Instructions& code) {
    return program_of({{kPing, code.all()}});
}

// ---- what an event does ----

Status starts_its_handler(Bench& bench) {
    (void)TRY(capacity(bench, 2));
    const uint16_t at = TRY(bench.room(1));
    Instructions code;
    code.load(kArgumentsAt).load(kArgumentsAt + 1).binary(BinaryOperator::Subtract).store(at);
    TRY(bench.set(at, {0}));
    TRY(bench.start(ping_handler(code.stop())));
    TRY(bench.event(kPing, {7, -8}));
    (void)TRY(bench.wait_for_end());
    return bench.expect_values(at, {15});
}

Status is_set_up_while_stepping(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {5}));
    TRY(start_paused(bench, ping_handler(adding_one(at))));
    TRY(ping(bench, {}));
    TRY(bench.expect_values(at, {5}));
    TRY(bench.command(MessageType::Run));
    TRY(bench.expect_state({kInitStart, 1}));
    (void)TRY(bench.wait_for_end());
    return bench.expect_values(at, {6});
}

Status stores_source_and_arguments(Bench& bench) {
    (void)TRY(capacity(bench, 2));
    TRY(start_paused(bench, ping_handler(Instructions().stop())));
    TRY(bench.event(kPing, {7, -8}, bench.nobody()));
    TRY(bench.expect_state({kInitStart, 3}));
    return bench.expect_values(kSourceAt, {static_cast<int16_t>(bench.nobody()), 7, -8});
}

Status keeps_arguments_that_did_not_come(Bench& bench) {
    (void)TRY(capacity(bench, 3));
    TRY(start_paused(bench, ping_handler(Instructions().stop())));
    TRY(bench.set(kArgumentsAt, {1, 2, 3}));
    TRY(ping(bench, {10}));
    return bench.expect_values(kArgumentsAt, {10, 2, 3});
}

// The longest event there is; the variable behind the arguments keeps its value.
Status cuts_arguments_that_do_not_fit(Bench& bench) {
    const uint16_t kept = TRY(capacity(bench, 1));
    const uint16_t behind = static_cast<uint16_t>(kArgumentsAt + kept);
    TRY(start_paused(bench, ping_handler(Instructions().stop())));
    const bool has_more = behind < bench.target().variables_size;
    const Values before = has_more ? TRY(bench.get(behind, 1)) : Values{};
    Values arguments;
    for (uint16_t i = 0; i < wire::kArgumentsMax; i++)
        arguments.push_back(static_cast<int16_t>(1000 + i));
    TRY(ping(bench, arguments));
    const size_t stored = std::min<size_t>(kept, arguments.size());
    TRY(bench.expect_values(kArgumentsAt,
                            Values(arguments.begin(), arguments.begin() + ptrdiff_t(stored))));
    // A node may write itself what lies behind, such as `_program`: what belongs to nobody is zero.
    const uint16_t free = TRY(bench.room(0));
    const bool reached = bench.room_size() > 0 && free < kArgumentsAt + wire::kArgumentsMax;
    if (reached) TRY(bench.expect_values(free, {0}));
    return has_more && stored == kept ? bench.expect_values(behind, before) : Status::done();
}

// On a line that may lose bytes such an event may be taken for noise; else its word is stored, and
// nothing of the byte behind it.
Status leaves_out_an_odd_byte(Bench& bench) {
    (void)TRY(capacity(bench, 2));
    TRY(bench.set(kArgumentsAt, {1, 2}));
    wire::Frame frame{};
    frame.type = kPing;
    frame.size = 3;
    frame.payload[0] = 10;
    frame.payload[2] = 0x77;
    TRY(bench.send(frame));
    TRY(bench.expect_silence_again());
    const Values found = TRY(bench.get(kArgumentsAt, 2));
    if (found == Values{10, 2} || found == Values{1, 2}) return Status::done();
    return finding("expected 10, 2 (or 1, 2), found " + text_of(found));
}

Status is_dropped_while_paused_in_an_event(Bench& bench) {
    (void)TRY(capacity(bench, 1));
    TRY(start_paused(bench, ping_handler(Instructions().stop())));
    TRY(ping(bench, {1}));
    TRY(bench.event(kPing, {2}));
    TRY(bench.expect_silence());
    return bench.expect_values(kArgumentsAt, {1});
}

Status kills_the_running_one(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    const Instructions forever = Instructions().jump(0);
    const Words program =
        program_of({{isa::kInitEvent, forever.all()}, {kPing, adding_one(at).all()}});
    TRY(bench.start(program));
    TRY(bench.event(kPing, {}));
    TRY(bench.expect(MessageType::EventExecutionKilled, {5}));
    const Ending ending = TRY(bench.wait_for_end());
    if (!ending.messages.empty())
        return finding("expected the handler to end in silence, found " +
                       text_of(ending.messages.front()));
    return bench.expect_values(at, {1});
}

Status leaves_the_running_one(Bench& bench) {
    TRY(bench.start(program_of(Instructions().jump(0))));
    TRY(bench.event(kPing, {1}));
    TRY(bench.expect_silence());
    return bench.ask_state({kInitStart, 1});
}

// ---- which handler ----

Status first_of_two_handlers(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    const Instructions first = Instructions().small(1).store(at).stop();
    const Instructions second = Instructions().small(2).store(at).stop();
    TRY(bench.start(program_of({{kPing, first.all()}, {kPing, second.all()}})));
    TRY(bench.event(kPing, {}));
    (void)TRY(bench.wait_for_end());
    return bench.expect_values(at, {1});
}

Status no_handler_at_address_zero(Bench& bench) {
    TRY(bench.load({3, kPing, 0, 0}));
    TRY(bench.event(kPing, {}));
    return bench.expect_silence();
}

Status the_highest_number(Bench& bench) {
    const Instructions stop = Instructions().stop();
    TRY(start_paused(bench, program_of({{kHighestEvent, stop.all()}})));
    TRY(bench.event(kHighestEvent, {}));
    return bench.expect_state({kInitStart, 3});
}

// Types from 0x8000 on are messages: the numbers of local events mean nothing on the bus.
Status local_events_do_not_come_from_the_bus(Bench& bench) {
    const Instructions stop = Instructions().stop();
    const uint16_t unused = static_cast<uint16_t>(0xfffe - bench.target().local_events.size());
    TRY(start_paused(bench, program_of({{unused, stop.all()}})));
    TRY(bench.send(unused, {bench.id(), 0}));
    return bench.expect_silence_again();
}

Status not_its_own(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    const Instructions init = Instructions().emit(kPing, at, 1).stop();
    TRY(bench.start(program_of({{isa::kInitEvent, init.all()}, {kPing, adding_one(at).all()}})));
    (void)TRY(bench.wait_for_end());
    TRY(bench.expect_event(kPing, {0}));
    TRY(bench.expect_silence());
    return bench.expect_values(at, {0});
}

// ---- how long ----

// Each event leaves a word on the stack, more often than the stack is deep.
Status each_has_an_empty_stack(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    Instructions code;
    code.load(at).push(1).binary(BinaryOperator::Add).store(at).push(9).stop();
    TRY(bench.start(ping_handler(code)));
    const int16_t times = static_cast<int16_t>(bench.target().stack_size + 2);
    for (int16_t i = 0; i < times; i++) {
        TRY(bench.event(kPing, {}));
        const Ending ending = TRY(bench.wait_for_end());
        if (!ending.messages.empty())
            return finding("event " + std::to_string(i + 1) + ": " +
                           text_of(ending.messages.front()));
    }
    return bench.expect_values(at, {times});
}

// 3,000 rounds of 9 instructions: no node does them at once.
Status a_long_one_goes_on(Bench& bench) {
    constexpr uint16_t kFork = 6;
    if (bench.target().protocol_version >= kFork)
        return lacking("protocol version 5", "ends events of more than 1,000 instructions");
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    Instructions code;
    code.load(at).push(3000).branch(BinaryOperator::Smaller, 8);
    code.load(at).push(1).binary(BinaryOperator::Add).store(at);
    code.jump(-10).stop();
    TRY(bench.run_to_end(program_of(code)));
    return bench.expect_values(at, {3000});
}

// ---- the timer ----

struct Timer {
    uint16_t event = 0;
    uint16_t period_at = 0;
};

// Both the event and its period must be described: on Thymios `timer0`, elsewhere `timer`.
Result<Timer> timer_of(const Bench& bench) {
    const auto& events = bench.target().local_events;
    const auto named = [](const aesl::LocalEvent& event) {
        return event.name == "timer" || event.name == "timer0";
    };
    const auto event = std::ranges::find_if(events, named);
    if (event == events.end()) return lacking("a timer", "describes none");
    const uint16_t period_at = TRY(bench.address_of("timer.period"));
    return Timer{static_cast<uint16_t>(0xfffe - (event - events.begin())), period_at};
}

Status wait_until_counted(Bench& bench, uint16_t at, int16_t count) {
    const Time deadline = bench.now() + kTimerWithin;
    Values found;
    while (bench.now() < deadline) {
        found = TRY(bench.get(at, 1));
        if (found[0] >= count) return Status::done();
        (void)TRY(bench.listen(bench.now() + std::chrono::milliseconds(kTimerPeriod_ms)));
    }
    return finding("expected " + std::to_string(count) + " events of the timer within 5 s, found " +
                   text_of(found));
}

Status timer(Bench& bench) {
    const Timer timer = TRY(timer_of(bench));
    const uint16_t at = TRY(bench.room(1));
    TRY(bench.set(at, {0}));
    const Values before = TRY(bench.get(timer.period_at, 1));
    TRY(bench.start(program_of({{timer.event, adding_one(at).all()}})));
    TRY(bench.set(timer.period_at, {kTimerPeriod_ms}));
    const Status counted = wait_until_counted(bench, at, 3);
    TRY(bench.set(timer.period_at, before));
    return counted;
}

}  // namespace

void add_event_checks(Checks& checks) {
    const char* const group = "events";
    checks.insert(
        checks.end(),
        {{group, "an event starts its handler", "3.6", "", starts_its_handler},
         {group, "an event is set up while stepping", "2.8", "", is_set_up_while_stepping},
         {group, "source and arguments are stored", "3.6", "", stores_source_and_arguments},
         {group, "arguments that did not come keep their values", "3.6", "",
          keeps_arguments_that_did_not_come},
         {group, "arguments that do not fit are cut", "3.6", "", cuts_arguments_that_do_not_fit},
         {group, "an odd last byte does not count", "3.6", "", leaves_out_an_odd_byte},
         {group, "an event is dropped while another is paused", "2.8", "",
          is_dropped_while_paused_in_an_event},
         {group, "an event ends the one that runs, and says so", "3.6", "", kills_the_running_one},
         {group, "an event without handler ends nothing", "3.6", "", leaves_the_running_one},
         {group, "the first of two handlers counts", "3.3", "", first_of_two_handlers},
         {group, "address 0 is no handler", "3.3", "", no_handler_at_address_zero},
         {group, "event 32767 is an event", "2.1", "", the_highest_number},
         {group, "local events do not come from the bus", "3.6", "",
          local_events_do_not_come_from_the_bus},
         {group, "a node does not hear its own event", "2.5", "", not_its_own},
         {group, "every event begins with an empty stack", "3.6", "", each_has_an_empty_stack},
         {group, "an event of 27,000 instructions goes on to its end", "3.6", "",
          a_long_one_goes_on},
         {group, "the timer sends its event", "5.1", "", timer}});
}

}  // namespace vagus::conformance
