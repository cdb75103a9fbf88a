// Natives that cannot do what they are asked: sections 3.8 and 4.5.
#include "conformance/checks.hpp"
#include "conformance/native_call.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

// A call that ends in a fault, and what it leaves in its arguments.
struct Call {
    const char* native;
    std::vector<Values> before;
    std::vector<Values> after;
};

struct Fallen {
    Ending ending;
    uint16_t pc = 0;  // of the call
};

// Runs it. The node must be stopped behind the call, its arguments as they should be.
Result<Fallen> fall(Bench& bench, const Call& call) {
    const Values before = flat(call.before);
    const uint16_t at = TRY(bench.room(static_cast<uint16_t>(before.size())));
    const Instructions code = TRY(native_call(bench, call.native, call.before, at));
    TRY(bench.set(at, before));
    const Ending ending =
        TRY(bench.run(program_of(Instructions().words(code.all()).push(1).store(at).stop())));
    const uint16_t pc = static_cast<uint16_t>(kInitStart + code.size() - 1);
    if (ending.messages.empty())
        return finding("expected a fault, found the node " + text_of_flags(ending.state.flags));
    TRY(bench.is_state(ending.state, {static_cast<uint16_t>(pc + 1), kStopped}));
    TRY(bench.expect_values(at, flat(call.after)));
    return Fallen{ending, pc};
}

Status division_by_zero(Bench& bench) {
    const Fallen fallen = TRY(fall(
        bench, {"math.div", {{9, 9, 9}, {8, 8, 8}, {2, 0, 4}}, {{4, 9, 9}, {8, 8, 8}, {2, 0, 4}}}));
    return bench.is_message(fallen.ending.messages[0], MessageType::DivisionByZero, {fallen.pc});
}

Status muldiv(Bench& bench) {
    const Fallen fallen =
        TRY(fall(bench, {"math.muldiv", {{9}, {8}, {8}, {0}}, {{9}, {8}, {8}, {0}}}));
    return bench.is_message(fallen.ending.messages[0], MessageType::DivisionByZero, {fallen.pc});
}

Status root(Bench& bench) {
    const Fallen fallen =
        TRY(fall(bench, {"math.sqrt", {{9, 9, 9}, {16, -4, 25}}, {{4, 9, 9}, {16, -4, 25}}}));
    const std::string expected =
        "NodeSpecificError " + std::to_string(fallen.pc) + " \"Negative input to sqrt\"";
    const std::string found = text_of(fallen.ending.messages[0]);
    if (found == expected) return Status::done();
    return finding("expected " + expected + ", found " + found);
}

const Values kThree{3, 6, 3, 0, 0, 0, 0, 0, 1, 2};  // 1, 2, 3 in 8 cells

// Section 8, D3: pc, cells, index.
Status get_outside(Bench& bench) {
    const Fallen fallen =
        TRY(fall(bench, {"deque.get", {kThree, {9, 9}, {2}}, {kThree, {9, 9}, {2}}}));
    return bench.is_message(fallen.ending.messages[0], MessageType::ArrayAccessOutOfBounds,
                            {fallen.pc, 8, 2});
}

Status is_one_out_of_bounds(const Fallen& fallen) {
    for (const wire::Frame& frame : fallen.ending.messages) {
        const bool right = frame.type == uint16_t(MessageType::ArrayAccessOutOfBounds) &&
                           frame.first_word() == fallen.pc;
        if (!right)
            return finding("expected ArrayAccessOutOfBounds " + std::to_string(fallen.pc) +
                           ", found " + text_of(frame));
    }
    const size_t count = fallen.ending.messages.size();
    if (count == 1) return Status::done();
    return finding("expected one message, found " + std::to_string(count));
}

Status pop_too_many(Bench& bench) {
    const Values nine(4, 9);
    return is_one_out_of_bounds(
        TRY(fall(bench, {"deque.pop_front", {kThree, nine}, {kThree, nine}})));
}

Status pop_too_many_behind(Bench& bench) {
    const Values nine(4, 9);
    return is_one_out_of_bounds(
        TRY(fall(bench, {"deque.pop_back", {kThree, nine}, {kThree, nine}})));
}

Status push_too_many(Bench& bench) {
    const Values six(6, 9);
    return is_one_out_of_bounds(
        TRY(fall(bench, {"deque.push_back", {kThree, six}, {kThree, six}})));
}

Status insert_outside(Bench& bench) {
    return is_one_out_of_bounds(
        TRY(fall(bench, {"deque.insert", {kThree, {9}, {8}}, {kThree, {9}, {8}}})));
}

Status erase_too_many(Bench& bench) {
    return is_one_out_of_bounds(
        TRY(fall(bench, {"deque.erase", {kThree, {1}, {3}}, {kThree, {1}, {3}}})));
}

Status set_before_the_first(Bench& bench) {
    return is_one_out_of_bounds(
        TRY(fall(bench, {"deque.set", {kThree, {9}, {-1}}, {kThree, {9}, {-1}}})));
}

}  // namespace

void add_native_fault_checks(Checks& checks) {
    const char* const group = "natives";
    checks.insert(
        checks.end(),
        {{group, "math.div by zero", "4.2", "", division_by_zero},
         {group, "math.muldiv by zero", "4.2", "", muldiv},
         {group, "math.sqrt of a negative number", "2.10-7, 4.2", "", root},
         {group, "deque.get outside tells pc, cells and index", "8 D3", "D3", get_outside},
         {group, "deque.set outside", "4.5", "", set_before_the_first},
         {group, "deque.insert outside", "4.5", "", insert_outside},
         {group, "deque.erase of too many", "4.5", "", erase_too_many},
         {group, "deque.push_back into a full one", "4.5", "", push_too_many},
         {group, "deque.pop_front of too many is told once", "8 D4", "D4", pop_too_many},
         {group, "deque.pop_back of too many is told once", "8 D4", "D4", pop_too_many_behind}});
}

}  // namespace vagus::conformance
