#include "plan/operate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "base/trig.hpp"
#include "plan/compare.hpp"

namespace vagus::plan {

namespace {

Error wrong(std::string what) {
    return Error{Code::BadInput, std::move(what)};
}

bool compares(FormulaOp op) {
    return op >= FormulaOp::Equal && op <= FormulaOp::GreaterOrEqual;
}

Error no_object_beside(FormulaOp op) {
    return wrong(fmt::format("an object cannot be an operand of {}", symbol_of(op)));
}

// ---- arithmetic ----

// `right` is not 0. The lowest int has no opposite, and its remainder by -1 traps.
bool divide_whole(FormulaOp op, int64_t left, int64_t right, int64_t& result) {
    if (op == FormulaOp::Modulo) {
        result = right == -1 ? 0 : left % right;
        return false;
    }
    if (right == -1) return __builtin_sub_overflow(int64_t{0}, left, &result);
    result = left / right;
    return false;
}

Result<Value> apply_whole(FormulaOp op, int64_t left, int64_t right) {
    int64_t result = 0;
    bool overflow = false;
    if (op == FormulaOp::Add) {
        overflow = __builtin_add_overflow(left, right, &result);
    } else if (op == FormulaOp::Subtract) {
        overflow = __builtin_sub_overflow(left, right, &result);
    } else if (op == FormulaOp::Multiply) {
        overflow = __builtin_mul_overflow(left, right, &result);
    } else if (right == 0) {
        return wrong(fmt::format("{} {} 0 divides by zero", left, symbol_of(op)));
    } else {
        overflow = divide_whole(op, left, right, result);
    }
    if (!overflow) return Value(result);
    return wrong(
        fmt::format("{} {} {} does not fit an int of 64 bits", left, symbol_of(op), right));
}

double float_result(FormulaOp op, double left, double right) {
    if (op == FormulaOp::Add) return left + right;
    if (op == FormulaOp::Subtract) return left - right;
    if (op == FormulaOp::Multiply) return left * right;
    if (op == FormulaOp::Divide) return left / right;
    return std::fmod(left, right);  // exact: IEEE says so
}

Result<Value> apply_float(FormulaOp op, double left, double right) {
    const double result = float_result(op, left, right);
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

// ---- functions ----

// The operand of a function: a bool becomes an int, a string a float (P9).
Result<Value> number_of(const Value& value, Function function) {
    if (value.type() == Type::Object) {
        return wrong(fmt::format("{} cannot take an object",
                                 formula_functions()[static_cast<size_t>(function)].name));
    }
    if (is_whole(value)) return Value(whole_of(value));
    return convert(value, Type::Float);
}

double float_of(const Value& number) {
    return number.type() == Type::Int ? static_cast<double>(number.integer()) : number.number();
}

bool less(const Value& a, const Value& b) {
    if (a.type() == Type::Int && b.type() == Type::Int) return a.integer() < b.integer();
    return float_of(a) < float_of(b);
}

// All become floats if one is.
void make_alike(std::vector<Value>& numbers) {
    const bool real = std::any_of(numbers.begin(), numbers.end(),
                                  [](const Value& number) { return number.type() == Type::Float; });
    if (!real) return;
    for (Value& number : numbers) number = Value(float_of(number));
}

Result<Value> absolute(const Value& x) {
    if (x.type() == Type::Float) return Value(std::fabs(x.number()));
    if (x.integer() >= 0) return x;
    if (x.integer() != INT64_MIN) return Value(-x.integer());
    return wrong(fmt::format("abs({}) does not fit an int of 64 bits", x.integer()));
}

Result<Value> clamp(const std::vector<Value>& numbers) {
    const Value& x = numbers[0];
    const Value& low = numbers[1];
    const Value& high = numbers[2];
    if (less(high, low)) {
        return wrong(fmt::format("clamp from {} to {}: the high end lies below the low one",
                                 text_of(low).value(), text_of(high).value()));
    }
    return less(x, low) ? low : less(high, x) ? high : x;
}

int64_t sign_of(double number) {
    return number > 0 ? 1 : number < 0 ? -1 : 0;
}

Result<Value> rounded(Function function, const Value& x) {
    if (x.type() == Type::Int) return x;
    if (function == Function::Round) return convert(x, Type::Int);  // half away from zero
    const double number = x.number();
    return convert(Value(function == Function::Floor ? std::floor(number) : std::ceil(number)),
                   Type::Int);
}

Result<Value> tangent(double degrees) {
    const double value = trig::tan_degrees(degrees);
    if (std::isfinite(value)) return Value(value);
    return wrong(fmt::format("tan({}) does not exist", text_of(degrees)));
}

Result<Value> angle_of(Function function, double x) {
    if (x >= -1 && x <= 1) {
        return Value(function == Function::Asin ? trig::asin_degrees(x) : trig::acos_degrees(x));
    }
    return wrong(fmt::format("{}({}): {} is not from -1 to 1",
                             function == Function::Asin ? "asin" : "acos", text_of(x), text_of(x)));
}

Result<Value> square_root(double x) {
    if (x < 0) return wrong(fmt::format("sqrt({}): no number below 0 has a root", text_of(x)));
    return Value(trig::sqrt(x));
}

Result<Value> call(Function function, std::vector<Value>& numbers) {
    const Value& x = numbers.front();
    switch (function) {
        case Function::Abs:
            return absolute(x);
        case Function::Min:
            return *std::min_element(numbers.begin(), numbers.end(), less);
        case Function::Max:
            return *std::max_element(numbers.begin(), numbers.end(), less);
        case Function::Clamp:
            return clamp(numbers);
        case Function::Sign:
            return Value(sign_of(float_of(x)));
        case Function::Floor:
        case Function::Ceil:
        case Function::Round:
            return rounded(function, x);
        case Function::Sqrt:
            return square_root(float_of(x));
        case Function::Sin:
            return Value(trig::sin_degrees(float_of(x)));
        case Function::Cos:
            return Value(trig::cos_degrees(float_of(x)));
        case Function::Tan:
            return tangent(float_of(x));
        case Function::Asin:
        case Function::Acos:
            return angle_of(function, float_of(x));
        case Function::Atan2:
            return Value(trig::atan2_degrees(float_of(x), float_of(numbers[1])));
        case Function::If:
            break;
    }
    assert(false);
    return wrong("");
}

bool is_float(Type type) {
    return type == Type::Float || type == Type::String;
}

}  // namespace

// ---- values ----

Result<Value> apply(FormulaOp op, const Value& operand) {
    if (op == FormulaOp::Not) {
        const Value truth = TRY(convert(operand, Type::Bool));
        return Value(!truth.boolean());
    }
    assert(op == FormulaOp::Negate);
    if (operand.type() == Type::Object) return wrong("an object has no opposite (-)");
    if (is_whole(operand)) return apply_whole(FormulaOp::Subtract, 0, whole_of(operand));
    const Value number = TRY(convert(operand, Type::Float));
    return Value(-number.number());
}

Result<Value> apply(FormulaOp op, const Value& left, const Value& right) {
    if (compares(op)) {
        const bool holds = TRY(compare(left, symbol_of(op), right));
        return Value(holds);
    }
    const bool text = left.type() == Type::String || right.type() == Type::String;
    if (left.type() == Type::Object || right.type() == Type::Object) return no_object_beside(op);
    if (op == FormulaOp::Join || (op == FormulaOp::Add && text)) return join(left, right);
    if (is_whole(left) && is_whole(right)) return apply_whole(op, whole_of(left), whole_of(right));
    const Value l = TRY(convert(left, Type::Float));
    const Value r = TRY(convert(right, Type::Float));
    return apply_float(op, l.number(), r.number());
}

Result<Value> apply(Function function, std::span<const Value> arguments) {
    std::vector<Value> numbers;
    for (const Value& argument : arguments) numbers.push_back(TRY(number_of(argument, function)));
    make_alike(numbers);
    return call(function, numbers);
}

// ---- types ----

Result<Type> type_of(FormulaOp op, Type operand) {
    if (operand == Type::Object) return no_object_beside(op);
    if (op == FormulaOp::Not) return Type::Bool;
    return is_float(operand) ? Type::Float : Type::Int;
}

Result<Type> type_of(FormulaOp op, Type left, Type right) {
    const bool object = left == Type::Object || right == Type::Object;
    const bool alike = left == right && (op == FormulaOp::Equal || op == FormulaOp::NotEqual);
    if (object && compares(op) && !alike) {
        return wrong("an object can only be compared with an object, by == or !=");
    }
    if (compares(op)) return Type::Bool;
    if (object) return no_object_beside(op);
    const bool text = left == Type::String || right == Type::String;
    if (op == FormulaOp::Join || (op == FormulaOp::Add && text)) return Type::String;
    return is_float(left) || is_float(right) ? Type::Float : Type::Int;
}

Result<Type> type_of(Function function, std::span<const Type> arguments) {
    const auto& word = formula_functions()[static_cast<size_t>(function)];
    if (std::find(arguments.begin(), arguments.end(), Type::Object) != arguments.end()) {
        return wrong(fmt::format("{} cannot take an object", word.name));
    }
    const bool real = std::any_of(arguments.begin(), arguments.end(), is_float);
    if (function <= Function::Clamp) return real ? Type::Float : Type::Int;
    return function <= Function::Round ? Type::Int : Type::Float;
}

Result<Type> type_of_sides(Type left, Type right) {
    if ((left == Type::Object) != (right == Type::Object)) {
        return wrong(
            "the sides of if are an object and something else; make both objects, or none");
    }
    return std::max(left, right);
}

}  // namespace vagus::plan
