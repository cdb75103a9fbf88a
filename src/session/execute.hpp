// Runs a compiled script on one software node, event by event, each to its end, and tells what came
// of it: the logic of `vagus exec`. What goes in and out is defined in
// testdata/golden/aesl/README.md.
//
//     const auto stimuli = TRY(aesl::parse_stimuli(text, "case.json"));
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
#include "aesl/stimuli.hpp"
#include "base/result.hpp"

namespace vagus::session {

constexpr uint32_t kStepsPerEvent = 1'000'000;  // unless the caller says otherwise
constexpr size_t kEmissionsMax = 1'000'000;     // more end the run like too many steps

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

// Why a run stopped before its end.
enum class StopKind { DivisionByZero, ArrayOutOfBounds, NodeSpecific, StepLimit };
std::string_view name_of(StopKind kind);  // "division_by_zero" …

struct RuntimeError {
    StopKind kind = StopKind::NodeSpecific;
    int during = 0;
    int line = 0;                  // of the script; 0 if the place belongs to no line
    std::optional<uint16_t> size;  // ArrayOutOfBounds
    std::optional<int16_t> index;  // ArrayOutOfBounds
    std::string text;              // NodeSpecific
};

struct Execution {
    // Every variable of the script; those of the node that are not all zero.
    std::vector<VariableWords> memory;
    std::vector<Emission> emitted;
    std::optional<RuntimeError> error;  // the run stopped there
};

// Fails only for what is wrong with the input: natives without code, a program that does not fit
// the node, stimuli that name what does not exist. What goes wrong inside the script is in the
// Execution.
Result<Execution> execute(const aesl::Program& program, const aesl::NodeFile& node,
                          const std::vector<aesl::Stimulus>& stimuli, uint32_t steps_per_event);

// One JSON object, with a newline at the end.
std::string format_execution(const Execution& execution);
std::string format_compile_error(const aesl::Diagnostic& error);

}  // namespace vagus::session
