// Where the work of a template of one's own goes: into a script that there is.
#pragma once

#include <string>

#include "base/result.hpp"
#include "serve/edit/own_template.hpp"
#include "serve/script/scripts.hpp"

namespace vagus::serve {

// The whole file of a script, and the line of the script where its author goes on.
struct OwnScript {
    std::string text;
    int line = 0;
};

// The events into the list of the file, the handlers into the script; both must compile. Nothing is
// written.
Result<OwnScript> own_script(const ScriptPart& part, const OwnTemplate& wanted, const Files& files,
                             Scripts& scripts);

}  // namespace vagus::serve
