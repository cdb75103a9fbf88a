// From what a person types to what it means: a node, a range of words of a variable, an event.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "debug/network.hpp"

namespace vagus::debug {

constexpr size_t kNamesShownMax = 20;  // in an error sentence

// Among all nodes known; disconnected ones and those without a description have errors of their
// own.
Result<NodeId> find_node(const std::vector<const NodeView*>& nodes, std::string_view typed);

// Its id, if it is connected and has described itself; else the Error says what it lacks.
Result<NodeId> usable(const NodeView& node);

// "NAME", "NAME[3]", "NAME[2:5]" among the variables of the node and of its program.
Result<VariableRange> find_range(const NodeView& node, std::string_view typed);

// The number of the event and how many arguments it takes, if that is known.
struct EventShape {
    uint16_t number = 0;
    std::optional<uint16_t> size;
};
Result<EventShape> find_event(const aesl::CommonDefinitions& common, std::string_view typed);

// All variables with their places: those of the program if it is known, else those of the
// description.
std::vector<aesl::VariablePlace> variables_of(const NodeView& node);

}  // namespace vagus::debug
