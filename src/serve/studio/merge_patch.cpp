#include "serve/studio/merge_patch.hpp"

#include "serve/json.hpp"

#include <nlohmann/json.hpp>

namespace vagus::serve {

Json merge_patch(const Json& from, const Json& to) {
    Json patch = Json::object();
    for (const auto& [key, value] : from.items()) {
        if (!to.contains(key)) patch[key] = nullptr;
    }
    for (const auto& [key, value] : to.items()) {
        const auto before = from.find(key);
        if (before == from.end()) {
            patch[key] = value;
        } else if (*before != value) {
            const bool both = before->is_object() && value.is_object();
            patch[key] = both ? merge_patch(*before, value) : value;
        }
    }
    return patch;
}

}  // namespace vagus::serve
