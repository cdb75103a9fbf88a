// Changes of a JSON file by its members (doc.patch). A text in the saved form stays in it; of any
// other text only the members concerned change. All steps are done, or none.
//
//     auto steps = read_steps(in["steps"]);
//     auto text = patched(before, {"plan", "WallFollow.plan.json"}, steps.value());
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/json.hpp"
#include "base/result.hpp"

namespace vagus::serve {

struct JsonStep {
    enum class Do { Set, Remove, Insert, Move };
    using Key = std::variant<std::string, size_t>;
    Do what = Do::Set;
    std::vector<Key> at;   // the last one is meant; empty: the whole
    JsonValue value = {};  // Set, Insert
    size_t to = 0;         // Move
};

struct PatchedFile {
    std::string_view language;  // as in the protocol, or "project"
    std::string_view path;
};

// [JsonStep; 1000] of the protocol, checked by it.
Result<std::vector<JsonStep>> read_steps(const nlohmann::json& steps);

Result<std::string> patched(std::string_view text, const PatchedFile& file,
                            const std::vector<JsonStep>& steps);

}  // namespace vagus::serve
