// How values of plans become the words of events, and back.
#include <fmt/format.h>

#include <cmath>

#include "plan/value.hpp"
#include "toolbox/bus_template.hpp"

namespace vagus::toolbox {

using plan::Type;
using plan::Value;

namespace {

double number_of(const Value& value) {
    if (value.type() == Type::Bool) return value.boolean() ? 1 : 0;
    return value.type() == Type::Int ? static_cast<double>(value.integer()) : value.number();
}

// "distance is 50 cm"
std::string said(const plan::Input& input, double number) {
    return fmt::format("the input \"{}\" is {}{}{}", input.name, plan::text_of(number),
                       input.unit.empty() ? "" : " ", input.unit);
}

double lowest(int words) {
    return words == 1 ? INT16_MIN : INT32_MIN;
}
double highest(int words) {
    return words == 1 ? INT16_MAX : INT32_MAX;
}

}  // namespace

Status encode(const plan::Input& input, const BusValue& as, const Value& value,
              std::vector<int16_t>& words) {
    const double number = number_of(value);
    if (!plan::is_within(input, number)) {
        return Error{Code::BadInput,
                     fmt::format("{}, but must be {}", said(input, number), plan::range_of(input))};
    }
    const double scaled = std::round(number * as.scale);  // half away from zero
    if (!(scaled >= lowest(as.words) && scaled <= highest(as.words))) {
        return Error{Code::BadInput,
                     fmt::format("{}, which does not fit {} on the bus: from {} to {} does",
                                 said(input, number), as.words == 1 ? "one word" : "two words",
                                 plan::text_of(lowest(as.words) / as.scale),
                                 plan::text_of(highest(as.words) / as.scale))};
    }
    const auto bits = static_cast<uint32_t>(static_cast<int32_t>(scaled));
    words.push_back(static_cast<int16_t>(bits & 0xffff));
    if (as.words == 2) words.push_back(static_cast<int16_t>(bits >> 16));
    return Status::done();
}

Value decode(Type type, const BusValue& as, const int16_t* at) {
    int32_t whole = at[0];
    if (as.words == 2) {
        whole = static_cast<int32_t>(uint32_t{static_cast<uint16_t>(at[1])} << 16 |
                                     static_cast<uint16_t>(at[0]));
    }
    if (type == Type::Bool) return Value(whole != 0);
    const double number = static_cast<double>(whole) / as.scale;
    if (type == Type::Int) return Value(static_cast<int64_t>(std::round(number)));
    return Value(number);
}

}  // namespace vagus::toolbox
