// Where plans and toolboxes name an event of the bus: so that they follow when it is renamed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "serve/edit/json_patch.hpp"

namespace vagus::serve {

struct EventName {
    std::string from, to;
};

// Steps that give the event its new name in a file of that kind ("plan", "toolbox"): the input
// `event` of Send, Receive and OnEvent, if its formula is a plain text; and the events by which the
// templates of a toolbox work. A text that cannot be read has none.
std::vector<JsonStep> renamed_event(std::string_view text, std::string_view kind,
                                    const EventName& name);

// Whether the toolbox file says that its events are those of this script file.
bool is_toolbox_of(const std::string& toolbox, std::string_view text, const std::string& script);

}  // namespace vagus::serve
