// `.aesl` project files: the events and constants of a network and the script of each node
// (docs/spec/aesl-language.md, section 5.1).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "aesl/target.hpp"
#include "base/result.hpp"

namespace vagus::aesl {

struct Script {
    std::string node;      // name of the node it is for
    uint16_t node_id = 0;  // preferred among nodes of that name; 0 if the file has none
    std::string source;    // line 1 begins right behind the start tag
    int first_line = 1;    // line of the file on which the source's line 1 stands: for messages with FILE:LINE
    std::string plugins;   // `toolsPlugins` as XML, kept as it was
};

struct Project {
    CommonDefinitions common;
    std::vector<Script> scripts;
    std::string keywords;  // value of the keywords flag, empty if absent; kept, without meaning here
};

Result<Project> parse_project(std::string_view xml, std::string_view file);
std::string format_project(const Project& project);

// Index into `scripts` for a connected node: same name, same id preferred, else the first with the name that `used`
// does not mark; -1 if none. Marks what it gives.
int script_for(const Project& project, std::string_view node_name, uint16_t node_id, std::vector<bool>& used);

}  // namespace vagus::aesl
