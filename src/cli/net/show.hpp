// How `vagus net` prints: lines for people with aligned columns, JSON for programs
// (docs/formats.md, "Outputs").
#pragma once

#include <string>
#include <vector>

#include "cli/net/session.hpp"

namespace vagus::cli {

// With spaces behind it, `width` code points wide at least.
std::string padded(std::string text, size_t width);
size_t widest(const std::vector<std::string>& texts);

// One line a row, columns two spaces apart and as wide as their widest cell; the last is not
// padded.
std::string table(std::vector<std::vector<std::string>> rows);

// "[ … ]" with one element a line; elements are JSON.
std::string json_list(const std::vector<std::string>& elements);
std::string json_words(const std::vector<int16_t>& words);

// "1, 2, 5 to 9", of ascending ids.
std::string id_list(const std::vector<debug::NodeId>& ids);

// `list`: number, name, state, protocol, program.
std::string show_nodes(const NetSession& session, const std::vector<debug::NodeId>& ids);
std::string show_nodes_json(const NetSession& session, const std::vector<debug::NodeId>& ids);
std::string show_description(const debug::NodeView& node);

// "FILE:LINE" if the project has the script of the node, else "line N of its script", or "pc N"
// without a line.
std::string show_place(const NetSession& session, debug::NodeId id, const debug::CodePlace& at);

// A line of `log` and `watch`; empty for what is not shown there (answers to requests).
std::string show_event(const NetSession& session, const debug::Event& event);
std::string show_event_json(const NetSession& session, const debug::Event& event);

// "7 -8"
std::string spaced(const std::vector<int16_t>& words);
// "1 \"thymio-II\"": a node in a sentence.
std::string node_name(const NetSession& session, debug::NodeId id);

}  // namespace vagus::cli
