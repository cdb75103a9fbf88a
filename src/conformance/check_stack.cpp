// The stack holds as many words as the node describes, not one less and not one more, whatever
// instruction pushes the last one (sections 3.3, 3.4 and 3.8).
#include "conformance/checks.hpp"

namespace vagus::conformance {
namespace {

using isa::BinaryOperator;

// An instruction that pushes one word, made for the address at which it will lie.
using Push = std::function<Instructions(Bench&, uint16_t address)>;

Status goes_to_the_end(Bench& bench, const Instructions& code, const std::string& what) {
    const Ending ending = TRY(bench.run(program_of(code)));
    if (ending.messages.empty() && ending.state.flags == 0) return Status::done();
    const std::string said = ending.messages.empty() ? text_of_flags(ending.state.flags)
                                                     : text_of(ending.messages.front());
    return finding("expected a stack of " + std::to_string(bench.target().stack_size) +
                   " words to take " + what + ", found " + said);
}

Status is_refused(Bench& bench, const Instructions& code, const std::string& what) {
    const Ending ending = TRY(bench.run(program_of(code)));
    const bool refused =
        !ending.messages.empty() &&
        ending.messages.front().type == number(wire::MessageType::NodeSpecificError);
    if (refused && ending.state.flags == kStopped) return bench.expect_silence();
    const std::string said = ending.messages.empty() ? text_of_flags(ending.state.flags)
                                                     : text_of(ending.messages.front());
    return finding("expected a stack of " + std::to_string(bench.target().stack_size) +
                   " words to refuse " + what + " by NodeSpecificError, found " + said);
}

Status takes_as_many_as_described(Bench& bench, const std::string& name, const Push& push) {
    const uint16_t size = bench.target().stack_size;
    if (size == 0) return lacking("a stack", "has none");
    Instructions full;
    for (uint16_t i = 1; i < size; i++) full.small(1);
    const auto address = static_cast<uint16_t>(kInitStart + full.size());
    const Words last = push(bench, address).all();
    Instructions fits = Instructions(full).words(last).stop();
    TRY(goes_to_the_end(bench, fits, name + " as its last word"));
    const Words one_more = push(bench, static_cast<uint16_t>(address + 1)).all();
    return is_refused(bench, Instructions(full).small(1).words(one_more).stop(),
                      name + " as one word more");
}

Status of_constants(Bench& bench) {
    TRY(takes_as_many_as_described(bench, "SmallImm",
                                   [](Bench&, uint16_t) { return Instructions().small(2); }));
    return takes_as_many_as_described(bench, "LargeImm",
                                      [](Bench&, uint16_t) { return Instructions().push(2); });
}

Status of_variables(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    return takes_as_many_as_described(bench, "Load",
                                      [at](Bench&, uint16_t) { return Instructions().load(at); });
}

// The call goes to the word behind it.
Status of_calls(Bench& bench) {
    return takes_as_many_as_described(bench, "SubCall", [](Bench&, uint16_t address) {
        return Instructions().call(address + 1);
    });
}

// 1, 2, 3 … are all there still: added up from the top, the sum is right.
Status keeps_all_words(Bench& bench) {
    const uint16_t at = TRY(bench.room(1));
    const uint16_t size = bench.target().stack_size;
    if (size == 0) return lacking("a stack", "has none");
    Instructions code;
    uint32_t sum = 0;
    for (uint16_t i = 1; i <= size; i++) {
        code.small(i % 2000);
        sum += i % 2000;
    }
    for (uint16_t i = 1; i < size; i++) code.binary(BinaryOperator::Add);
    TRY(bench.set(at, {0}));
    TRY(bench.run_to_end(program_of(code.store(at).stop())));
    return bench.expect_values(at, {static_cast<int16_t>(sum)});
}

}  // namespace

void add_stack_checks(Checks& checks) {
    const char* const group = "limits";
    checks.insert(
        checks.end(),
        {{group, "a stack is as large as described, for constants", "3.3, 3.8", "D9", of_constants},
         {group, "a stack is as large as described, for Load", "3.3, 3.8", "D9", of_variables},
         {group, "a stack is as large as described, for calls", "3.3, 3.8", "D9", of_calls},
         {group, "a full stack keeps all its words", "3.3", "", keeps_all_words}});
}

}  // namespace vagus::conformance
