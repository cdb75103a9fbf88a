// A run of the studio that becomes a test (trial/kept_run.hpp), by a process of its own: the test
// is run once, as fast as that goes.
//
//     vagus keep-host      (not for people: the studio starts it)
//
//     pipe.send(kKeepAsked, R"({"file":"/p/run-3.mcap","test":"/p/P.test.json"})");
//     // answers {"text":"{\n  \"format\": …","differs":true}, or {"error":"…"}
#pragma once

#include <string>

#include "serve/process.hpp"

namespace vagus::serve {

constexpr char kKeepAsked = 1;  // kinds of packets
constexpr char kKeepAnswered = 2;

// The answer to one; empty: it is no question.
std::string answer_keep(const std::string& question);

// Answers one, and ends. The exit status: 0, or 2 for what is no question.
int run_keep(Pipe pipe);

}  // namespace vagus::serve
