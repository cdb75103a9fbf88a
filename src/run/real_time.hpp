// Runs a plan in real time. One thread decides (the caller of run()); actors' code and supervisors'
// checks run on threads of their own and tell it what happened through one inbox. The next actor's
// code starts only after the one before has fully stopped (P14).
//
//     RealTime run(graph, library, options);
//     const Ended ended = run.run();            // from other threads: abort(), set(), hear()
//
// Checks come at whole multiples of their period from the start of the watching, by absolute
// deadlines. One that begins late, or is still busy when the next is due, is told in the trace.
//
// A supervisor has stopped when its check has returned; what comes next waits for that, 100 ms at
// most (P18b). A check that takes longer is left to itself, with its thread: it may outlive the
// run, so what the code of a supervisor uses must live as long as the program, or be its own.
#pragma once

#include <memory>
#include <string>

#include "base/result.hpp"
#include "plan/machine.hpp"
#include "run/code.hpp"
#include "run/options.hpp"

namespace vagus::run {

// A check that begins so much after its deadline is late (`late` in the trace).
constexpr Duration kLateness = std::chrono::milliseconds(5);

struct Lateness {  // of checks, measured from deadline to begin
    uint64_t checks = 0;
    Duration median{0};
    Duration p99{0};
    Duration worst{0};
};

class RealTime {
public:
    // All three are borrowed for the life of the run.
    RealTime(const plan::Graph& graph, const CodeLibrary& library, const RunOptions& options);
    ~RealTime();

    // Returns when the plan has ended and no code of it runs any more, but for checks that were
    // left to themselves.
    Ended run();
    // After run(); over the last kLatenessSamples checks.
    Lateness lateness() const;

    // ---- from any thread, at any time ----
    void abort();
    // Ends the run as abort() does, but with the result Error; `why` is a sentence.
    void fail(std::string why);
    // Writes a variable of the outermost plan (P29); the Error comes back through `done` or is
    // dropped where nobody asks.
    void set(int slot, plan::Value value);
    // An event has come from the bus. Beyond kInboxMax that wait (run/real_time_parts.hpp) they are
    // dropped and counted.
    void hear(BusEvent event);
    // From now on tokens count from this one (RunOptions::first_token).
    void move_tokens(uint16_t token);

private:
    class Engine;
    std::unique_ptr<Engine> engine_;
};

constexpr size_t kLatenessSamples = 100'000;

}  // namespace vagus::run
