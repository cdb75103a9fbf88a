// Programs of the machine that this one starts.
#pragma once

#include <optional>
#include <string>

namespace vagus::cli {

// Where the program of that name is: in a folder of PATH, or in /usr/sbin, which PATH often lacks
// and where brokers are installed.
std::optional<std::string> find_program(const std::string& name);

}  // namespace vagus::cli
