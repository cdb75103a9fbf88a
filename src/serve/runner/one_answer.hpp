// The process of one question: it waits for it, answers, and ends.
//
//     return answer_one(std::move(pipe), {.asked = 1, .answered = 2},
//                       [](const std::string& question) { return "\"" + question + "\""; });
#pragma once

#include <functional>
#include <string>

#include "serve/process.hpp"

namespace vagus::serve {

struct AnswerKinds {
    char asked = 0;  // of packets
    char answered = 0;
};

// An empty answer: it was no question. The exit status: 0, or 2 then.
int answer_one(Pipe pipe, AnswerKinds kinds,
               const std::function<std::string(const std::string& question)>& answer_to);

}  // namespace vagus::serve
