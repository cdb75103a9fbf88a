// Small things that outlive the server, in one JSON file: settings of a user, breakpoints and
// layouts of a project. Written atomically at each change.
//
//     Kept kept("/home/me/.config/vagus/settings.json", 1 << 20);
//     kept.put("theme", "dark");
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/result.hpp"

namespace vagus::serve {

constexpr size_t kKeptBytesMax = 1u << 20;

class Kept {
public:
    Kept() = default;  // kept in memory only
    // Reads the file if there is one; what is no JSON object counts as empty.
    explicit Kept(std::string file);

    const nlohmann::json& values() const { return values_; }
    // The value of a key, or null.
    nlohmann::json get(const std::string& key) const;
    // null takes the key away. The Error says why it cannot be kept; it counts all the same until
    // the server ends.
    Status put(const std::string& key, nlohmann::json value);

private:
    std::string file_;
    nlohmann::json values_ = nlohmann::json::object();
};

}  // namespace vagus::serve
