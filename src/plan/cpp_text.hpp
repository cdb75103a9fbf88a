// Names and texts of a plan as C++ source: an actor may be called `while`, and a text may hold
// anything.
//
//     CppNames names({"plan"});
//     names.give("while");    // while_
//     names.give("plan");     // plan_, for `plan` is taken
#pragma once

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>

namespace vagus::plan {

// Gives C++ names that differ from one another, from keywords, and from what the headers of C and
// C++ take for themselves.
class CppNames {
public:
    CppNames(std::initializer_list<std::string_view> taken);
    void take(std::string name) { taken_.insert(std::move(name)); }
    // `name` as it is, if it can be; else with `_`, and a number if need be.
    std::string give(std::string_view name);

private:
    std::set<std::string, std::less<>> taken_;
};

// An expression of the type const char* or std::string with exactly these bytes.
std::string cpp_string(std::string_view text);

}  // namespace vagus::plan
