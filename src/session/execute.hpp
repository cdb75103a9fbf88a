// Runs a compiled script on one software node, event by event, each to its end, and tells what came
// of it: the logic of `vagus exec`. What goes in and out is defined in
// testdata/golden/aesl/README.md.
//
//     const auto stimuli = TRY(session::parse_stimuli(text, "case.json"));
//     const auto execution = TRY(session::execute(program, node_file, stimuli, {}));
//     print(session::format_execution(execution));
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/compile.hpp"
#include "aesl/node_file.hpp"
#include "base/result.hpp"

namespace vagus::session {

constexpr uint32_t kStepsPerEvent = 1'000'000;  // unless the caller says otherwise
constexpr size_t kStimuliMax = 100'000;
constexpr size_t kEmissionsMax = 1'000'000;  // more end the run like too many steps

struct Assignment {
    std::string variable;
    std::vector<int16_t> words;
};

// Applied in this order: variables are set, then the event happens.
struct Stimulus {
    std::vector<Assignment> set;
    std::string event;               // empty: none
    std::vector<int16_t> arguments;  // to the first words of the third variable, the rest stays
    std::optional<int16_t> source;   // to the second variable
};

// Reads `stimuli` of an object; a whole expected file of the golden cases will do. None is no
// stimuli.
Result<std::vector<Stimulus>> parse_stimuli(std::string_view text, std::string_view file);

struct VariableWords {
    std::string name;
    std::vector<int16_t> words;
    friend bool operator==(const VariableWords&, const VariableWords&) = default;
};

struct Emission {
    int during = 0;  // 0 the initialisation, n the n-th stimulus
    std::string event;
    std::vector<int16_t> arguments;
    friend bool operator==(const Emission&, const Emission&) = default;
};

enum class FaultKind { DivisionByZero, ArrayOutOfBounds, NodeSpecific, StepLimit };
std::string_view name_of(FaultKind kind);  // "division_by_zero" …

struct RuntimeError {
    FaultKind kind = FaultKind::NodeSpecific;
    int during = 0;
    int line = 0;                  // of the script; 0 if the place belongs to no line
    std::optional<uint16_t> size;  // ArrayOutOfBounds
    std::optional<int16_t> index;  // ArrayOutOfBounds
    std::string text;              // NodeSpecific
};

struct Execution {
    std::vector<VariableWords>
        memory;  // every variable of the script; those of the node that are not all zero
    std::vector<Emission> emitted;
    std::optional<RuntimeError> error;  // the run stopped there
};

// Fails only for what is wrong with the input: natives without code, a program that does not fit
// the node, stimuli that name what does not exist. What goes wrong inside the script is in the
// Execution.
Result<Execution> execute(const aesl::Program& program, const aesl::NodeFile& node,
                          const std::vector<Stimulus>& stimuli, uint32_t steps_per_event);

// One JSON object, with a newline at the end.
std::string format_execution(const Execution& execution);
std::string format_compile_error(const aesl::Diagnostic& error);

}  // namespace vagus::session
