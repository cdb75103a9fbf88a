// One question about a recording (record/why.hpp), answered by a process of its own: a long run
// takes seconds to run again.
//
//     vagus why-host      (not for people: the studio starts it)
//
//     pipe.send(kWhyAsked, R"({"file":"run.mcap","question":["motor","carbot"],"at":12.5})");
//     // answers {"chain":[…]} as `vagus why --json` does, or {"error":"…"}
#pragma once

#include "serve/process.hpp"

namespace vagus::serve {

constexpr char kWhyAsked = 1;  // kinds of packets
constexpr char kWhyAnswered = 2;

// Answers one, and ends. The exit status: 0, or 2 for what is no question.
int run_why(Pipe pipe);

}  // namespace vagus::serve
