// `.aesl` project files: the events and constants of a network and the script of each node
// (docs/spec/aesl-language.md, section 5.1).
//
//     const Result<Project> project = parse_project(TRY(read_file(path)), path);
//     for (const Script& script : project.value().scripts)
//         compile(script.source, target_of(script.node), project.value().common, {});
//
// Reading is strict: what other tools take for 0 or drop is an Error here, with line, column and
// fix. Children may come in any order. What has no meaning here (editor state, elements of other
// tools) is kept and written again; only XML comments and the layout between elements are not.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/target.hpp"
#include "base/result.hpp"

namespace vagus::aesl {

constexpr size_t kProjectBytesMax = 8u << 20;
// Elements inside each other; editor state is the only thing that nests.
constexpr size_t kProjectDepthMax = 100;

struct Script {
    std::string node;      // name of the node it is for
    uint16_t node_id = 0;  // preferred among nodes of that name; 0 if the file has none
    std::string uuid;      // instead of a number, in files of the later fork (appendix B)
    std::string source;    // line 1 begins right behind the start tag
    int first_line = 1;    // line of the file with the source's line 1: for messages with FILE:LINE
    std::string plugins;   // `toolsPlugins` and other elements, as XML, kept as they were
};

struct Project {
    CommonDefinitions common;
    std::vector<Script> scripts;
    std::string keywords;  // value of the keywords flag, empty if absent; without meaning here
    std::string others;    // elements that are not known here, as XML, one a line
};

// `file` is the name for error sentences.
Result<Project> parse_project(std::string_view xml, std::string_view file);

// The layout of the classic tools, some of which read the children strictly in this order: events,
// constants, keywords, nodes.
std::string format_project(const Project& project);

// A node that is there, as it calls itself.
struct NodeName {
    std::string_view name;
    uint16_t id = 0;
};
// Indices into `scripts`, one for each of the nodes; -1 where no script has the node's name. A node
// whose name and id are those of a script gets that one. Each other gets the first of its name that
// no node has yet, and, when all are given away, the first of its name: thirty robots of one name
// all get the one script that there is for it.
std::vector<int> scripts_for(const Project& project, std::span<const NodeName> nodes);

}  // namespace vagus::aesl
