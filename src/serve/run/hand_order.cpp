#include "serve/run/hand_order.hpp"

#include "serve/json.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <nlohmann/json.hpp>

namespace vagus::serve {

namespace {

talk::Point point_of(const Json& pair) {
    return {pair[0], pair[1]};
}

talk::Colour colour_of(const Json& list) {
    return {list[0], list[1], list[2]};
}

HandOrder move_of(const Json& in) {
    std::optional<double> angle;
    if (in.contains("angle")) angle = in["angle"].get<double>();
    if (in.contains("object")) return talk::MoveObject{0, in["object"], point_of(in["at"]), angle};
    return talk::MoveRobot{0, in["robot"], point_of(in["at"]), angle};
}

talk::ObjectKind object_kind_of(const std::string& word) {
    const auto& words = talk::Words<talk::ObjectKind>::kAll;
    const auto* const found = std::find(std::begin(words), std::end(words), word);
    assert(found != std::end(words));  // checked where it came in
    return static_cast<talk::ObjectKind>(found - std::begin(words));
}

talk::PutObject put_of(const Json& in) {
    talk::PutObject put;
    put.kind = object_kind_of(in["kind"]);
    put.at = point_of(in["at"]);
    put.angle = in.value("angle", put.angle);
    put.id = in.value("id", put.id);
    if (in.contains("size")) put.size = point_of(in["size"]);
    if (in.contains("radius")) put.radius = in["radius"].get<double>();
    if (in.contains("height")) put.height = in["height"].get<double>();
    if (in.contains("mass")) put.mass = in["mass"].get<double>();
    if (in.contains("colour")) put.colour = colour_of(in["colour"]);
    put.on = in.value("on", put.on);
    return put;
}

}  // namespace

HandOrder hand_order(const std::string& command, const Json& in) {
    if (command == "world.move") return move_of(in);
    if (command == "world.put") return put_of(in);
    if (command == "world.take") return talk::TakeObject{0, in["object"]};
    if (command == "world.light") return talk::SwitchLight{0, in["object"], in["on"]};
    if (command == "world.press") {
        return talk::PressButton{0, in["robot"], in["button"], in["down"]};
    }
    return talk::TapRobot{0, in["robot"]};
}

}  // namespace vagus::serve
