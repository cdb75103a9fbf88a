// How a check ends when the node is not as the specification says: an Error whose code says which
// of three kinds it is.
//
//     return finding("expected 3, found 4");
//     return lacking("40 variables", "has 12 that are free");
//
// Any other Error comes from the line: it is broken, and the examination with it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "conformance/instructions.hpp"
#include "wire/frame.hpp"

namespace vagus::conformance {

constexpr Code kFinding = Code::BadInput;  // the node did something else
constexpr Code kLacking = Code::Limit;     // by its description the node cannot be asked that

inline Error finding(std::string what) {
    return {kFinding, std::move(what)};
}
inline Error lacking(const std::string& needed, const std::string& found) {
    return {kLacking, "needs " + needed + "; the node " + found};
}

// A frame for people: "ExecutionStateChanged 5 3", "NodeSpecificError 6 "text"", "event 7 (1, -2)".
std::string text_of(const wire::Frame& frame);
// What the flags of section 3.2 mean: "paused in an event (3)".
std::string text_of_flags(uint16_t flags);
std::string text_of(const Values& values);

}  // namespace vagus::conformance
