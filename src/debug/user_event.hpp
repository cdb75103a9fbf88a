// What the frame of a user event says, with the names that all nodes share: decoded here, whoever
// hears it, records it or reads it in a recording.
#pragma once

#include <string>

#include "aesl/target.hpp"
#include "debug/event.hpp"
#include "wire/frame.hpp"

namespace vagus::debug {

// Of a frame for which wire::is_user_event(frame.type).
UserEvent user_event_of(const wire::Frame& frame, const aesl::CommonDefinitions& common);

// Its number, if none of the definitions is its.
std::string name_or_number(const UserEvent& event);

}  // namespace vagus::debug
