// A slow, obvious evaluator of AESL: it runs a program on its syntax tree, directly by the words of
// chapters 3 and 4 of docs/spec/aesl-language.md. It knows neither bytecode nor the machine, so
// that it can be the reference for both. For tests only.
#pragma once

#include "aesl/node_file.hpp"
#include "reference/outcome.hpp"

namespace vagus::aesl {

// Statements and loop rounds of a whole case; then the evaluator stops.
constexpr int kEvaluateStepsMax = 50'000;

// Runs the initialisation, then the stimuli in order. Errors of the text are those of the
// compiler's phases 0 to 6; those of phase 7 (constants) are found here. Stack and size of the
// bytecode are not looked at.
Outcome evaluate(const Case& program, const NodeFile& node);

}  // namespace vagus::aesl
