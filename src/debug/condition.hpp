// Conditions of breakpoints, and what log points show: expressions in the grammar of AESL over a
// node's variables and the constants of the project, evaluated on the host.
//
//     speed > 100 and not (prox.horizontal[2] == 0 or state == WAITING)
//
// Operators as in AESL, weakest first: or, and, not, the comparisons, | ^ &, << >>, + -, * / %,
// unary - ~ abs. Comparisons and logic give 1 or 0; anything but 0 is true. Arithmetic wraps to 16
// bits as on a node.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "aesl/compile.hpp"
#include "aesl/target.hpp"
#include "base/result.hpp"

namespace vagus::debug {

constexpr size_t kConditionBytesMax = 1000;
constexpr int kConditionDepthMax = 50;         // parentheses and unary operators in each other
constexpr size_t kConditionVariablesMax = 16;  // different ones
constexpr size_t kConditionWordsMax = 1024;    // of them together

class Condition {
public:
    // The Error says at which column what was expected.
    static Result<Condition> parse(std::string_view text,
                                   const std::vector<aesl::VariablePlace>& variables,
                                   const std::vector<aesl::Constant>& constants);

    // Whether it is one at all, where it is not known which names there are: of a script that does
    // not compile, for instance.
    static Status check_form(std::string_view text);

    // The variables that must be read before evaluate(), each once.
    const std::vector<aesl::VariablePlace>& variables() const { return variables_; }
    // With the values of variables(), in the same order. Fails on a division by zero and an index
    // out of range.
    Result<int16_t> value(const std::vector<std::vector<int16_t>>& values) const;
    // Whether that is anything but 0.
    Result<bool> evaluate(const std::vector<std::vector<int16_t>>& values) const;

private:
    friend class ConditionParser;
    enum class Kind {
        Number,
        Variable,
        Not,
        Negate,
        Complement,
        Absolute,
        Or,
        And,
        Equal,
        Unequal,
        Greater,
        GreaterEqual,
        Less,
        LessEqual,
        BitOr,
        BitXor,
        BitAnd,
        ShiftLeft,
        ShiftRight,
        Add,
        Subtract,
        Multiply,
        Divide,
        Modulo
    };
    struct Term {
        Kind kind = Kind::Number;
        int16_t number = 0;   // of a Number
        size_t variable = 0;  // of a Variable: which of variables_
        int left = -1,
            right = -1;  // places in terms_; a Variable's index is `left`, -1: the first word
    };

    Result<int16_t> value_of(int term, const std::vector<std::vector<int16_t>>& values) const;
    Result<int16_t> element(const Term& term,
                            const std::vector<std::vector<int16_t>>& values) const;

    std::vector<Term> terms_;  // operands before their operators; the last is the whole
    std::vector<aesl::VariablePlace> variables_;
};

}  // namespace vagus::debug
