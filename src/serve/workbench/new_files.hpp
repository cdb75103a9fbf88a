// The files of a new project: what a person finds who has just made one, ready to run.
#pragma once

#include <string>
#include <vector>

namespace vagus::serve {

struct NewFile {
    std::string path;
    std::string text;
};

// `robot`: thymio2, epuck or carbot. `examples`: where the scripts of Carbot's nodes are taken
// from.
std::vector<NewFile> new_project_files(const std::string& name, const std::string& robot, bool plan,
                                       const std::string& examples);
// A room with one robot that has that script.
std::string new_room(const std::string& name, const std::string& robot, const std::string& script);
// The scripts of a robot's nodes; with `plan` those that obey a plan's driving commands.
std::string new_scripts(const std::string& robot, bool plan, const std::string& examples);
// An .aesl file without a script.
std::string new_scripts_file();
// A project for the nodes of a target, whatever they are.
std::vector<NewFile> robot_project_files(const std::string& target);

}  // namespace vagus::serve
