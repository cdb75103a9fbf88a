// What a page asks of a world by hand, as an order to the process of the run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

#include "serve/talk/orders.hpp"

namespace vagus::serve {

using HandOrder = std::variant<talk::MoveRobot, talk::MoveObject, talk::PutObject, talk::TakeObject,
                               talk::SwitchLight, talk::PressButton, talk::TapRobot>;

// `command`: world.move, world.put, world.take, world.press, world.tap or world.light of
// protocol.json, `in` what came with it and was checked; a move names a robot or an object.
HandOrder hand_order(const std::string& command, const nlohmann::json& in);

}  // namespace vagus::serve
