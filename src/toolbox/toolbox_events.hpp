// Whether a project knows the events that a toolbox file names, and lets them carry enough.
#pragma once

#include <string>
#include <vector>

#include "base/json_object.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::toolbox {

struct EventCheck {
    Place at;  // where the file names it
    std::string event;
    size_t words;    // that it carries, with its token
    bool sent;       // by the plan: then it carries as many as are declared
    std::string of;  // what names it, for sentences
};
using EventChecks = std::vector<EventCheck>;

void check_events(const EventChecks& checks, const std::string& project_path, Place project_at,
                  const ReadProject& read_project, Complaints& complaints);

}  // namespace vagus::toolbox
