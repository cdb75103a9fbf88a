#include "aesl/fix.hpp"

#include <algorithm>
#include <utility>

namespace vagus::aesl {
namespace {

// For a label: without white space around.
std::string quoted(std::string_view text) {
    constexpr std::string_view kBlanks = " \n";
    const size_t from = std::min(text.find_first_not_of(kBlanks), text.size());
    const size_t to = text.find_last_not_of(kBlanks) + 1;
    return "\"" + std::string(text.substr(from, to - from)) + "\"";
}

}  // namespace

Fix replacing(Mark range, std::string text) {
    return {.label = "Write " + quoted(text), .edits = {{range, std::move(text)}}};
}

Fix inserting(Position at, std::string text) {
    return {.label = "Insert " + quoted(text), .edits = {{{at, at}, std::move(text)}}};
}

Fix deleting(Mark range, std::string_view shown) {
    return {.label = "Delete " + quoted(shown), .edits = {{range, ""}}};
}

Fix declaring(std::string_view event, uint16_t words) {
    return {.label = "Declare the event " + quoted(event),
            .edits = {},
            .declares = GlobalEvent{std::string(event), words}};
}

}  // namespace vagus::aesl
