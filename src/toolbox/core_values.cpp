#include "toolbox/core_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <compare>

#include "run/code.hpp"

namespace vagus::toolbox {

namespace {

constexpr double kSecondsMax = 1e12;

int64_t integer_of(const plan::Value& value) {
    return value.type() == plan::Type::Bool ? int64_t{value.boolean()} : value.integer();
}

bool is_whole(const plan::Value& value) {
    return value.type() == plan::Type::Bool || value.type() == plan::Type::Int;
}

double number_of(const plan::Value& value) {
    const Result<plan::Value> converted = plan::convert(value, plan::Type::Float);
    if (!converted.ok()) throw run::CodeError(converted.error().what);
    return converted.value().number();
}

std::partial_ordering order(const plan::Value& left, const plan::Value& right) {
    if (left.type() == plan::Type::String && right.type() == plan::Type::String) {
        return left.string().compare(right.string()) <=> 0;
    }
    if (is_whole(left) && is_whole(right)) return integer_of(left) <=> integer_of(right);
    return number_of(left) <=> number_of(right);
}

bool compare_objects(const plan::Value& left, std::string_view op, const plan::Value& right) {
    if (left.type() != right.type() || (op != "==" && op != "!=")) {
        throw run::CodeError("an object can only be compared with an object, by == or !=");
    }
    return (left.object() == right.object()) == (op == "==");
}

}  // namespace

Duration duration_of(double seconds) {
    if (seconds > kSecondsMax) return run::kNever;
    if (!(seconds > 0)) return Duration{0};
    return Duration{static_cast<int64_t>(std::round(seconds * 1e6))};
}

bool compare(const plan::Value& left, std::string_view op, const plan::Value& right) {
    const bool known =
        op == "==" || op == "!=" || op == "<" || op == "<=" || op == ">" || op == ">=";
    if (!known) {
        throw run::CodeError(fmt::format("the operator \"{}\" is not one of == != < <= > >=", op));
    }
    if (left.type() == plan::Type::Object || right.type() == plan::Type::Object) {
        return compare_objects(left, op, right);
    }
    const std::partial_ordering result = order(left, right);
    if (op == "==") return result == 0;
    if (op == "!=") return result != 0;
    if (op == "<") return result < 0;
    if (op == "<=") return result <= 0;
    return op == ">" ? result > 0 : result >= 0;
}

std::vector<int16_t> words_of(std::string_view text) {
    std::vector<int16_t> words;
    size_t at = 0;
    while ((at = text.find_first_not_of(' ', at)) != std::string_view::npos) {
        const size_t end = std::min(text.find(' ', at), text.size());
        const std::string_view word = text.substr(at, end - at);
        at = end;
        const std::string_view digits = word.substr(word.starts_with('-') ? 1 : 0);
        const bool plain =
            !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
        const auto value = plain ? plan::int_from_digits(word) : std::nullopt;
        if (!value || *value < INT16_MIN || *value > INT16_MAX) {
            throw run::CodeError(fmt::format(
                "\"{}\" is not an argument of an event: a whole number from -32768 to 32767",
                word));
        }
        if (words.size() == run::kEventArgumentsMax) {
            throw run::CodeError(fmt::format("more than {} arguments", run::kEventArgumentsMax));
        }
        words.push_back(static_cast<int16_t>(*value));
    }
    return words;
}

}  // namespace vagus::toolbox
