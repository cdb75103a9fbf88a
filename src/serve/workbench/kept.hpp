// Small things that outlive the server, in one JSON file: settings of a user, breakpoints and
// layouts of a project. Written atomically at each change.
//
//     Kept kept("/home/me/.config/vagus/settings.json");
//     kept.put("theme", "dark");
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/result.hpp"
#include "serve/project/disk_sync.hpp"

namespace vagus::serve {

constexpr size_t kKeptBytesMax = 1u << 20;
constexpr size_t kKeptDepthMax = 64;  // of brackets; what nests deeper was not written by us

class Kept {
public:
    Kept() = default;  // kept in memory only
    // Reads the file if there is one; what is no JSON object counts as empty. `disk`, if there is
    // one, is borrowed, and waits for the disk.
    explicit Kept(std::string file, DiskSync* disk = nullptr);

    const nlohmann::json& values() const { return values_; }
    // The value of a key, or null.
    nlohmann::json get(const std::string& key) const;
    // The same if it is an object, or else an empty one.
    nlohmann::json object(const std::string& key) const;
    // null takes the key away. The Error says why it cannot be kept; it counts all the same until
    // the server ends.
    Status put(const std::string& key, nlohmann::json value);

private:
    std::string file_;
    DiskSync* disk_ = nullptr;
    nlohmann::json values_ = nlohmann::json::object();
};

}  // namespace vagus::serve
