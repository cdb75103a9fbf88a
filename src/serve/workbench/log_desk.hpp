// Log points put into the run that is shown afterwards, for pages: the commands log.ask and
// log.cancel. Each is answered by a process of its own, which runs the recording again.
//
//     LogDesk logs(desk, scripts, "/usr/bin/vagus", {.file = …, .flush = …});
//     logs.tick(now);
#pragma once

#include <string>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"
#include "serve/workbench/run_questions.hpp"

namespace vagus::serve {

constexpr size_t kLogsAtOnce = 2;      // processes; further questions are refused
constexpr Duration kLogWithin = 120s;  // then a question is not waited for any more
constexpr Duration kLogLookEvery = 10ms;
constexpr size_t kLogMemoryMax = size_t{2} << 30;

class LogDesk {
public:
    // Borrowed. Declares its commands.
    LogDesk(Desk& desk, Scripts& scripts, std::string program, ShownRun run);

    void tick(Time now) { questions_.tick(now); }
    Time next_tick() const { return questions_.next_tick(); }

private:
    void ask(const Call& call);
    Result<Json> place_of(const Json& in) const;
    Result<Json> line_of_script(const std::string& doc, int line) const;

    Scripts& scripts_;
    RunQuestions questions_;
};

}  // namespace vagus::serve
