// Many robots in one line of a world file: columns and rows of copies of one robot.
//
//     { "name": "t", "type": "thymio2", "at": [0.3, 0.3], "grid": [6, 5], "spacing": 0.4 }
//
// are thirty robots, t1 to t30: t1 stands at [0.3, 0.3], t2 to the right of it, t7 above it.
//
// The rest of the program knows robots by their place in the whole list; the file has fewer
// entries. What is said about a robot names the entry.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "sim/definitions.hpp"

namespace vagus::sim {

struct RobotGrid {
    size_t columns = 1;
    size_t rows = 1;
    Point spacing = {};  // from middle to middle
};

// `first` itself and its copies, by rows. Names are numbered from 1; node ids follow each other
// unless each robot has a bus of its own.
std::vector<RobotDefinition> spread(const RobotDefinition& first, const RobotGrid& grid);

// The entry of the file that a robot of the whole list comes from; `robots` is that list of the
// file, which was read without an error.
size_t entry_of_robot(const JsonValue& robots, size_t robot);
// "robots[17].at" of the whole list as it is in the file: "robots[0].at". Other elements are as
// they were.
std::string element_of_file(const JsonValue& world, const std::string& element);

}  // namespace vagus::sim
