// What an examination found, as text: a line for each row, a last line that counts, JSON.
//
//     passed   opcodes      Stop ends the event  (3.4)
//     failed   natives      math.dot             (4.2)
//                           expected 22592, found 0
//     104 passed, 1 failed, 3 skipped: node 3 "rover"
#pragma once

#include <string>

#include "conformance/examine.hpp"

namespace vagus::conformance {

// With a newline at the end.
std::string row_text(const Row& row);
std::string summary_text(const Report& report);
// One object: node, name, the counts, and "checks", a list of objects with group, check, section,
// result and what was found.
std::string report_json(const Report& report);

}  // namespace vagus::conformance
