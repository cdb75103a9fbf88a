// Questions about the run that is shown (questions.hpp): its process writes first what is recorded
// so far, then a process of its own answers from that file. A recording that is shown without a run
// is asked as it is.
//
//     RunQuestions questions({.program = "/usr/bin/vagus", .verb = "why-host", .kind = kWhyAsked,
//                             .within = kWhyWithin, .look_every = kWhyLookEvery},
//                            kWhysAtOnce, {.file = …, .flush = …});
//     questions.ask(call, question, [call](Json answer) { call.done(std::move(answer)); });
//     questions.tick(now);
#pragma once

#include <functional>
#include <list>
#include <string>

#include "base/result.hpp"
#include "serve/workbench/questions.hpp"

namespace vagus::serve {

struct ShownRun {
    // Its recording. The Error says why it has none.
    std::function<Result<std::string>()> file;
    // Tells when all that has happened by now is in it.
    std::function<void(std::function<void()> done)> flush;
    // Where a recording of that path lies on this computer. The Error says why it cannot be asked.
    std::function<Result<std::string>(const std::string& path)> kept = {};
};

class RunQuestions {
public:
    // Beyond `at_once`, questions are refused.
    RunQuestions(QuestionRules rules, size_t at_once, ShownRun run)
        : questions_(std::move(rules)), at_once_(at_once), run_(std::move(run)) {}

    // The question gets a member more: "file", that of the run or, if the call has one, of `trace`.
    void ask(const Call& call, Json question, Questions::Then then);
    void cancel(const std::function<bool(const Call& call)>& is_meant);

    void tick(Time now) { questions_.tick(now); }
    Time next_tick() const { return questions_.next_tick(); }

private:
    struct Flushing {
        uint64_t number = 0;
        Call call;
    };

    Questions questions_;
    const size_t at_once_;
    const ShownRun run_;
    uint64_t numbers_ = 0;
    std::list<Flushing> flushing_;
};

}  // namespace vagus::serve
