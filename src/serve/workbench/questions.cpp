#include "serve/workbench/questions.hpp"

#include <utility>

namespace vagus::serve {

void Questions::ask(const Call& call, const Json& question, Then then) {
    auto child = Child::start({.program = rules_.program,
                               .arguments = {rules_.verb},
                               .name = "vagus",
                               .memory_max = rules_.memory_max});
    if (!child.ok()) return call.fail(child.error());
    child.value().pipe().send(rules_.kind, question.dump());
    asked_.push_back({call, std::move(child.value()), std::move(then), std::nullopt});
}

void fail_cancelled(const Call& call) {
    call.fail("unavailable", "the question was cancelled");
}

void Questions::cancel(const std::function<bool(const Call& call)>& is_meant) {
    std::erase_if(asked_, [&](const Asked& one) {
        if (!is_meant(one.call)) return false;
        fail_cancelled(one.call);
        return true;
    });
}

void Questions::tick(Time now) {
    now_ = now;
    std::erase_if(asked_, [&](Asked& one) { return look(one, now); });
}

Time Questions::next_tick() const {
    return asked_.empty() ? Time::max() : now_ + rules_.look_every;
}

// True: it is answered, or waited for no longer.
bool Questions::look(Asked& asked, Time now) const {
    if (!asked.until) asked.until = now + rules_.within;
    Pipe& pipe = asked.child.pipe();
    pipe.flush();
    for (const Packet& packet : pipe.receive()) {
        answer(asked, packet.bytes);
        return true;
    }
    if (const auto ended = asked.child.ended(); ended || pipe.closed()) {
        const std::string what = ended ? ended->what : "has gone";
        asked.call.fail("failed", rules_.died + ": its process " + what);
        return true;
    }
    if (now < *asked.until) return false;
    asked.call.fail("timeout", rules_.late);
    return true;
}

void Questions::answer(const Asked& asked, const std::string& text) const {
    Json answer = Json::parse(text, nullptr, false);
    if (!answer.is_object()) return asked.call.fail("failed", "the answer cannot be read");
    if (answer.contains("error")) {
        return asked.call.fail(rules_.refused, answer["error"].get<std::string>());
    }
    asked.then(std::move(answer));
}

}  // namespace vagus::serve
