// A template of one's own, to be filled in: what is in the toolbox file, which events it needs,
// and what the script of the node gets. Unchanged it works, and does something harmless.
#pragma once

#include <string>
#include <vector>

#include "aesl/target.hpp"
#include "base/json.hpp"

namespace vagus::serve {

struct OwnTemplate {
    std::string name;  // Blink
    bool is_supervisor = false;
    std::string help;
    std::string node;                 // that does its work
    std::string args = "event.args";  // what that node calls the arguments of events
};

// "blink" of "Blink": the first part of its events and variables.
std::string stem_of(const OwnTemplate& of);
// To be declared, in this order.
std::vector<aesl::GlobalEvent> events_of(const OwnTemplate& of);
// The value of the member "templates": { "Blink": … } of a toolbox file.
JsonValue toolbox_entry(const OwnTemplate& of);
std::string new_toolbox_file(const std::string& toolbox, const std::string& script,
                             const OwnTemplate& of);

// The script with its variables before the first one that it has, its handlers behind everything.
struct FilledIn {
    std::string script;
    int line = 0;  // where its author goes on
};
FilledIn script_with(const std::string& script, const OwnTemplate& of);

}  // namespace vagus::serve
