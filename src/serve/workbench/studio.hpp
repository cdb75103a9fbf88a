// `vagus studio`: the server behind the studio's pages, from its first line of output to its end.
#pragma once

#include <functional>
#include <string>

#include "base/result.hpp"
#include "serve/broker/fleet_options.hpp"
#include "serve/web/shelf.hpp"
#include "serve/workbench/door.hpp"

namespace vagus::serve {

struct StudioOptions {
    std::string project = {};  // a path; empty: the start screen
    std::string example = {};  // or an example
    FleetOptions fleet = {};   // to look at
    ShelfOptions shelf = {};   // where its robots fetch another version
    DoorOptions door = {};
    std::string data = {}, config = {};  // folders; empty: the user's
};

// What the command line does for it.
struct StudioTalk {
    std::function<void(const std::string& line)> print;  // results: the address
    std::function<void(const std::string& line)> log;    // words for people
    // A file that leads a browser of this user to the studio, without the token on a command line.
    std::function<void(const std::string& file)> show;
};

// Serves until a signal comes. The Error says why it cannot begin.
Status run_studio(const StudioOptions& options, const StudioTalk& talk);

}  // namespace vagus::serve
