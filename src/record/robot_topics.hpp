// Channels of a recording in which robots have projects of their own: whose they are.
//
//     const RobotNames robots = {"r1", "r4"};
//     robot_of("/robot/r4/plan/trace", robots);  // "r4"
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace vagus::record {

using RobotNames = std::set<std::string, std::less<>>;

// Whose topic it is of those robots, whose names may have any letters, of two that fit the longer
// one; empty: nobody's.
std::string robot_of(std::string_view topic, const RobotNames& robots);
// The topic as a recording of that robot alone has it: "/plan/trace". Of nobody: as it is.
std::string_view below_robot(std::string_view topic, std::string_view robot);

}  // namespace vagus::record
