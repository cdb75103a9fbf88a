// Reads `NAME.toolbox.json` (docs/formats.md, "Toolbox file"): templates whose work is done by
// scripts on nodes.
//
//     Result<ToolboxFile> file = read_toolbox(text, "carbot.toolbox.json", {});
//
// The Error names file, line, column and element, what was expected and found, and how to fix it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "toolbox/bus_template.hpp"

namespace vagus::toolbox {

constexpr size_t kToolboxBytesMax = 1u << 20;
constexpr size_t kTemplatesMax = 256;  // of a file
constexpr size_t kOutcomesMax = 64;    // states or events of a template
constexpr size_t kOutputsMax = 64;     // of a template, over all of its states or events
constexpr size_t kNodeNamesMax = 8;    // of a template
constexpr size_t kNameBytesMax = 100;  // of templates, inputs, nodes, events …

// The events of a project: how many arguments each declares, if it does.
using ProjectEvents = std::map<std::string, std::optional<size_t>, std::less<>>;
using ReadProject = std::function<Result<ProjectEvents>(const std::string& path)>;

// `file` is the path, for errors; the project that it names is looked for beside it. Without
// `read_project` nobody looks whether the project knows the events.
Result<ToolboxFile> read_toolbox(std::string_view text, const std::string& file,
                                 const ReadProject& read_project);

// Everything that keeps the text from being read, in the order of the file: the first is the Error
// of read_toolbox(). Empty: it can be read.
std::vector<Error> mistakes_of_toolbox(std::string_view text, const std::string& file,
                                       const ReadProject& read_project);

}  // namespace vagus::toolbox
