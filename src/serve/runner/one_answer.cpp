#include "serve/runner/one_answer.hpp"

#include <utility>
#include <vector>

namespace vagus::serve {

namespace {

constexpr int kLooksMs = 1000;  // at whether there is something, or the other end is gone

}  // namespace

std::optional<Packet> wait_for_packet(Pipe& pipe) {
    while (true) {
        pipe.wait(kLooksMs);
        std::vector<Packet> packets = pipe.receive();
        if (!packets.empty()) return std::move(packets.front());
        if (pipe.closed()) return std::nullopt;
    }
}

bool send_whole(Pipe& pipe, char kind, std::string_view bytes) {
    pipe.send(kind, bytes);
    while (pipe.has_unsent() && !pipe.closed()) {
        pipe.wait(kLooksMs);
        pipe.flush();
        (void)pipe.receive();  // notices that nobody is there any more
    }
    return !pipe.closed();
}

int answer_one(Pipe pipe, AnswerKinds kinds,
               const std::function<std::string(const std::string& question)>& answer_to) {
    const std::optional<Packet> asked = wait_for_packet(pipe);
    if (!asked || asked->kind != kinds.asked) return 2;
    const std::string answer = answer_to(asked->bytes);
    if (answer.empty()) return 2;
    send_whole(pipe, kinds.answered, answer);
    return 0;
}

}  // namespace vagus::serve
