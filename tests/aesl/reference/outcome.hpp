// What a program is given, and what it makes of it: the common form in which the evaluator, the
// compiler with our machine, and Debian's compiler and machine are compared. For tests only.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/stimuli.hpp"
#include "base/result.hpp"

namespace vagus::aesl {

using Words = std::vector<int16_t>;

struct Case {
    std::string source;
    std::vector<Stimulus> stimuli;
};

struct Emission {
    size_t during = 0;  // 0: the initialisation, n: the n-th stimulus
    std::string event;
    Words arguments;
    friend bool operator==(const Emission&, const Emission&) = default;
};

enum class FaultCause { DivisionByZero, ArrayOutOfBounds, NodeSpecific };

struct Fault {
    FaultCause kind = FaultCause::DivisionByZero;
    size_t during = 0;
    int line = 0;
    friend bool operator==(const Fault&, const Fault&) = default;
};

struct CompileError {
    std::string code;  // without "_GUESS"
    int line = 0;
    friend bool operator==(const CompileError&, const CompileError&) = default;
};

// With an error nothing else is filled.
struct Outcome {
    std::optional<CompileError> error;
    std::map<std::string, Words> memory;  // every variable of the node and of the user
    std::vector<Emission> emitted;
    std::optional<Fault> fault;
    bool out_of_steps = false;  // more steps than the runner allows; the rest means nothing then
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

// For messages of failing tests: variables of zeros are left out.
std::string to_string(const Outcome& outcome);

// Code of the catalogue without the suffix of the variants with a suggestion.
std::string without_guess(std::string_view code);

// A golden pair: the stimuli and the outcome of `expected`, the text of NNN-name.expected.json.
// Variables that it does not list are absent from `memory`.
struct Golden {
    Case program;
    Outcome outcome;
};
Result<Golden> parse_golden(std::string source, std::string_view expected, std::string_view file);

}  // namespace vagus::aesl
