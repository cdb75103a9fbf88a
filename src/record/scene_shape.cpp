#include "record/scene_shape.hpp"

#include "base/trig.hpp"

namespace vagus::record {

namespace {

double number_in(const JsonValue* from, std::string_view key) {
    const JsonValue* const value = from != nullptr ? from->find(key) : nullptr;
    return value != nullptr ? value->number : 0;
}

}  // namespace

std::optional<SceneShape> scene_shape(const JsonValue& entity) {
    for (const std::string_view kind : {"cubes", "cylinders"}) {
        const JsonValue* const shapes = entity.find(kind);
        if (shapes == nullptr || shapes->items.empty()) continue;
        const JsonValue& shape = shapes->items.front();
        const JsonValue* const pose = shape.find("pose");
        if (pose == nullptr) continue;
        const JsonValue* const place = pose->find("position");
        const JsonValue* const way = pose->find("orientation");
        const JsonValue* const size = shape.find("size");
        return SceneShape{.round = kind == "cylinders",
                          .x = number_in(place, "x"),
                          .y = number_in(place, "y"),
                          .angle = 2 * trig::atan2(number_in(way, "z"), number_in(way, "w")),
                          .length = number_in(size, "x"),
                          .width = number_in(size, "y")};
    }
    return std::nullopt;
}

}  // namespace vagus::record
