// Which program is it? A node that describes `_program` tells (section 3.11).
#include "conformance/checks.hpp"
#include "debug/program_mark.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

constexpr uint32_t kNobodyKnows = 0xffffffff;
constexpr uint16_t kNop = 0x9001;  // a jump to the next word

Status expect_mark(Bench& bench, const std::string& when, uint32_t expected) {
    const auto at = debug::mark_address(bench.target());
    if (!at) return lacking("`_program`, two words at the end", "describes none");
    const Values found = TRY(bench.get(*at, 2));
    const Values wanted = {static_cast<int16_t>(expected & 0xffff),
                           static_cast<int16_t>(expected >> 16)};
    if (found == wanted) return Status::done();
    return finding(when + ": expected _program " + text_of(wanted) + ", found " + text_of(found));
}

// A handler that is longer than a piece, and a `when` that remembers in its own word.
Words long_program(uint16_t at) {
    Instructions code;
    code.small(1).small(1).when(isa::BinaryOperator::Equal, 4).small(1).store(at);
    for (size_t i = 0; i < wire::kBytecodeWordsMax; i++) code.word(kNop);
    return program_of(code.stop());
}

Status tells_the_checksum(Bench& bench) {
    TRY(expect_mark(bench, "without a program", 0));
    const uint16_t at = TRY(bench.room(1));
    const Words short_one = program_of(Instructions().small(7).store(at).stop());
    TRY(bench.load(short_one));
    TRY(expect_mark(bench, "with a program of " + std::to_string(short_one.size()) + " words",
                    debug::mark_of(short_one)));
    const Words long_one = long_program(at);
    TRY(bench.run_to_end(long_one));
    TRY(bench.expect_values(at, {1}));
    TRY(expect_mark(bench, "after a run of " + std::to_string(long_one.size()) + " words",
                    debug::mark_of(long_one)));
    TRY(bench.load(short_one));
    return expect_mark(bench, "with the first program again", debug::mark_of(short_one));
}

Status says_when_nobody_knows(Bench& bench) {
    TRY(bench.load(program_of(Instructions().small(7).stop())));
    TRY(bench.command(MessageType::SetBytecode, {9, 0}));
    TRY(bench.expect_state({kInitStart, 3}));
    TRY(expect_mark(bench, "with a word that leaves a gap", kNobodyKnows));
    TRY(bench.clear());
    return expect_mark(bench, "without a program", 0);
}

}  // namespace

void add_program_checks(Checks& checks) {
    const char* const group = "program";
    checks.insert(
        checks.end(),
        {{group, "_program is the checksum of what was loaded", "3.11", "", tells_the_checksum},
         {group, "_program says when nobody knows", "3.11", "", says_when_nobody_knows}});
}

}  // namespace vagus::conformance
