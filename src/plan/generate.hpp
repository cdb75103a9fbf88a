// Plans as C++ that a person would have written (docs/plans.md, section 9): the code makes the plan
// with embed/plan_code.hpp and gives the same trace in virtual time.
#pragma once

#include <map>
#include <set>
#include <string>

#include "plan/check.hpp"
#include "plan/marked_text.hpp"

namespace vagus::plan {

// Toolboxes whose classes no installed package has.
using OwnToolboxes = std::set<std::string>;

// Files by name: NAME.hpp and NAME.cpp of each plan, main.cpp, CMakeLists.txt, and the classes of
// the toolboxes in `own` that the plans use. `checked` has no error.
std::map<std::string, std::string> generate(const Checked& checked, const OwnToolboxes& own = {});

// NAME.cpp of the outermost plan, with the lines that each of its elements has.
MarkedText generate_code(const Checked& checked, const OwnToolboxes& own = {});

}  // namespace vagus::plan
