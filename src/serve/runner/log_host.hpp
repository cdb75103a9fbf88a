// One log point put into a recorded run afterwards (record/log_run.hpp), by a process of its own:
// the run is run again, all of it.
//
//     vagus log-host      (not for people: the studio starts it)
//
//     pipe.send(kLogAsked, R"({"file":"run.mcap","values":"token, patience",
//                              "node":"drive","line":193,"script":"carbot.aesl"})");
//     pipe.send(kLogAsked, R"({"file":"run.mcap","values":"walldist","when":"enter",
//                              "plan":"WallFollow.plan.json","element":"followWall"})");
//     // answers {"names":["token","patience"],"hits":[{"t":9.5,"where":"drive:193",
//     //          "values":["8","10"]}],"more":0,"until":120.1,
//     //          "text":"emit drive.arrived [token]"}, or {"error":"…"}
#pragma once

#include <string>

#include "serve/process.hpp"

namespace vagus::serve {

constexpr char kLogAsked = 1;  // kinds of packets
constexpr char kLogAnswered = 2;
constexpr size_t kLogHitsMax = 5000;  // of one point that are told; the others are counted

// The answer to one; empty: it is no question.
std::string answer_log(const std::string& question);

// Answers one, and ends. The exit status: 0, or 2 for what is no question.
int run_log(Pipe pipe);

}  // namespace vagus::serve
