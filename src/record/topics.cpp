#include "record/topics.hpp"

#include <fmt/format.h>

namespace vagus::record {

namespace {

// Of the public schemas of Foxglove, what we write (https://docs.foxglove.dev, SceneUpdate).
constexpr std::string_view kSceneUpdate =
    R"({"title":"foxglove.SceneUpdate","type":"object","properties":{)"
    R"("deletions":{"type":"array","items":{"type":"object","properties":{)"
    R"("timestamp":{"type":"object","properties":{)"
    R"("sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
    R"("type":{"type":"integer"},"id":{"type":"string"}}}},)"
    R"("entities":{"type":"array","items":{"type":"object","properties":{)"
    R"("timestamp":{"type":"object","properties":{)"
    R"("sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
    R"("frame_id":{"type":"string"},"id":{"type":"string"},)"
    R"("lifetime":{"type":"object","properties":{)"
    R"("sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
    R"("frame_locked":{"type":"boolean"},"cubes":{"type":"array","items":{"type":"object"}},)"
    R"("cylinders":{"type":"array","items":{"type":"object"}}}}}}})";

// The same, CompressedImage: bytes are base64 in JSON.
constexpr std::string_view kCompressedImage =
    R"({"title":"foxglove.CompressedImage","type":"object","properties":{)"
    R"("timestamp":{"type":"object","properties":{)"
    R"("sec":{"type":"integer"},"nsec":{"type":"integer"}}},)"
    R"("frame_id":{"type":"string"},)"
    R"("data":{"type":"string","contentEncoding":"base64"},"format":{"type":"string"}}})";

constexpr std::string_view kAnyObject = R"({"type":"object"})";

}  // namespace

std::string stamp_json(Time at) {
    const int64_t us = at.count();
    return fmt::format(R"({{"sec":{},"nsec":{}}})", us / 1000000, us % 1000000 * 1000);
}

std::string_view schema_text(std::string_view name) {
    if (name == "foxglove.SceneUpdate") return kSceneUpdate;
    if (name == "foxglove.CompressedImage") return kCompressedImage;
    return kAnyObject;
}

}  // namespace vagus::record
