#include "serve/runner/one_answer.hpp"

namespace vagus::serve {

namespace {

constexpr int kLooksMs = 1000;  // at whether there is something, or the other end is gone

}  // namespace

int answer_one(Pipe pipe, AnswerKinds kinds,
               const std::function<std::string(const std::string& question)>& answer_to) {
    std::string answer;
    while (answer.empty()) {
        pipe.wait(kLooksMs);
        for (const Packet& packet : pipe.receive()) {
            if (packet.kind == kinds.asked) answer = answer_to(packet.bytes);
            if (answer.empty()) return 2;
        }
        if (answer.empty() && pipe.closed()) return 2;
    }
    pipe.send(kinds.answered, answer);
    while (pipe.has_unsent() && !pipe.closed()) {
        pipe.wait(kLooksMs);
        pipe.flush();
        (void)pipe.receive();  // notices that nobody is there any more
    }
    return 0;
}

}  // namespace vagus::serve
