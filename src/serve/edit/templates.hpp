// What a new file begins with: something that works at once.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vagus::serve {

// The node that new scripts are for.
struct NewNode {
    std::string name = "thymio-II";
    uint16_t id = 1;
    std::string args = "event.args";  // what it calls the arguments of events
};

// A name for plans, toolboxes and events, made of the name of a file: "my plan.plan.json" gives
// my_plan.
std::string name_of_file(std::string_view path);

std::string new_script(const NewNode& node);
std::string new_plan(std::string_view name);
std::string new_world(std::string_view name);
// A toolbox with one actor, and the script that does its work.
std::string new_toolbox(const std::string& name, const std::string& script, const NewNode& node);
std::string new_toolbox_script(const std::string& name, const NewNode& node);

}  // namespace vagus::serve
