// Templates as C++ classes, so that code which makes a plan has their inputs, outputs, states and
// events as names that the compiler knows (docs/plans.md, section 9). Derived from what a template
// declares, nothing else.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "plan/check.hpp"

namespace vagus::plan {

// How C++ code writes the parts of one class.
struct CppClass {
    std::string name;
    std::map<std::string, std::string> inputs;    // a declared name to its C++ name
    std::map<std::string, std::string> outputs;   // likewise
    std::map<std::string, std::string> outcomes;  // likewise
};

// The C++ names of a toolbox: of itself, and of each template's class, in order.
std::string cpp_namespace(const Toolbox& toolbox);
std::vector<CppClass> cpp_classes(const Toolbox& toolbox);
// Of a sub-plan, as a class of that name.
CppClass cpp_class_of(const Plan& sub_plan, std::string name);

// The header of a toolbox, installed as vagus/templates/NAMESPACE.hpp.
std::string generate_toolbox_header(const Toolbox& toolbox);
// The class of a sub-plan, which the function `make` makes.
std::string generate_sub_plan_class(const Plan& sub_plan, const CppClass& names,
                                    std::string_view make);

}  // namespace vagus::plan
