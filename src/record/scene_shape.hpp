// What a recording says of one thing in the world: an entity of foxglove.SceneUpdate, as the
// recorder writes it, seen from above.
//
//     if (const auto shape = scene_shape(entity)) draw(shape->x, shape->y);
#pragma once

#include <optional>

#include "base/json.hpp"

namespace vagus::record {

struct SceneShape {
    bool round = false;
    double x = 0, y = 0, angle = 0;  // m, rad
    double length = 0, width = 0;    // of a disc its diameter
};

// Nothing: it has no place.
std::optional<SceneShape> scene_shape(const JsonValue& entity);

}  // namespace vagus::record
