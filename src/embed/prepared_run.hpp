// The options of `vagus plan run` (docs/plans.md, section 6) made into a run: of a plan alone, of a
// plan beside a world, or on a bus that others are on.
//
//     RunWords words;
//     words.world = "arena.world.json";
//     toolbox::Parts parts;                                   // the library's
//     auto prepared = PreparedRun::prepare({graph, plans, library}, words, parts);
//     const Result<run::Ended> ended = prepared.value()->run();
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "plan/graph.hpp"
#include "run/code.hpp"
#include "run/options.hpp"
#include "toolbox/parts.hpp"

namespace vagus::session {
class PlanWorld;
}

namespace vagus::embed {

constexpr Duration kWorldMaxTime = std::chrono::seconds(3600);  // beside a world, unless told

// As they stand on the command line; empty: not given.
struct RunWords {
    std::vector<std::string> set = {};
    std::string clock = {};             // real or virtual (real)
    std::optional<uint64_t> seed = {};  // of the plan (1) and of the world (that of its file)
    std::string max_time = {};
    std::string trace = {};      // a file, or - for stdout
    std::string trace_all = {};  // the same, with what happens in the world
    std::string world = {};
    std::string bus = {};      // a target (docs/formats.md)
    std::string project = {};  // an .aesl: names of events for `bus`
};

// All borrowed. `plans` is what the graph was made of.
struct Runnable {
    const plan::Graph& graph;
    const std::vector<plan::Plan>& plans;
    const run::CodeLibrary& library;
};

class PreparedRun {
public:
    // Reads the world, lets its scripts settle, connects to the bus, opens the traces. `parts` are
    // those that the library borrows; they are filled in. The Error is for exit status 2.
    static Result<std::unique_ptr<PreparedRun>> prepare(const Runnable& what, const RunWords& words,
                                                        toolbox::Parts& parts);
    ~PreparedRun();

    // Time jumps; it may be paced by the wall clock all the same.
    bool in_virtual_time() const;
    // nullptr without one. Valid until the next run().
    session::PlanWorld* world();

    // Before run(). Also hears the trace, on the deciding thread.
    void listen(std::function<void(const plan::TraceEvent&)> listener);
    // Before run(), beside a world: called at each of its instants, on the deciding thread, instead
    // of waiting for the wall clock.
    void pace(std::function<void(Time)> wait);

    // Can be called again: each is a run of its own, in a world of its own. Fails only where that
    // world cannot be opened any more.
    Result<run::Ended> run(run::Debugger* debugger = nullptr);
    // Ends the run (P28). From the deciding thread; on a bus from any.
    void abort();

private:
    class Insides;
    explicit PreparedRun(std::unique_ptr<Insides> insides);
    std::unique_ptr<Insides> insides_;
};

// NAME=VALUE of `--set`: a slot of the plan, and the value converted as a string.
Result<std::pair<int, plan::Value>> parse_set(const plan::GraphPlan& plan, const std::string& text);

// The seconds of `--max-time`.
Result<Duration> parse_max_time(const std::string& text);

}  // namespace vagus::embed
