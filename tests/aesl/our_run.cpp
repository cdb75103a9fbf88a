#include "our_run.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/file.hpp"
#include "base/test_places.hpp"
#include "session/execute.hpp"

namespace vagus::aesl {
namespace {

constexpr uint32_t kStepsPerEvent = 2'000'000;
constexpr uint64_t kLongFactor = 20;
const std::string kGoldenFolder = test::testdata("golden/aesl/");

FaultCause converted(session::StopKind kind) {
    if (kind == session::StopKind::DivisionByZero) return FaultCause::DivisionByZero;
    if (kind == session::StopKind::ArrayOutOfBounds) return FaultCause::ArrayOutOfBounds;
    return FaultCause::NodeSpecific;
}

Outcome converted(const session::Execution& execution, const Target& target) {
    Outcome outcome;
    for (const NamedVariable& variable : target.variables)
        outcome.memory[variable.name] = Words(variable.size);
    for (const session::VariableWords& variable : execution.memory)
        outcome.memory[variable.name] = variable.words;
    for (const session::Emission& emission : execution.emitted)
        outcome.emitted.push_back(
            {static_cast<size_t>(emission.during), emission.event, emission.arguments});
    if (!execution.error) return outcome;
    outcome.out_of_steps = execution.error->kind == session::StopKind::StepLimit;
    outcome.fault = Fault{converted(execution.error->kind),
                          static_cast<size_t>(execution.error->during), execution.error->line};
    return outcome;
}

}  // namespace

OurRun run_ours(const Case& program, const NodeFile& node, Dialect dialect) {
    OurRun run;
    const Compilation compiled =
        compile(program.source, node.target, node.common, {.dialect = dialect});
    if (!compiled.ok()) {
        const Diagnostic& first = compiled.first_error();
        run.outcome.error = CompileError{without_guess(first.code), first.formal_place().line};
        run.message = first.message;
        return run;
    }
    run.bytecode_words = compiled.program.bytecode.size();
    const auto execution =
        session::execute(compiled.program, node, program.stimuli, kStepsPerEvent);
    if (execution.ok()) {
        run.outcome = converted(execution.value(), node.target);
    } else {
        run.outcome.error = CompileError{execution.error().what, 0};
    }
    return run;
}

bool is_want_of_room(const Outcome& outcome) {
    if (!outcome.error) return false;
    const std::string& code = outcome.error->code;
    return code == "SCRIPT_TOO_BIG" || code == "STACK_OVERFLOW" || code == "NOT_ENOUGH_SPACE" ||
           code == "NOT_ENOUGH_TEMP_SPACE";
}

NodeFile golden_node() {
    const std::string path = kGoldenFolder + "node.json";
    return parse_node_file(read_file(path).value(), path).value();
}

std::vector<std::string> golden_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kGoldenFolder))
        if (entry.path().extension() == ".aesl") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

Golden golden_case(const std::string& name) {
    const std::string expected = kGoldenFolder + name + ".expected.json";
    return parse_golden(read_file(kGoldenFolder + name + ".aesl").value(),
                        read_file(expected).value(), expected)
        .value();
}

Outcome in_golden_form(Outcome outcome, const NodeFile& node) {
    for (const NamedVariable& variable : node.target.variables) {
        const auto found = outcome.memory.find(variable.name);
        if (found != outcome.memory.end() && found->second == Words(variable.size))
            outcome.memory.erase(found);
    }
    return outcome;
}

std::vector<uint64_t> seeds(uint64_t count) {
    if (const char* seed = std::getenv("VAGUS_SEED")) return {std::strtoull(seed, nullptr, 10)};
    if (std::getenv("VAGUS_LONG") != nullptr) count *= kLongFactor;
    std::vector<uint64_t> list;
    for (uint64_t seed = 1; seed <= count; ++seed) list.push_back(seed);
    return list;
}

std::string explain(uint64_t seed, const Case& program, const std::string& expected,
                    const std::string& found) {
    std::string text = "VAGUS_SEED=" + std::to_string(seed) + " repeats this case\n";
    int line = 1;
    text += std::to_string(line) + "\t";
    for (const char character : program.source) {
        text += character;
        if (character == '\n') text += std::to_string(++line) + "\t";
    }
    for (size_t i = 0; i < program.stimuli.size(); ++i) {
        const Stimulus& stimulus = program.stimuli[i];
        text += "\nstimulus " + std::to_string(i + 1) + ": " + stimulus.event;
        for (const int16_t word : stimulus.arguments) text += " " + std::to_string(word);
    }
    return text + "\n--- expected\n" + expected + "--- found\n" + found;
}

}  // namespace vagus::aesl
