// `vagus studio`: the server behind the studio's pages, from its first line of output to its end.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace vagus::serve {

constexpr uint16_t kStudioPort = 8910;  // if it is free; pages find their server again there

struct StudioOptions {
    std::string project = {};          // a path; empty: the start screen
    std::string example = {};          // or an example
    std::string listen = "127.0.0.1";  // an address of this computer
    int port = -1;                     // 0: a free one; -1: kStudioPort, or else a free one
    std::string token_file = {};       // of those who drive; made if it is not there
    std::string look_token_file = {};  // of those who only look; empty: nobody
    std::string tls_cert = {}, tls_key = {};
    std::vector<std::string> hosts = {};  // further names of this computer
    std::string data = {}, config = {};   // folders; empty: the user's
    std::string pages = {};               // folder; empty: those beside the program
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
