// Fixes of one edit each, with their labels.
#pragma once

#include <string>
#include <string_view>

#include "aesl/diagnostic.hpp"

namespace vagus::aesl {

// `Write "=="`: puts a text in the place of a range.
Fix replacing(Mark range, std::string text);

// `Insert "then"`: `text` may have white space around, which the label does not show.
Fix inserting(Position at, std::string text);

// `Delete ";"`: `shown` is what is there.
Fix deleting(Mark range, std::string_view shown);

// `Declare the event "found"`: in the project.
Fix declaring(std::string_view event, uint16_t words);

}  // namespace vagus::aesl
