// Two recorded runs side by side, for pages: the command runs.compare. A process of its own reads
// both (runner/compare_host.hpp).
//
//     PairDesk pairs(desk, "/usr/bin/vagus", shown_run, project);
//     pairs.tick(now);
#pragma once

#include <functional>
#include <string>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/studio/desk.hpp"
#include "serve/workbench/run_questions.hpp"

namespace vagus::serve {

constexpr size_t kPairsAtOnce = 2;     // processes; further questions are refused
constexpr Duration kPairWithin = 60s;  // then a question is not waited for any more
constexpr Duration kPairLookEvery = 10ms;
constexpr size_t kPairMemoryMax = size_t{2} << 30;

class PairDesk {
public:
    struct Project {
        // The file of a recording that a page names, and back.
        std::function<Result<std::string>(const std::string& path)> recording_at;
        std::function<std::string(const std::string& file)> doc_of;
    };

    // Borrowed. Declares its command.
    PairDesk(Desk& desk, std::string program, ShownRun run, Project project);

    void tick(Time now) { questions_.tick(now); }
    Time next_tick() const { return questions_.next_tick(); }

private:
    void ask(const Call& call);
    Result<std::string> file_of(const Call& call, const char* side) const;

    const std::function<Result<std::string>()> shown_;
    const Project project_;
    RunQuestions questions_;
};

}  // namespace vagus::serve
