// The values of a plan's configuration: their types, their texts, and how one becomes another
// (docs/plans.md, rules P7, P10, P11).
//
//     convert(Value{2.5}, Type::Int);         // 3: half away from zero
//     text_of(Value{1e20});                   // "1e+20"
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/result.hpp"

namespace vagus::plan {

enum class Type : uint8_t { Bool, Int, Float, String, Object };

// The word of a type in plan files, and back.
std::string_view name_of(Type type);
std::optional<Type> type_named(std::string_view name);

// What only actors understand: a map, a picture. `tag` names its kind, for actors to recognise.
class ObjectData {
public:
    virtual ~ObjectData() = default;
    virtual std::string_view tag() const = 0;
};

// Shared by all variables, inputs and outputs that hold the same object; never changed once made.
using Object = std::shared_ptr<const ObjectData>;

class Value {
public:
    Value() : state_(false) {}
    explicit Value(bool value) : state_(value) {}
    explicit Value(int64_t value) : state_(value) {}
    explicit Value(double value) : state_(value) {}
    explicit Value(std::string value) : state_(std::move(value)) {}
    explicit Value(Object value) : state_(std::move(value)) {}
    Value(const char*) = delete;  // it would become a bool

    Type type() const { return static_cast<Type>(state_.index()); }
    bool boolean() const { return std::get<bool>(state_); }
    int64_t integer() const { return std::get<int64_t>(state_); }
    double number() const { return std::get<double>(state_); }
    const std::string& string() const { return std::get<std::string>(state_); }
    const Object& object() const { return std::get<Object>(state_); }

    friend bool operator==(const Value&, const Value&) = default;

private:
    std::variant<bool, int64_t, double, std::string, Object> state_;  // in the order of Type
};

// Bool counts as int (P9).
inline bool is_whole(const Value& value) {
    return value.type() == Type::Bool || value.type() == Type::Int;
}
inline int64_t whole_of(const Value& value) {
    return value.type() == Type::Bool ? int64_t{value.boolean()} : value.integer();
}

// What a variable without `initial` holds (P6).
Value default_of(Type type);

// The fewest digits that read back as the same number (P10): `0.1`, `30`, `-0`, `1e+20`.
std::string text_of(double number);
// As in a sentence: a text in quotes, "an object", a float of six digits. One that six digits would
// make a rounder number keeps all of its own, so that 29.9999999 is not read as 30.
std::string in_words(const Value& value);
// Any value but an object as text.
Result<std::string> text_of(const Value& value);

// The value as another type (P11). The Error's sentence says what does not fit; it names no place.
Result<Value> convert(const Value& value, Type type);

// A string as a float: an optional `-` and a number as in P8a, nothing around it.
Result<double> float_from_text(std::string_view text);

// How long the number at the start of `text` is (P8a: digits[.digits][e[sign]digits]); 0 if there
// is none. `whole` tells whether it is digits only.
struct NumberText {
    size_t length = 0;
    bool whole = false;
};
NumberText number_at(std::string_view text);
// The number as a double; empty if it is too large. One too small is 0.
std::optional<double> double_from_digits(std::string_view number);
// Digits, perhaps behind a `-`, as an int; empty if it does not fit 64 bits.
std::optional<int64_t> int_from_digits(std::string_view digits);

}  // namespace vagus::plan
