// Why something in a run is as it is, for pages: the command why.ask. Each question is answered by
// a process of its own, from the recording of the run.
//
//     WhyDesk whys(desk, files, scripts, "/usr/bin/vagus", {.file = …, .flush = …});
//     whys.tick(now);
#pragma once

#include <optional>
#include <string>

#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/project/files.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"
#include "serve/workbench/run_questions.hpp"

namespace vagus::serve {

constexpr size_t kWhysAtOnce = 2;     // processes; further questions are refused
constexpr Duration kWhyWithin = 60s;  // then a question is not waited for any more
constexpr Duration kWhyLookEvery = 10ms;
constexpr size_t kWhyMemoryMax = size_t{2} << 30;

class WhyDesk {
public:
    // Borrowed. Declares its command.
    WhyDesk(Desk& desk, Files& files, Scripts& scripts, std::string program, ShownRun run);

    void tick(Time now) { questions_.tick(now); }
    Time next_tick() const { return questions_.next_tick(); }
    // The file of the project that a name in a recording means; empty: none.
    std::string path_of(const std::string& name);
    // [WhyLink] of the protocol, of a chain as `vagus why --json` gives it.
    Json shown_chain(const Json& chain);

private:
    // A place in the project.
    struct Spot {
        std::string doc;
        int line = 0;
    };

    void ask(const Call& call);
    void tell(const Call& call, const Json& answered);
    std::optional<Spot> spot_of(const std::string& place);

    Files& files_;
    Scripts& scripts_;
    RunQuestions questions_;
};

}  // namespace vagus::serve
