// Two recordings side by side (record/compare_runs.hpp, record/run_tracks.hpp), by a process of its
// own: it reads both, all of them.
//
//     vagus compare-host      (not for people: the studio starts it)
//
//     pipe.send(kCompareAsked, R"({"a":"run-1.mcap","b":"run-2.mcap","align":["actor","go"]})");
//     // answers {"a":{"start":2.5,"end":120.1,"actors":[…],"events":[…],"ways":[…],…},"b":{…},
//     //          "lanes":[…],"started":[…],"scene":[…]}, or {"error":"…"}
#pragma once

#include <string>

#include "serve/process.hpp"

namespace vagus::serve {

constexpr char kCompareAsked = 1;  // kinds of packets
constexpr char kCompareAnswered = 2;
constexpr size_t kLanesToldMax = 1000;
constexpr size_t kStartedToldMax = 1000;

// The answer to one; empty: it is no question.
std::string answer_compare(const std::string& question);

// Answers one, and ends. The exit status: 0, or 2 for what is no question.
int run_compare(Pipe pipe);

}  // namespace vagus::serve
