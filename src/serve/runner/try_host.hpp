// A plan tried by hand (run/tried_way.hpp), by a process of its own: code of toolboxes computes in
// it. Each question is the whole way so far.
//
//     vagus try-host      (not for people: the studio starts it)
//
//     pipe.send(kTryAsked, R"({"plan":"/home/ada/Hall.plan.json","texts":{},"toolboxes":[],
//                              "way":[{"path":"Hall","element":"forward","outcome":"Done"}],
//                              "keep":false})");
//     // answers {"plan":{…},"turns":[…],"left":0,…}, or {"error":"…"}
#pragma once

#include <string>

#include "serve/process.hpp"

namespace vagus::serve {

constexpr char kTryAsked = 1;  // kinds of packets
constexpr char kTryAnswered = 2;

// The answer to one; empty: it is no question.
std::string answer_try(const std::string& question);

// Answers one, and ends. The exit status: 0, or 2 for what is no question.
int run_try(Pipe pipe);

}  // namespace vagus::serve
