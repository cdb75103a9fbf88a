// When something in the run that is shown was decided, for pages: the commands turning.ask and
// turning.stop, and the topic turning. One question at a time is answered by a process of its own
// (`vagus turning-host`), from the recording of the run, beside whatever runs.
//
//     TurningDesk turnings(desk, files, start, {.file = …, .flush = …}, {.chain_of = …, …});
//     turnings.tick(now);
#pragma once

#include <functional>
#include <string>

#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/project/files.hpp"
#include "serve/run/run.hpp"
#include "serve/studio/desk.hpp"
#include "serve/workbench/run_questions.hpp"
#include "serve/workbench/telling_process.hpp"

namespace vagus::serve {

constexpr Duration kTurningSilentMax = 300s;  // no continuation has ended: then it ends
constexpr Duration kTurningLookEvery = 50ms;
constexpr size_t kTurningMemoryMax = size_t{2} << 30;  // of each process

class TurningDesk {
public:
    struct Project {
        std::function<Json(const Json& chain)> chain_of;  // [WhyLink], of a chain in JSON
        std::function<std::string(const std::string& text)> shorten;  // paths as pages call them
        std::function<uint64_t()> run;  // the number of the one that is shown
    };

    // Borrowed. Declares its commands and its topic.
    TurningDesk(Desk& desk, Files& files, StartRunProcess start, ShownRun run, Project project);

    void tick(Time now);
    Time next_tick() const;
    // Of a continuation that was kept: a path that no document has.
    bool has_recording(const std::string& path) const;
    // Another project: nothing is looked for any more.
    void forget();

private:
    enum class State { None, Running, Done, Stopped, Failed };

    void ask(const Call& call);
    void stop(const Call& call);
    void begin(const std::string& file);
    void hear(const Packet& packet);
    void answer(const Json& answer);
    Json result_of(const Json& answer) const;
    Json turn_of(const Json& turn) const;
    void end(State how, std::string why = {});
    Json document() const;

    Desk& desk_;
    Files& files_;
    const StartRunProcess start_;
    const ShownRun shown_;
    const Project project_;

    State state_ = State::None;
    uint64_t asked_ = 0;  // counts up
    uint64_t run_ = 0;    // that it was asked of
    std::string condition_, why_;
    int tries_ = 0;
    Json progress_, result_;
    TellingProcess process_;  // not there yet: the run writes what is recorded so far
    Time now_{};
};

}  // namespace vagus::serve
