#include "debug/condition.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/nearest.hpp"

namespace vagus::debug {

// Recursive descent, one level of precedence a number (language spec, chapter 2). Remembers its
// first error; after it every function returns without reading on.
class ConditionParser {
public:
    using Kind = Condition::Kind;

    ConditionParser(std::string_view text, const std::vector<aesl::VariablePlace>& variables,
                    const std::vector<aesl::Constant>& constants)
        : text_(text), variables_(variables), constants_(constants) {}

    // Of variables and constants that nobody knows.
    void take_any_name() { any_name_ = true; }

    Result<Condition> parse() {
        if (text_.size() > kConditionBytesMax) {
            return Error{Code::Limit, "the expression has " + std::to_string(text_.size()) +
                                          " characters; at most " +
                                          std::to_string(kConditionBytesMax) + " are allowed"};
        }
        level(0);
        skip_spaces();
        if (!failed() && at_ < text_.size()) fail("an operator or the end");
        if (failed()) return Error{Code::BadInput, error_};
        return std::move(condition_);
    }

private:
    struct Operator {
        std::string_view symbol;
        Kind kind;
        int level;
    };
    static constexpr int kNotLevel = 2;  // `not` binds tighter than `and`, weaker than a comparison
    static constexpr int kUnaryLevel = 9;
    // Longer symbols before those that they begin with.
    static constexpr std::array<Operator, 18> kOperators = {{
        {"or", Kind::Or, 0},
        {"and", Kind::And, 1},
        {"==", Kind::Equal, 2},
        {"!=", Kind::Unequal, 2},
        {"<<", Kind::ShiftLeft, 6},
        {">>", Kind::ShiftRight, 6},
        {">=", Kind::GreaterEqual, 2},
        {"<=", Kind::LessEqual, 2},
        {">", Kind::Greater, 2},
        {"<", Kind::Less, 2},
        {"|", Kind::BitOr, 3},
        {"^", Kind::BitXor, 4},
        {"&", Kind::BitAnd, 5},
        {"+", Kind::Add, 7},
        {"-", Kind::Subtract, 7},
        {"*", Kind::Multiply, 8},
        {"/", Kind::Divide, 8},
        {"%", Kind::Modulo, 8},
    }};

    static bool is_digit(char c) { return c >= '0' && c <= '9'; }
    static bool in_word(char c) {
        return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
               c == '.' || static_cast<unsigned char>(c) >= 0x80;
    }

    bool failed() const { return !error_.empty(); }
    int fail(const std::string& expected) {
        if (failed()) return -1;
        const std::string found =
            at_ < text_.size() ? "\"" + std::string(text_.substr(at_)) + "\"" : "nothing more";
        error_ = "expression, column " + std::to_string(at_ + 1) + ": expected " + expected +
                 ", found " + found;
        return -1;
    }
    void skip_spaces() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) at_++;
    }
    // Takes `symbol` if it comes next; a symbol of letters only as a whole word.
    bool take(std::string_view symbol) {
        skip_spaces();
        if (!text_.substr(at_).starts_with(symbol)) return false;
        const size_t end = at_ + symbol.size();
        if (in_word(symbol[0]) && end < text_.size() && in_word(text_[end])) return false;
        at_ = end;
        return true;
    }
    const Operator* take_operator(int at_level) {
        for (const Operator& op : kOperators) {
            const size_t before = at_;
            if (!take(op.symbol)) continue;
            if (op.level == at_level) return &op;
            at_ = before;
            return nullptr;
        }
        return nullptr;
    }
    std::string_view word() {
        skip_spaces();
        const size_t first = at_;
        while (at_ < text_.size() && in_word(text_[at_])) at_++;
        return text_.substr(first, at_ - first);
    }
    int add(Condition::Term term) {
        condition_.terms_.push_back(term);
        return static_cast<int>(condition_.terms_.size()) - 1;
    }
    int add(Kind kind, int left, int right) {
        return add({.kind = kind, .left = left, .right = right});
    }

    int level(int n) {
        if (n == kUnaryLevel) return unary();
        if (n == kNotLevel && take("not")) return nested(Kind::Not, n);
        int left = level(n + 1);
        while (!failed()) {
            const Operator* op = take_operator(n);
            if (op == nullptr) break;
            const int right = level(n + 1);
            left = add(op->kind, left, right);
        }
        return left;
    }
    int nested(Kind kind, int n) {
        if (++depth_ > kConditionDepthMax) return fail("less nesting");
        const int operand = level(n);
        depth_--;
        return add(kind, operand, -1);
    }
    int unary() {
        if (take("-")) return negative();
        if (take("~")) return nested(Kind::Complement, kUnaryLevel);
        if (take("abs")) return nested(Kind::Absolute, kUnaryLevel);
        if (take("(")) return parenthesis();
        skip_spaces();
        if (at_ < text_.size() && is_digit(text_[at_])) return number(1);
        return name();
    }
    // `-` before a number is part of it (1.4): -32768 is one.
    int negative() {
        skip_spaces();
        if (at_ < text_.size() && is_digit(text_[at_])) return number(-1);
        return nested(Kind::Negate, kUnaryLevel);
    }
    int parenthesis() {
        if (++depth_ > kConditionDepthMax) return fail("less nesting");
        const int inner = level(0);
        depth_--;
        return failed() || take(")") ? inner : fail("\")\"");
    }
    int number(int sign) {
        const size_t first = at_;
        const std::string digits(word());
        const bool hexadecimal = digits.starts_with("0x"), binary = digits.starts_with("0b");
        const char* begin = digits.c_str() + (hexadecimal || binary ? 2 : 0);
        char* end = nullptr;
        const long value = std::strtol(begin, &end, hexadecimal ? 16 : binary ? 2 : 10);
        const long most = hexadecimal || binary ? 0xffff : sign < 0 ? 32768 : 32767;
        if (end == begin || *end != '\0' || value < 0 || value > most) {
            at_ = first;
            return fail("a number of 16 bits");
        }
        return add({.number = static_cast<int16_t>(sign * value)});
    }
    int name() {
        const size_t first = at_;
        const std::string_view found = word();
        if (found.empty()) return fail("a variable, a constant or a number");
        if (any_name_) return add({.kind = Kind::Variable, .left = take("[") ? index() : -1});
        for (const aesl::VariablePlace& variable : variables_) {
            if (variable.name == found) return variable_term(variable);
        }
        for (const aesl::Constant& constant : constants_) {
            if (constant.name == found) {
                return add({.number = static_cast<int16_t>(constant.value)});
            }
        }
        at_ = first;
        return fail("a variable or constant of the node" + suggestion(found));
    }
    std::string suggestion(std::string_view typed) const {
        std::vector<std::string> names;
        for (const aesl::VariablePlace& variable : variables_) names.push_back(variable.name);
        for (const aesl::Constant& constant : constants_) names.push_back(constant.name);
        const std::string guess = nearest(typed, names);
        return guess.empty() ? "" : " (did you mean " + guess + "?)";
    }
    int variable_term(const aesl::VariablePlace& variable) {
        if (variable.size == 0)
            return fail("a variable with words; " + variable.name + " has none");
        const size_t place = place_of(variable);
        int index = -1;
        if (take("[")) {
            index = this->index();
        } else if (variable.size != 1) {
            return fail("\"[\" and an index, because " + variable.name + " has " +
                        std::to_string(variable.size) + " words");
        }
        return add({.kind = Kind::Variable, .variable = place, .left = index});
    }
    // Behind its bracket: an `expr`, with comparisons only in parentheses.
    int index() {
        if (++depth_ > kConditionDepthMax) return fail("less nesting");
        const int index = level(3);
        depth_--;
        return failed() || take("]") ? index : fail("\"]\"");
    }
    size_t place_of(const aesl::VariablePlace& variable) {
        auto& used = condition_.variables_;
        for (size_t i = 0; i < used.size(); i++) {
            if (used[i].name == variable.name) return i;
        }
        used.push_back(variable);
        words_ += variable.size;
        if (used.size() > kConditionVariablesMax || words_ > kConditionWordsMax) {
            fail("at most " + std::to_string(kConditionVariablesMax) + " variables of " +
                 std::to_string(kConditionWordsMax) + " words together");
        }
        return used.size() - 1;
    }

    std::string_view text_;
    const std::vector<aesl::VariablePlace>& variables_;
    const std::vector<aesl::Constant>& constants_;
    size_t at_ = 0;
    int depth_ = 0;
    size_t words_ = 0;
    bool any_name_ = false;
    Condition condition_;
    std::string error_;
};

Result<Condition> Condition::parse(std::string_view text,
                                   const std::vector<aesl::VariablePlace>& variables,
                                   const std::vector<aesl::Constant>& constants) {
    return ConditionParser(text, variables, constants).parse();
}

Status Condition::check_form(std::string_view text) {
    const std::vector<aesl::VariablePlace> no_variables;
    const std::vector<aesl::Constant> no_constants;
    ConditionParser parser(text, no_variables, no_constants);
    parser.take_any_name();
    const auto parsed = parser.parse();
    return parsed.ok() ? Status::done() : Status(parsed.error());
}

namespace {

int16_t wrap16(int32_t value) {
    return static_cast<int16_t>(static_cast<uint16_t>(static_cast<uint32_t>(value)));
}

constexpr int32_t kShiftMask = 31;  // counts as amd64 takes them (wire spec, 3.4)

}  // namespace

Result<int16_t> Condition::value(const std::vector<std::vector<int16_t>>& values) const {
    return value_of(static_cast<int>(terms_.size()) - 1, values);
}

Result<bool> Condition::evaluate(const std::vector<std::vector<int16_t>>& values) const {
    return TRY(value(values)) != 0;
}

// The depth is that of the tree: a chain of operators of one level leans to the left, at most
// kConditionBytesMax / 2 deep.
Result<int16_t> Condition::value_of(int place,
                                    const std::vector<std::vector<int16_t>>& values) const {
    const Term& term = terms_[static_cast<size_t>(place)];
    if (term.kind == Kind::Number) return term.number;
    if (term.kind == Kind::Variable) return element(term, values);
    const int32_t a = TRY(value_of(term.left, values));
    const int32_t b = term.right < 0 ? int32_t{0} : int32_t{TRY(value_of(term.right, values))};
    const bool divides = term.kind == Kind::Divide || term.kind == Kind::Modulo;
    if (divides && b == 0) return Error{Code::BadInput, "the expression divides by zero"};
    switch (term.kind) {
        case Kind::Number:
        case Kind::Variable:
            break;
        case Kind::Not:
            return int16_t{a == 0};
        case Kind::Negate:
            return wrap16(-a);
        case Kind::Complement:
            return wrap16(~a);
        case Kind::Absolute:
            return wrap16(std::abs(a));
        case Kind::Or:
            return int16_t{a != 0 || b != 0};
        case Kind::And:
            return int16_t{a != 0 && b != 0};
        case Kind::Equal:
            return int16_t{a == b};
        case Kind::Unequal:
            return int16_t{a != b};
        case Kind::Greater:
            return int16_t{a > b};
        case Kind::GreaterEqual:
            return int16_t{a >= b};
        case Kind::Less:
            return int16_t{a < b};
        case Kind::LessEqual:
            return int16_t{a <= b};
        case Kind::BitOr:
            return wrap16(a | b);
        case Kind::BitXor:
            return wrap16(a ^ b);
        case Kind::BitAnd:
            return wrap16(a & b);
        case Kind::ShiftLeft:
            return wrap16(a << (b & kShiftMask));
        case Kind::ShiftRight:
            return wrap16(a >> (b & kShiftMask));
        case Kind::Add:
            return wrap16(a + b);
        case Kind::Subtract:
            return wrap16(a - b);
        case Kind::Multiply:
            return wrap16(a * b);
        case Kind::Divide:
            return wrap16(a / b);
        case Kind::Modulo:
            return wrap16(a % b);
    }
    return int16_t{0};
}

Result<int16_t> Condition::element(const Term& term,
                                   const std::vector<std::vector<int16_t>>& values) const {
    const std::vector<int16_t>& words = values[term.variable];
    const int16_t index = term.left < 0 ? int16_t{0} : TRY(value_of(term.left, values));
    if (index >= 0 && static_cast<size_t>(index) < words.size()) {
        return words[static_cast<size_t>(index)];
    }
    return Error{Code::BadInput, "the expression reads " + variables_[term.variable].name + "[" +
                                     std::to_string(index) + "], which has " +
                                     std::to_string(words.size()) + " words"};
}

}  // namespace vagus::debug
