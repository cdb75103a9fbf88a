// The toolboxes that every program has: `core`, `drive`, `carbot`.
//
//     toolbox::Parts parts;                   // filled in when bus and robot are known
//     run::CodeLibrary library;
//     toolbox::add_builtin(library, parts);
#pragma once

#include <string_view>

#include "run/code.hpp"
#include "toolbox/parts.hpp"
#include "toolbox/safe_stop.hpp"

namespace vagus::toolbox {

// The parts are borrowed as long as the library lives.
void add_builtin(run::CodeLibrary& library, const Parts& parts);

// Whether the toolbox of that name is one of them.
bool is_builtin(std::string_view toolbox);

// Driving on every robot whose nodes know the events of `drive`.
void add_drive(run::CodeLibrary& library, const Parts& parts);
// All that Carbot can do: the templates of `drive`, and its own.
void add_carbot(run::CodeLibrary& library, const Parts& parts);

// The safe stop of robots that everybody has, and what the built-in toolbox files say.
SafeStop builtin_safe_stop();

// The texts of the files that are built in.
extern const std::string_view kDriveText;
extern const std::string_view kCarbotText;
extern const std::string_view kRobotsText;  // robots.safe_stop.json

}  // namespace vagus::toolbox
