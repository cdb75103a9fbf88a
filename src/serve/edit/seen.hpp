// What a client has seen of the texts that a command will change: script.rename, text.replace and
// others change many at once, and are done only if nobody has changed one of them meanwhile.
#pragma once

#include <string>

#include "serve/project/files.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

// Whether the texts that `seen` of the call names are as it says; fails the call if one is not.
bool seen_all(const Call& call, Files& files, const std::string& epoch);

}  // namespace vagus::serve
