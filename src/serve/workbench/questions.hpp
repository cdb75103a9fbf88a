// Questions of pages that are answered by processes, one each: it is asked, answers in JSON, and
// ends (its end: runner/one_answer.hpp). An answer {"error": "…"} refuses the command.
//
//     Questions questions({.program = "/usr/bin/vagus", .verb = "try-host", .kind = kTryAsked,
//                          .within = kTryWithin, .look_every = kTryLookEvery});
//     questions.ask(call, question, [call](Json answer) { call.done(std::move(answer)); });
//     questions.tick(now);
#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/process.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

// How a call fails that was cancelled.
void fail_cancelled(const Call& call);

struct QuestionRules {
    std::string program;  // vagus
    std::string verb;     // of its process
    char kind = 0;        // of the packet that asks
    size_t memory_max = kRunMemoryMax;
    Duration within{};  // then an answer is not waited for any more
    Duration look_every{};
    std::string refused;  // the code of an answer with an error
    std::string died;     // "the plan cannot be tried": before what became of its process
    std::string late;     // why it was not waited for any more
};

class Questions {
public:
    using Then = std::function<void(Json answer)>;

    explicit Questions(QuestionRules rules) : rules_(std::move(rules)) {}

    // Where there is no answer the call fails.
    void ask(const Call& call, const Json& question, Then then);
    // These are not to be answered any more: their processes end, and their calls fail.
    void cancel(const std::function<bool(const Call& call)>& is_meant);
    // That wait for their answers.
    size_t count() const { return asked_.size(); }

    void tick(Time now);
    Time next_tick() const;

private:
    struct Asked {
        Call call;
        Child child;
        Then then;
        std::optional<Time> until;  // set by the first tick
    };

    bool look(Asked& asked, Time now) const;
    void answer(const Asked& asked, const std::string& text) const;

    const QuestionRules rules_;
    std::list<Asked> asked_;
    Time now_{};
};

}  // namespace vagus::serve
