#include "plan/compare.hpp"

#include <fmt/format.h>

#include <compare>

namespace vagus::plan {

namespace {

Result<std::partial_ordering> order(const Value& left, const Value& right) {
    if (left.type() == Type::String && right.type() == Type::String) {
        return std::partial_ordering(left.string().compare(right.string()) <=> 0);
    }
    if (is_whole(left) && is_whole(right)) {
        return std::partial_ordering(whole_of(left) <=> whole_of(right));
    }
    const Value left_number = TRY(convert(left, Type::Float));
    const Value right_number = TRY(convert(right, Type::Float));
    return left_number.number() <=> right_number.number();
}

Result<bool> compare_objects(const Value& left, std::string_view op, const Value& right) {
    if (left.type() != right.type() || (op != "==" && op != "!=")) {
        return Error{Code::BadInput, "an object can only be compared with an object, by == or !="};
    }
    return (left.object() == right.object()) == (op == "==");
}

}  // namespace

Result<bool> compare(const Value& left, std::string_view op, const Value& right) {
    const bool known =
        op == "==" || op == "!=" || op == "<" || op == "<=" || op == ">" || op == ">=";
    if (!known) {
        return Error{Code::BadInput,
                     fmt::format("the operator \"{}\" is not one of == != < <= > >=", op)};
    }
    if (left.type() == Type::Object || right.type() == Type::Object) {
        return compare_objects(left, op, right);
    }
    const std::partial_ordering result = TRY(order(left, right));
    if (op == "==") return result == 0;
    if (op == "!=") return result != 0;
    if (op == "<") return result < 0;
    if (op == "<=") return result <= 0;
    return op == ">" ? result > 0 : result >= 0;
}

}  // namespace vagus::plan
