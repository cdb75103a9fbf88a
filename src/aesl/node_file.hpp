// Node files (`--node`, `--describe`; docs/formats.md): a Target and the common definitions as JSON.
#pragma once

#include <string>
#include <string_view>

#include "aesl/target.hpp"
#include "base/result.hpp"

namespace vagus::aesl {

struct NodeFile {
    Target target;
    CommonDefinitions common;  // for scripts without a project; a project's own win
};

// `file` is the name for error sentences.
Result<NodeFile> parse_node_file(std::string_view text, std::string_view file);
// The saved form (docs/formats.md, "How our JSON files look when saved"), with a final newline.
std::string format_node_file(const NodeFile& node);

}  // namespace vagus::aesl
