// A project as it travels to a robot: its files and those that they name, each with its hash. The
// list also is beside the files on the robot, as deployed.json (docs/formats.md).
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace vagus::serve {

constexpr size_t kBundleFilesMax = 2000;
constexpr size_t kBundleBytesMax = 64u << 20;       // all files together
constexpr size_t kBundleFileBytesMax = 16u << 20;   // one file
constexpr size_t kBundlePartBytesMax = 512u << 10;  // of a file, in one message

struct BundleFile {
    std::string path;  // from the border, with / between folders
    size_t size = 0;
    std::string sha256;  // 64 hexadecimal digits
    bool operator==(const BundleFile&) const = default;
};

struct Bundle {
    std::string name = {};  // of the project
    // The folder of its vagus.json, from the border; empty: the border itself.
    std::string project = {};
    std::vector<BundleFile> files = {};
    double when_wall = 0;  // milliseconds since 1970
    uint32_t before = 0;   // the version that it came after
};

std::string sha256_of(std::string_view bytes);

// The bundle of a project and the folder that its paths count from.
struct CollectedBundle {
    Bundle bundle;
    std::filesystem::path root;
};
// The folder of a project with all that is in it, but for projects inside it and what begins with a
// dot, and what its files name elsewhere inside the border.
Result<CollectedBundle> collect_bundle(const std::string& project);

// Paths that lead nowhere else, sizes and numbers within the limits.
Status check_bundle(const Bundle& bundle);

nlohmann::json to_json(const Bundle& bundle);
// Checked. The Error says what is wrong.
Result<Bundle> bundle_from(const nlohmann::json& json);
Result<Bundle> read_bundle(const std::string& file);

}  // namespace vagus::serve
