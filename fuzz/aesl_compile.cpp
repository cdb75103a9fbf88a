// Any bytes as a program, for a roomy node and a tiny one, in every dialect: no crash, no hang;
// errors lie inside the text; what compiles fits the node and can be listed.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "aesl/compile.hpp"
#include "aesl/limits.hpp"
#include "aesl/listing.hpp"

namespace {

using namespace vagus::aesl;

Target node(uint16_t words) {
    Target target;
    target.name = "fuzzed";
    target.bytecode_size = words;
    target.variables_size = words;
    target.stack_size = 32;
    target.variables = {{"id", 1}, {"source", 1}, {"args", 8}, {"prox", 4}};
    target.local_events = {{"timer", ""}, {"button", ""}};
    target.natives = {{"math.copy", "", {{"dest", -1}, {"src", -1}}},
                      {"sys.nop", "", {}},
                      {"sys.sum", "", {{"dest", 1}, {"src", 0}}},
                      {"math.rot2", "", {{"dest", 2}, {"v", 2}, {"a", 1}}}};
    return target;
}

const CommonDefinitions kCommon{
    .events = {{"ping", 0}, {"report", 1}, {"triple", 3}, {"old", std::nullopt}},
    .constants = {{"LIMIT", 10}, {"ZERO", 0}, {"HUGE", 40000}}};

void require(bool holds) {
    if (!holds) std::abort();
}

void check(std::string_view source, const Target& target, Dialect dialect) {
    const Compilation done = compile(source, target, kCommon, {.dialect = dialect, .ontimer = ""});
    require(done.errors.size() <= kErrorsMax && done.warnings.size() <= kWarningsMax);
    for (const Diagnostic& d : done.errors) {
        require(d.at.line >= 0 && d.at.column >= 0 && d.end.line == d.at.line);
        require(d.end.column >= d.at.column && !d.message.empty());
    }
    if (!done.ok()) {
        require(done.program.bytecode.empty() && done.warnings.empty());
        return;
    }
    const Program& program = done.program;
    require(program.bytecode.size() <= target.bytecode_size);
    require(program.bytecode.size() == program.lines.size());
    require(program.used.variables <= target.variables_size);
    require(program.used.stack <= target.stack_size);
    require(!listing(program, source, target, kCommon).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string_view source(reinterpret_cast<const char*>(bytes), size);
    check(source, node(4000), Dialect::Auto);
    check(source, node(4000), Dialect::Year2007);
    check(source, node(40), Dialect::Modern);
    return 0;
}
