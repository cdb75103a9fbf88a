#include "plan/value.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "base/json.hpp"

namespace vagus::plan {

namespace {

constexpr std::array<std::string_view, 5> kTypeNames = {"bool", "int", "float", "string", "object"};

Error cannot(const std::string& what, Type type) {
    return Error{Code::BadInput, fmt::format("{} is not {} {}", what,
                                             type == Type::Int ? "an" : "a", name_of(type))};
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

size_t digits_at(std::string_view text, size_t from) {
    size_t end = from;
    while (end < text.size() && is_digit(text[end])) ++end;
    return end - from;
}

// 2^63 as a double: the first number beyond an int on either side.
constexpr double kIntLimit = 9223372036854775808.0;

Result<Value> int_from_float(double number) {
    const double rounded = std::round(number);  // half away from zero
    if (rounded >= -kIntLimit && rounded < kIntLimit) return Value(static_cast<int64_t>(rounded));
    return Error{Code::BadInput, fmt::format("{} does not fit an int of 64 bits", text_of(number))};
}

Result<Value> int_from_text(const std::string& text) {
    const std::string_view digits = std::string_view(text).substr(text.starts_with('-') ? 1 : 0);
    const NumberText number = number_at(digits);
    if (number.whole && number.length == digits.size()) {
        if (const auto exact = int_from_digits(text)) return Value(*exact);
        return Error{Code::BadInput, fmt::format("{} does not fit an int of 64 bits", text)};
    }
    return int_from_float(TRY(float_from_text(text)));
}

Result<Value> bool_from_text(const std::string& text) {
    if (text == "true" || text == "1") return Value(true);
    if (text == "false" || text == "0") return Value(false);
    return Error{Code::BadInput,
                 fmt::format("the text \"{}\" is not a bool: write true, false, 1 or 0", text)};
}

Result<Value> to_bool(const Value& value) {
    switch (value.type()) {
        case Type::Bool:
            return value;
        case Type::Int:
            return Value(value.integer() != 0);
        case Type::Float:
            return Value(value.number() != 0);
        case Type::String:
            return bool_from_text(value.string());
        case Type::Object:
            break;
    }
    return cannot("an object", Type::Bool);
}

Result<Value> to_int(const Value& value) {
    switch (value.type()) {
        case Type::Bool:
            return Value(int64_t{value.boolean()});
        case Type::Int:
            return value;
        case Type::Float:
            return int_from_float(value.number());
        case Type::String:
            return int_from_text(value.string());
        case Type::Object:
            break;
    }
    return cannot("an object", Type::Int);
}

Result<Value> to_float(const Value& value) {
    switch (value.type()) {
        case Type::Bool:
            return Value(value.boolean() ? 1.0 : 0.0);
        case Type::Int:
            return Value(static_cast<double>(value.integer()));
        case Type::Float:
            return value;
        case Type::String:
            return Value(TRY(float_from_text(value.string())));
        case Type::Object:
            break;
    }
    return cannot("an object", Type::Float);
}

}  // namespace

std::string_view name_of(Type type) {
    return kTypeNames[static_cast<size_t>(type)];
}

std::optional<Type> type_named(std::string_view name) {
    for (size_t i = 0; i < kTypeNames.size(); ++i) {
        if (kTypeNames[i] == name) return static_cast<Type>(i);
    }
    return std::nullopt;
}

Value default_of(Type type) {
    switch (type) {
        case Type::Bool:
            return Value(false);
        case Type::Int:
            return Value(int64_t{0});
        case Type::Float:
            return Value(0.0);
        case Type::String:
            return Value(std::string());
        case Type::Object:
            break;
    }
    return Value(Object());
}

std::string text_of(double number) {
    // Shortest digits in scientific form: d[.ddd]e±xx. The point is then moved by hand (P10).
    std::array<char, 40> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                   std::chars_format::scientific);
    const std::string_view form(buffer.data(), static_cast<size_t>(end.ptr - buffer.data()));
    const size_t e = form.find('e');
    if (e == std::string_view::npos) return std::string(form);  // inf, nan: no plan holds one
    int exponent = 0;
    std::from_chars(form.data() + e + (form[e + 1] == '+' ? 2 : 1), form.data() + form.size(),
                    exponent);
    if (number != 0 && (exponent < -4 || exponent >= 16)) return std::string(form);

    const bool negative = form.starts_with('-');
    std::string digits;
    for (const char c : form.substr(0, e)) {
        if (is_digit(c)) digits += c;
    }
    std::string plain;
    if (exponent < 0) {
        plain = "0." + std::string(static_cast<size_t>(-exponent - 1), '0') + digits;
    } else {
        const size_t whole = static_cast<size_t>(exponent) + 1;
        if (digits.size() < whole) digits.append(whole - digits.size(), '0');
        plain = digits.substr(0, whole);
        if (digits.size() > whole) plain += "." + digits.substr(whole);
    }
    return (negative ? "-" : "") + plain;
}

namespace {

// What arithmetic of doubles adds to a short number: 0.49000000000000005 is 0.49.
constexpr double kNoise = 1e-12;

double rounded_to(int digits, double number) {
    std::array<char, 40> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                   std::chars_format::scientific, digits - 1);
    double rounded = number;
    std::from_chars(buffer.data(), end.ptr, rounded);
    return rounded;
}

std::string in_six_digits(double number) {
    const double six = rounded_to(6, number);
    const bool rounder = six == rounded_to(5, number);
    const bool same = std::abs(six - number) <= kNoise * std::abs(number);
    return text_of(rounder && !same ? number : six);
}

}  // namespace

std::string in_words(const Value& value) {
    if (value.type() == Type::Float) return in_six_digits(value.number());
    if (value.type() == Type::String) return json_quote(value.string());
    const Result<std::string> text = text_of(value);
    return text.ok() ? text.value() : "an object";
}

Result<std::string> text_of(const Value& value) {
    switch (value.type()) {
        case Type::Bool:
            return std::string(value.boolean() ? "true" : "false");
        case Type::Int:
            return std::to_string(value.integer());
        case Type::Float:
            return text_of(value.number());
        case Type::String:
            return value.string();
        case Type::Object:
            break;
    }
    return cannot("an object", Type::String);
}

Result<Value> convert(const Value& value, Type type) {
    switch (type) {
        case Type::Bool:
            return to_bool(value);
        case Type::Int:
            return to_int(value);
        case Type::Float:
            return to_float(value);
        case Type::String:
            return Value(TRY(text_of(value)));
        case Type::Object:
            break;
    }
    if (value.type() == Type::Object) return value;
    return cannot(fmt::format("a {}", name_of(value.type())), Type::Object);
}

Result<double> float_from_text(std::string_view text) {
    const bool negative = text.starts_with('-');
    const std::string_view digits = text.substr(negative ? 1 : 0);
    const NumberText number = number_at(digits);
    if (number.length == 0 || number.length != digits.size()) {
        return Error{Code::BadInput, fmt::format("the text \"{}\" is not a number", text)};
    }
    const auto magnitude = double_from_digits(digits);
    if (!magnitude) {
        return Error{Code::BadInput, fmt::format("the number {} is too large for a float", text)};
    }
    return negative ? -*magnitude : *magnitude;
}

NumberText number_at(std::string_view text) {
    size_t length = digits_at(text, 0);
    if (length == 0) return {};
    NumberText number{.length = length, .whole = true};
    if (length < text.size() && text[length] == '.') {
        const size_t fraction = digits_at(text, length + 1);
        if (fraction == 0) return number;
        length += 1 + fraction;
        number = {.length = length, .whole = false};
    }
    if (length < text.size() && (text[length] == 'e' || text[length] == 'E')) {
        size_t at = length + 1;
        if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
        const size_t exponent = digits_at(text, at);
        if (exponent > 0) number = {.length = at + exponent, .whole = false};
    }
    return number;
}

std::optional<double> double_from_digits(std::string_view number) {
    double value = 0;
    const auto read = std::from_chars(number.data(), number.data() + number.size(), value);
    if (read.ec == std::errc()) return value;
    // Out of range: too large, or so small that it is 0. The sign of the decimal exponent of the
    // first digit that is not 0 tells which.
    const size_t e = number.find_first_of("eE");
    const std::string_view digits = number.substr(0, e);
    const size_t first = digits.find_first_of("123456789");
    if (first == std::string_view::npos) return 0.0;
    const size_t point = std::min(digits.find('.'), digits.size());
    const double magnitude =
        first < point ? static_cast<double>(point - first) : -static_cast<double>(first - point);
    double exponent = 0;
    if (e != std::string_view::npos) {
        const bool negative = number[e + 1] == '-';
        const size_t skip = e + (is_digit(number[e + 1]) ? 1 : 2);
        for (const char c : number.substr(skip)) exponent = exponent * 10 + (c - '0');
        if (negative) exponent = -exponent;
    }
    if (magnitude + exponent < 0) return 0.0;
    return std::nullopt;
}

std::optional<int64_t> int_from_digits(std::string_view digits) {
    int64_t value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (read.ec != std::errc() || read.ptr != digits.data() + digits.size()) return std::nullopt;
    return value;
}

}  // namespace vagus::plan
