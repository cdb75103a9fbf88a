// The words of `vagus plan debug`: what it prints, and how a command line is read.
#pragma once

#include <string>
#include <string_view>

#include "run/debugger.hpp"
#include "sim/world.hpp"

namespace vagus::cli {

// The next word of `rest`, which then begins behind it; empty at the end. Spaces part words, but
// not inside of quotes.
std::string take_word(std::string_view& rest);

// What follows `break`: [in PLAN] actor NAME | state ACTOR [STATE] | event SUPERVISOR [EVENT] |
// when CONDITION, then [count N] [if CONDITION].
Result<run::Breakpoint> parse_breakpoint(std::string_view text);

// What follows `held`: go [N | all] | step [N] | drop N | drop all.
Result<run::Request> parse_held(std::string_view text);

std::string text_of(const run::Breakpoint& breakpoint);
std::string value_text(const plan::Value& value);
std::string text_of(const run::Stopped& stopped);
std::string text_of(const run::RunOver& over);
std::string text_of(const run::Where& where);
std::string text_of(const run::HeldNow& held);
// "carbot is at 1.20, 0.50 m, 90 deg"
std::string text_of(const sim::RobotView& robot);
// "name = value (type)", one a line.
std::string variables_of(const run::LevelNow& level);

}  // namespace vagus::cli
