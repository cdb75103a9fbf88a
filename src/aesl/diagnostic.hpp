// One error or warning of the compiler as a value: its code, its range in the text, its sentence,
// and, where there is an obvious one, a fix that a program can apply.
//
//     motor.left = 200
//     ^~~~~~~~~~          at 1:1, end 1:11
//     fixes: { "Write \"motor.left.target\"", edits {{1:1, 1:11, "motor.left.target"}} }
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/target.hpp"

namespace vagus::aesl {

// Line and column count from 1, the column in code points. Line 0: the error has no position.
struct Position {
    int line = 0;
    int column = 0;
    friend bool operator==(const Position&, const Position&) = default;
    friend auto operator<=>(const Position&, const Position&) = default;
};

// A range of the text; `end` is one past its last character. All zero for what has no position.
struct Mark {
    Position at;
    Position end;
    friend bool operator==(const Mark&, const Mark&) = default;
};

// Puts `text` in the place of a range; where the range is empty it is inserted there.
struct Edit {
    Mark range;
    std::string text;
    friend bool operator==(const Edit&, const Edit&) = default;
};

// What a click on "fix it" does: edits of the script, or an event to declare in the project.
struct Fix {
    std::string label;        // for a button: `Write "=="`
    std::vector<Edit> edits;  // of the text as it was compiled, by position; they do not overlap
    std::optional<GlobalEvent> declares = std::nullopt;
};

struct Diagnostic {
    // Name in the catalogue of section 3.9, for instance "ARRAY_SIZE_MISMATCH"; warnings: "W_…".
    std::string code;
    int number = 0;  // its number there; 0 for warnings
    Position at;
    Position end;  // one past the last character of what is marked; equal to `at` if nothing is
    // What was expected, what was found, how to fix it; one sentence, no position in it.
    std::string message;
    std::optional<Fix> fix = std::nullopt;
    // Where section 3.2 places the error, if a person is better shown another place: the output of
    // `exec` has this one.
    std::optional<Position> formal = std::nullopt;

    Position formal_place() const { return formal.value_or(at); }
};

// The text with the edits made. Positions outside of it count as its nearest end.
std::string with_edits(std::string_view source, const std::vector<Edit>& edits);

}  // namespace vagus::aesl
