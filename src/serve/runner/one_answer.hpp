// Processes that do nothing but wait for what they are asked and tell what comes of it. The other
// end of one question: workbench/questions.hpp.
//
//     return answer_one(std::move(pipe), {.asked = 1, .answered = 2},
//                       [](const std::string& question) { return "\"" + question + "\""; });
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "serve/process.hpp"

namespace vagus::serve {

// The next one, whenever it comes; nothing: the other end is gone.
std::optional<Packet> wait_for_packet(Pipe& pipe);
// Returns when all of it is on its way. False: the other end is gone.
bool send_whole(Pipe& pipe, char kind, std::string_view bytes);

struct AnswerKinds {
    char asked = 0;  // of packets
    char answered = 0;
};

// An empty answer: it was no question. The exit status: 0, or 2 then.
int answer_one(Pipe pipe, AnswerKinds kinds,
               const std::function<std::string(const std::string& question)>& answer_to);

}  // namespace vagus::serve
