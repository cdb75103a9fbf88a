// The AESL compiler: source text in, program or diagnostics out (docs/spec/aesl-language.md). Pure:
// no files, no clock.
//
//     const Compilation done = compile("var n\nonevent tick\nn++", target, common, {});
//     if (!done.ok()) for (const Diagnostic& d : done.errors) print(d);
//     else load(done.program.bytecode);
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/target.hpp"

namespace vagus::aesl {

enum class Dialect { Auto, Modern, Year2007 };  // Auto: the look at the tokens of section 6

struct Options {
    Dialect dialect = Dialect::Auto;
    std::string
        ontimer;  // name of the local event that `ontimer` means; empty: the rule of section 6
};

// Line and column count from 1, the column in code points. Line 0: the error has no position.
struct Position {
    int line = 0;
    int column = 0;
    friend bool operator==(const Position&, const Position&) = default;
};

struct Diagnostic {
    std::string
        // Name in the catalogue of section 3.9, for instance "ARRAY_SIZE_MISMATCH"; warnings:
        // "W_…".
        code;
    int number = 0;  // its number there; 0 for warnings
    Position at;
    Position end;  // one past the last character of what is marked; equal to `at` if nothing is
    std::string
        // What was expected, what was found, how to mend it; one sentence, no position in it.
        message;
};

struct VariablePlace {
    std::string name;
    uint16_t address = 0;
    uint16_t size = 1;
};

struct SubroutinePlace {
    std::string name;
    uint16_t address = 0;
    int line = 0;
};

struct Used {
    uint16_t bytecode = 0;   // words
    uint16_t variables = 0;  // words: node's, user's and the most temporaries needed at once
    uint16_t stack = 0;      // words, the deepest
};

struct Program {
    std::vector<uint16_t> bytecode;
    std::vector<uint16_t> lines;           // one a word, from 1; 0 for the event table
    std::vector<VariablePlace> variables;  // the node's, then the user's, in order of address
    std::vector<SubroutinePlace> subroutines;
    Used used;
};

// With errors the program is empty. The first error is the one that section 3.2 selects; the others
// follow in order of position, never two for one mistake.
struct Compilation {
    Program program;
    std::vector<Diagnostic> errors;
    std::vector<Diagnostic> warnings;
    bool ok() const { return errors.empty(); }
};

Compilation compile(std::string_view source, const Target& target, const CommonDefinitions& common,
                    const Options& options);

}  // namespace vagus::aesl
