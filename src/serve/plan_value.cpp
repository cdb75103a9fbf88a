#include "serve/plan_value.hpp"

#include "serve/json.hpp"

#include <nlohmann/json.hpp>

namespace vagus::serve {

Json json_of(const plan::Value& value) {
    switch (value.type()) {
        case plan::Type::Bool:
            return value.boolean();
        case plan::Type::Int:
            return value.integer();
        case plan::Type::Float:
            return value.number();
        case plan::Type::String:
            return value.string();
        case plan::Type::Object:
            break;
    }
    return nullptr;
}

plan::Value plan_value(const Json& json) {
    if (json.is_boolean()) return plan::Value(json.get<bool>());
    if (json.is_number_integer()) return plan::Value(json.get<int64_t>());
    if (json.is_number()) return plan::Value(json.get<double>());
    if (json.is_string()) return plan::Value(json.get<std::string>());
    return plan::Value(plan::Object{});
}

}  // namespace vagus::serve
