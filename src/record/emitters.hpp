// From where in a script an event can come: what the script says, for nobody has seen it run.
//
//     const Emitters from = emitters_of(script, project.common, "gone");
//     if (from.lines.size() == 1) tell("probably from here", *from.lines.begin());
#pragma once

#include <set>
#include <string>

#include "aesl/project.hpp"

namespace vagus::record {

// A part of a script: what is before the first handler, a handler, or a sub.
struct Section {
    enum class Kind { Init, Handler, Sub };
    Kind kind = Kind::Init;
    std::string name;
    int line = 1;
    auto operator<=>(const Section&) const = default;
};

struct Emitters {
    std::set<int> lines;         // of the script, that emit it
    std::set<Section> sections;  // handlers, or the beginning, from which one is reached
};

// Through its subs.
Emitters emitters_of(const aesl::Script& script, const aesl::CommonDefinitions& common,
                     const std::string& event);

}  // namespace vagus::record
