// What `vagus switch` says about frames and losses: pure text, so that it can be tested.
#pragma once

#include <string>

#include "base/time.hpp"
#include "hub/hub.hpp"
#include "net/target.hpp"
#include "wire/frame.hpp"

namespace vagus::cli {

// One line for -v, with a final newline: seconds, source, name, and what it carries: the arguments
// of a user event in decimal, the bytes of everything else in hex.
//
//     0.001204 1 event 4: 5 -8
//     0.001377 1 NodePresent: 05 00
std::string frame_line(Time at, const wire::Frame& frame);

// "tcp:…: too slow: 2048 user events and 0 other messages lost so far"
std::string loss_sentence(const std::string& link, const hub::Dropped& dropped);

// Would a connection to `target` end at our own `listening` place? Then every frame would go round
// without end.
bool is_ourselves(const net::Target& target, const net::Target& listening);

}  // namespace vagus::cli
