#include "plan/formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace vagus::plan {

namespace {

bool starts_name(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}

bool continues_name(char c) {
    return starts_name(c) || (c >= '0' && c <= '9');
}

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

Error wrong(std::string what) {
    return Error{Code::BadInput, std::move(what)};
}

std::string_view symbol_of(FormulaOp op) {
    switch (op) {
        case FormulaOp::Negate:
        case FormulaOp::Subtract:
            return "-";
        case FormulaOp::Add:
            return "+";
        case FormulaOp::Join:
            return "&";
        case FormulaOp::Multiply:
            return "*";
        case FormulaOp::Divide:
            return "/";
        case FormulaOp::Modulo:
            return "%";
        case FormulaOp::Constant:
        case FormulaOp::Variable:
            break;
    }
    return "";
}

// Bool counts as int (P9).
int64_t integer_of(const Value& value) {
    return value.type() == Type::Bool ? int64_t{value.boolean()} : value.integer();
}

bool is_whole(const Value& value) {
    return value.type() == Type::Bool || value.type() == Type::Int;
}

Result<Value> apply_whole(FormulaOp op, int64_t left, int64_t right) {
    int64_t result = 0;
    bool overflow = false;
    switch (op) {
        case FormulaOp::Add:
            overflow = __builtin_add_overflow(left, right, &result);
            break;
        case FormulaOp::Subtract:
            overflow = __builtin_sub_overflow(left, right, &result);
            break;
        case FormulaOp::Multiply:
            overflow = __builtin_mul_overflow(left, right, &result);
            break;
        case FormulaOp::Divide:
        case FormulaOp::Modulo:
            if (right == 0) {
                return wrong(fmt::format("{} {} 0 divides by zero", left, symbol_of(op)));
            }
            if (right == -1) {  // the lowest int has no opposite, and its remainder traps
                if (op == FormulaOp::Modulo) return Value(int64_t{0});
                overflow = __builtin_sub_overflow(int64_t{0}, left, &result);
                break;
            }
            result = op == FormulaOp::Divide ? left / right : left % right;
            break;
        case FormulaOp::Constant:
        case FormulaOp::Variable:
        case FormulaOp::Negate:
        case FormulaOp::Join:
            assert(false);
    }
    if (!overflow) return Value(result);
    return wrong(
        fmt::format("{} {} {} does not fit an int of 64 bits", left, symbol_of(op), right));
}

Result<Value> apply_float(FormulaOp op, double left, double right) {
    double result = 0;
    switch (op) {
        case FormulaOp::Add:
            result = left + right;
            break;
        case FormulaOp::Subtract:
            result = left - right;
            break;
        case FormulaOp::Multiply:
            result = left * right;
            break;
        case FormulaOp::Divide:
            result = left / right;
            break;
        case FormulaOp::Modulo:
            result = std::fmod(left, right);
            break;  // exact: IEEE says so
        case FormulaOp::Constant:
        case FormulaOp::Variable:
        case FormulaOp::Negate:
        case FormulaOp::Join:
            assert(false);
    }
    if (std::isfinite(result)) return Value(result);
    return wrong(fmt::format("{} {} {} is not a finite number", text_of(left), symbol_of(op),
                             text_of(right)));
}

Result<Value> join(const Value& left, const Value& right) {
    std::string text = TRY(text_of(left));
    text += TRY(text_of(right));
    if (text.size() > kTextBytesMax) {
        return wrong(fmt::format("a text of more than {} bytes; make the formula's parts shorter",
                                 kTextBytesMax));
    }
    return Value(std::move(text));
}

Result<Value> negate(const Value& value) {
    if (value.type() == Type::Object) return wrong("an object has no opposite (-)");
    if (is_whole(value)) return apply_whole(FormulaOp::Subtract, 0, integer_of(value));
    const Value number = TRY(convert(value, Type::Float));
    return Value(-number.number());
}

}  // namespace

Result<Value> apply(FormulaOp op, const Value& left, const Value& right) {
    const bool text = left.type() == Type::String || right.type() == Type::String;
    if (left.type() == Type::Object || right.type() == Type::Object) {
        return wrong(fmt::format("an object cannot stand beside {}", symbol_of(op)));
    }
    if (op == FormulaOp::Join || (op == FormulaOp::Add && text)) return join(left, right);
    if (is_whole(left) && is_whole(right)) {
        return apply_whole(op, integer_of(left), integer_of(right));
    }
    const Value l = TRY(convert(left, Type::Float));
    const Value r = TRY(convert(right, Type::Float));
    return apply_float(op, l.number(), r.number());
}

bool is_name(std::string_view text) {
    return !text.empty() && starts_name(text[0]) &&
           std::all_of(text.begin(), text.end(), continues_name);
}

Formula::Formula(Value constant) : steps_{{FormulaOp::Constant, 0}} {
    constants_.push_back(std::move(constant));
}

Result<Value> Formula::evaluate(std::span<const Value> values) const {
    assert(values.size() == names_.size());
    std::vector<Value> stack;
    for (const Step& step : steps_) {
        if (step.op == FormulaOp::Constant) {
            stack.push_back(constants_[step.index]);
        } else if (step.op == FormulaOp::Variable) {
            stack.push_back(values[step.index]);
        } else if (step.op == FormulaOp::Negate) {
            stack.back() = TRY(negate(stack.back()));
        } else {
            const Value right = std::move(stack.back());
            stack.pop_back();
            stack.back() = TRY(apply(step.op, stack.back(), right));
        }
    }
    return std::move(stack.back());
}

std::optional<Type> Formula::type(std::span<const Type> types) const {
    assert(types.size() == names_.size());
    std::vector<Type> stack;
    for (const Step& step : steps_) {
        if (step.op == FormulaOp::Constant) {
            stack.push_back(constants_[step.index].type());
            continue;
        }
        if (step.op == FormulaOp::Variable) {
            stack.push_back(types[step.index]);
            continue;
        }
        const Type right = stack.back();
        if (step.op != FormulaOp::Negate) stack.pop_back();
        const Type left = stack.back();
        if (left == Type::Object || right == Type::Object) return std::nullopt;
        const bool text = left == Type::String || right == Type::String;
        const bool real = text || left == Type::Float || right == Type::Float;
        const bool joins = step.op == FormulaOp::Join || (step.op == FormulaOp::Add && text);
        stack.back() = joins ? Type::String : real ? Type::Float : Type::Int;
    }
    return stack.back();
}

const std::string* Formula::single_name() const {
    return steps_.size() == 1 && steps_[0].op == FormulaOp::Variable ? &names_[0] : nullptr;
}

// Recursive descent over the grammar of P8; only parentheses and minuses recurse, kFormulaDepthMax
// deep.
class FormulaParser {
public:
    explicit FormulaParser(std::string_view text) : text_(text) {}

    Result<Formula> parse() {
        if (text_.size() > kFormulaBytesMax) {
            return wrong(fmt::format("a formula of more than {} bytes", kFormulaBytesMax));
        }
        TRY(sum());
        skip_spaces();
        if (at_ < text_.size()) return expected("an operator (+ - & * / %) or the end");
        return std::move(formula_);
    }

private:
    Status sum() {
        TRY(product());
        for (;;) {
            const char c = next();
            if (c != '+' && c != '-' && c != '&') return Status::done();
            ++at_;
            TRY(product());
            emit(c == '+' ? FormulaOp::Add : c == '-' ? FormulaOp::Subtract : FormulaOp::Join);
        }
    }

    Status product() {
        TRY(unary());
        for (;;) {
            const char c = next();
            if (c != '*' && c != '/' && c != '%') return Status::done();
            ++at_;
            TRY(unary());
            emit(c == '*' ? FormulaOp::Multiply : c == '/' ? FormulaOp::Divide : FormulaOp::Modulo);
        }
    }

    Status unary() {
        int minuses = 0;
        while (next() == '-') {
            ++at_;
            ++minuses;
            TRY(deeper());
        }
        TRY(primary());
        depth_ -= minuses;
        for (; minuses > 0; --minuses) emit(FormulaOp::Negate);
        return Status::done();
    }

    Status primary() {
        const char c = next();
        if (c == '(') {
            ++at_;
            TRY(deeper());
            TRY(sum());
            if (next() != ')') return expected("a closing parenthesis");
            ++at_;
            --depth_;
            return Status::done();
        }
        if (c == '"' || c == '\'') return string(c);
        if (c >= '0' && c <= '9') return number();
        if (starts_name(c)) return name();
        return expected("a number, a text in quotes, a variable or an opening parenthesis");
    }

    Status string(char quote) {
        const size_t end = text_.find(quote, at_ + 1);
        if (end == std::string_view::npos) {
            return wrong(fmt::format("the text that begins at position {} has no closing {}",
                                     at_ + 1, quote));
        }
        constant(Value(std::string(text_.substr(at_ + 1, end - at_ - 1))));
        at_ = end + 1;
        return Status::done();
    }

    Status number() {
        const NumberText found = number_at(text_.substr(at_));
        const std::string_view digits = text_.substr(at_, found.length);
        const size_t end = at_ + found.length;
        if (end < text_.size() && (continues_name(text_[end]) || text_[end] == '.')) {
            return wrong(
                fmt::format("\"{}{}\" at position {} is not a number; leave a space or an "
                            "operator behind {}",
                            digits, character_at(end), at_ + 1, digits));
        }
        if (found.whole) {
            const auto value = int_from_digits(digits);
            if (!value) return too_large(digits, "an int of 64 bits");
            constant(Value(*value));
        } else {
            const auto value = double_from_digits(digits);
            if (!value) return too_large(digits, "a float");
            constant(Value(*value));
        }
        at_ = end;
        return Status::done();
    }

    Status name() {
        size_t end = at_;
        while (end < text_.size() && continues_name(text_[end])) ++end;
        const std::string word(text_.substr(at_, end - at_));
        at_ = end;
        if (word == "true" || word == "false") {
            constant(Value(word == "true"));
            return Status::done();
        }
        auto& names = formula_.names_;
        const auto found = std::find(names.begin(), names.end(), word);
        const auto index = static_cast<uint32_t>(found - names.begin());
        if (found == names.end()) names.push_back(word);
        formula_.steps_.push_back({FormulaOp::Variable, index});
        return Status::done();
    }

    Status deeper() {
        if (++depth_ <= kFormulaDepthMax) return Status::done();
        return wrong(fmt::format("parentheses and minuses nested more than {} deep at position {}",
                                 kFormulaDepthMax, at_));
    }

    Error expected(std::string_view what) const {
        if (text_.find_first_not_of(" \t\n\r") == std::string_view::npos) {
            return wrong("the formula is empty; write a number, a text in quotes or a variable");
        }
        const std::string found = at_ < text_.size() ? fmt::format("\"{}\"", character_at(at_))
                                                     : std::string("the end of the formula");
        return wrong(fmt::format("expected {} at position {}, found {}", what, at_ + 1, found));
    }

    // A whole one: a part of its bytes would make the sentence malformed.
    std::string_view character_at(size_t at) const {
        const std::string_view rest = text_.substr(at);
        return rest.substr(0, std::max<size_t>(1, first_code_point(rest).bytes));
    }

    Error too_large(std::string_view digits, std::string_view what) const {
        return wrong(fmt::format("the number {} does not fit {}", digits, what));
    }

    char next() {
        skip_spaces();
        return at_ < text_.size() ? text_[at_] : '\0';
    }

    void skip_spaces() {
        while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    }

    void emit(FormulaOp op) { formula_.steps_.push_back({op, 0}); }

    void constant(Value value) {
        formula_.steps_.push_back(
            {FormulaOp::Constant, static_cast<uint32_t>(formula_.constants_.size())});
        formula_.constants_.push_back(std::move(value));
    }

    std::string_view text_;
    size_t at_ = 0;
    int depth_ = 0;
    Formula formula_;
};

Result<Formula> parse_formula(std::string_view text) {
    return FormulaParser(text).parse();
}

}  // namespace vagus::plan
