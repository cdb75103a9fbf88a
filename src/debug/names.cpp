#include "debug/names.hpp"

#include <charconv>

#include "base/nearest.hpp"

namespace vagus::debug {
namespace {

// The number that `text` is as a whole, at most `most`.
std::optional<uint16_t> number_in(std::string_view text, uint16_t most) {
    uint16_t value = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc() || end != text.data() + text.size() || value > most) {
        return std::nullopt;
    }
    return value;
}

std::string quoted(std::string_view text) {
    return "\"" + std::string(text) + "\"";
}

// "a, b, c" or "a, b and 12 more".
std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (size_t i = 0; i < names.size() && i < kNamesShownMax; i++) {
        text += (i > 0 ? ", " : "") + names[i];
    }
    if (names.size() <= kNamesShownMax) return text;
    return text + " and " + std::to_string(names.size() - kNamesShownMax) + " more";
}

std::string guess(std::string_view typed, const std::vector<std::string>& names) {
    const std::string near = nearest(typed, names);
    return near.empty() ? "" : "; did you mean " + near + "?";
}

Error no_such_node(const std::vector<const NodeView*>& nodes, std::string_view typed) {
    std::vector<std::string> names, lines;
    for (const NodeView* node : nodes) {
        if (!node->connected || !node->described) continue;
        names.push_back(node->name);
        lines.push_back(std::to_string(node->id) + " " + node->name);
    }
    const std::string sentence = "there is no node " + quoted(typed);
    if (lines.empty()) return {Code::NotFound, sentence + ": no node answers on this network"};
    return {Code::NotFound, sentence + guess(typed, names) +
                                (nearest(typed, names).empty() ? "; the nodes" : " The nodes") +
                                " are: " + listed(lines)};
}

}  // namespace

Result<NodeId> usable(const NodeView& node) {
    const std::string who = "node " + std::to_string(node.id);
    if (!node.connected) {
        return Error{Code::Unavailable, who + " " + quoted(node.name) + " is disconnected"};
    }
    if (!node.described) {
        return Error{Code::Unavailable, who + " has not described itself yet"};
    }
    return node.id;
}

Result<NodeId> find_node(const std::vector<const NodeView*>& nodes, std::string_view typed) {
    const std::optional<uint16_t> id = number_in(typed, wire::kInvalidId - 1);
    std::vector<std::string> same;
    const NodeView* found = nullptr;
    for (const NodeView* node : nodes) {
        if (id && node->id == *id) return usable(*node);
        if (node->name != typed || !node->described) continue;
        if (found == nullptr || (node->connected && !found->connected)) found = node;
        if (node->connected) same.push_back(std::to_string(node->id));
    }
    if (found == nullptr) return no_such_node(nodes, typed);
    if (same.size() <= 1) return usable(*found);
    return Error{Code::BadInput, std::to_string(same.size()) + " nodes are named " + quoted(typed) +
                                     ": name the one that is meant by its number (" + listed(same) +
                                     ")"};
}

std::vector<aesl::VariablePlace> variables_of(const NodeView& node) {
    if (node.program) return node.program->variables;
    std::vector<aesl::VariablePlace> places;
    uint16_t address = 0;
    for (const aesl::NamedVariable& variable : node.target->variables) {
        places.push_back({variable.name, address, variable.size});
        address = static_cast<uint16_t>(address + variable.size);
    }
    return places;
}

namespace {

struct Span {
    uint16_t first = 0, last = 0;
};

// What is in the brackets: "3" or "2:5".
std::optional<Span> span_in(std::string_view text) {
    const size_t colon = text.find(':');
    const auto first = number_in(text.substr(0, colon), 0xffff);
    const auto last = colon == text.npos ? first : number_in(text.substr(colon + 1), 0xffff);
    if (!first || !last || *last < *first) return std::nullopt;
    return Span{*first, *last};
}

Result<VariableRange> range_in(const aesl::VariablePlace& place, std::string_view brackets) {
    const std::string words =
        place.name + " has " + std::to_string(place.size) + (place.size == 1 ? " word" : " words");
    if (place.size == 0) return Error{Code::BadInput, words + ": there is nothing in it"};
    if (brackets.empty()) return VariableRange{place.name, place.address, 0, place.size};
    const std::optional<Span> span = span_in(brackets.substr(1, brackets.size() - 2));
    if (!span || brackets.back() != ']') {
        return Error{Code::BadInput, quoted(place.name + std::string(brackets)) +
                                         ": after the name comes [INDEX] or [FIRST:LAST]"};
    }
    if (span->last >= place.size) {
        return Error{Code::BadInput, words + ", numbered from 0: there is no " +
                                         quoted(place.name + std::string(brackets))};
    }
    return VariableRange{place.name, static_cast<uint16_t>(place.address + span->first),
                         span->first, static_cast<uint16_t>(span->last - span->first + 1)};
}

}  // namespace

Result<VariableRange> find_range(const NodeView& node, std::string_view typed) {
    const std::string_view name = typed.substr(0, typed.find('['));
    std::vector<std::string> names;
    for (const aesl::VariablePlace& place : variables_of(node)) {
        if (place.name == name) return range_in(place, typed.substr(name.size()));
        names.push_back(place.name);
    }
    const std::string script = node.program ? "" : "; those of its script need its project";
    return Error{Code::NotFound, "node " + std::to_string(node.id) + " " + quoted(node.name) +
                                     " has no variable " + quoted(name) +
                                     (nearest(name, names).empty() ? script : guess(name, names))};
}

Result<EventShape> find_event(const aesl::CommonDefinitions& common, std::string_view typed) {
    std::vector<std::string> names;
    for (size_t i = 0; i < common.events.size(); i++) {
        if (common.events[i].name == typed) {
            return EventShape{static_cast<uint16_t>(i), common.events[i].size};
        }
        names.push_back(common.events[i].name);
    }
    if (const auto number = number_in(typed, 0x7fff)) {
        const bool known = *number < common.events.size();
        return EventShape{*number, known ? common.events[*number].size : std::nullopt};
    }
    const std::string sentence = "there is no event " + quoted(typed);
    if (names.empty()) {
        return Error{Code::NotFound, sentence +
                                         ": names of events are known only with their "
                                         "project; a number works without"};
    }
    if (!nearest(typed, names).empty())
        return Error{Code::NotFound, sentence + guess(typed, names)};
    return Error{Code::NotFound, sentence + "; the events are: " + listed(names)};
}

}  // namespace vagus::debug
