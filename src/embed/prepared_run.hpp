// The options of `vagus plan run` (docs/plans.md, section 6) made into a run: of a plan alone, of a
// plan beside a world, or on a bus that others are on.
//
//     RunWords words;
//     words.world = "arena.world.json";
//     toolbox::Parts parts;                                   // the library's
//     auto prepared = PreparedRun::prepare(plan, words, parts);        // a LoadedPlan
//     const Result<run::Ended> ended = prepared.value()->run();
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/run_words.hpp"
#include "plan/finding.hpp"
#include "plan/graph.hpp"
#include "run/code.hpp"
#include "run/options.hpp"
#include "sim/world.hpp"
#include "toolbox/parts.hpp"

namespace vagus::session {
class PlanWorld;
}

namespace vagus::embed {

class BusTap;

constexpr Duration kWorldMaxTime = std::chrono::seconds(3600);  // beside a world, unless told

class PreparedRun {
public:
    // Reads the world, lets its scripts settle, connects to the bus, opens the traces. The plan is
    // borrowed; `parts` are those that its library borrows; they are filled in. The Error is for
    // exit status 2.
    static Result<std::unique_ptr<PreparedRun>> prepare(const LoadedPlan& plan,
                                                        const RunWords& words,
                                                        toolbox::Parts& parts);
    ~PreparedRun();

    // Time jumps; it may be paced by the wall clock all the same.
    bool in_virtual_time() const;
    // nullptr without one. Valid until the next run().
    session::PlanWorld* world();

    // Where others can join the bus of the world: "tcp:127.0.0.1:33333"; empty without --listen.
    std::string listening() const;
    // Moves the bytes of those who have joined; for a pace() that waits long. It is done at each
    // instant anyway.
    void serve_hosts();
    // The files that were read besides those of the plan: toolboxes, the world, its scripts, the
    // project.
    std::vector<std::string> files() const;

    // Before run(). Also hears the trace, on the deciding thread. Gives a number for unlisten(),
    // which is for between two runs.
    int listen(std::function<void(const plan::TraceEvent&)> listener);
    void unlisten(int listener);
    // Before run(), in virtual time: whether an event of a supervisor is passed over, as if its
    // check had found nothing.
    void pass_over(std::function<bool(const run::Raising&)> passes);
    // Before run(), beside a world: called at each of its instants, on the deciding thread, instead
    // of waiting for the wall clock.
    void pace(std::function<void(Time)> wait);

    // Can be called again: each is a run of its own, in a world of its own. Fails only where that
    // world cannot be opened any more.
    Result<run::Ended> run(run::Debugger* debugger = nullptr);
    // Before run(), on a bus: is told of all that comes and goes; borrowed until tap(nullptr),
    // after the run.
    void tap(BusTap* tap);
    // Before run(), on a bus that nobody else looks after, as a debugger would that stops nodes and
    // lets them run again: a run whose nodes another host stops ends with an error. A host that
    // pauses nodes says so.
    void end_when_stopped();
    // Before run(), on a bus on which no other host does so: where a node does not run any more,
    // the others that move are paused until it does.
    void brake_as_a_whole();
    // From any thread, on a bus: somebody debugs these nodes, and no others; the plan waits for
    // them.
    void hold_nodes(std::set<uint16_t> nodes);
    // Before run(): who is told, in a sentence, what a person should know while it runs, on the
    // deciding thread, and of a bus on its thread; stderr unless this is called. That a trace
    // cannot be written any more, once for each: the run goes on, a robot does not stop for a full
    // disk. That the plan does nothing but fire (run/firing.hpp). That the bus is lost or there
    // again, or that somebody else commands the same nodes.
    void tell(std::function<void(const std::string&)> tell);
    // Before run(): who is told, instead, how a run on a bus has ended, and that nodes are at
    // rest. A node that is not is for tell() all the same.
    void report(std::function<void(const std::string&)> report);
    // After run(): the exit status of docs/plans.md, section 6, or 1 for a plan that ended well
    // but whose trace is not complete. Writes what of the traces still waits.
    int exit_status(const run::Ended& ended);
    // Ends the run (P28), and each that would follow. From any thread, also before run(). On a bus
    // the robot is stopped at once. `by` is who does that, for the sentence that tells the end.
    void abort(const std::string& by = "");
    bool abort_asked() const;
    // Ends this run only; the next one begins as usual.
    void abort_this();
    // While it runs, on the deciding thread: writes a variable of the outermost plan from outside,
    // as soon as what is being decided is done (P29).
    void set(int slot, plan::Value value);
    // While it runs: the plan hears what is no event of the bus. Beside a world on the deciding
    // thread, on a bus from any.
    void hear(run::BusEvent event);
    // While it runs in virtual time, on the deciding thread: from now on what is random in the code
    // of actors is drawn from that seed. The world has a reseed() of its own.
    void reseed(uint64_t seed);
    // Before run(), beside a world: from now on what was asked of abort() and abort_this() is done
    // by take_abort(), on the deciding thread. Gives by whom, if it was asked for since. Whoever
    // takes them no more says so before the next run.
    void defer_aborts(bool deferred = true);
    std::optional<std::string> take_abort();

private:
    class Insides;
    explicit PreparedRun(std::unique_ptr<Insides> insides);
    std::unique_ptr<Insides> insides_;
};

// What the scripts of a world (--world, --robot) or of a project (--project) lack of what the plan
// needs: findings like those of the plan's own check. The Error says what is wrong with the files.
Result<plan::Findings> check_bus(const LoadedPlan& plan, const RunWords& words);

// NAME=VALUE of `--set`: a slot of the plan, and the value converted as a string.
Result<std::pair<int, plan::Value>> parse_set(const plan::GraphPlan& plan, const std::string& text);

// The number of `--seed`.
Result<uint64_t> parse_seed(const std::string& text);

// The robot, and where it begins, of `--pose ROBOT=X,Y,DEG`: m, and degrees counter-clockwise.
Result<sim::RobotStart> parse_pose(const std::string& text);

// The number of `--threads`.
Result<unsigned> parse_threads(const std::string& text);

// The faults of `--chaos`: a JSON file, the JSON itself, or such as the world draws,
// random:N[:SEED[:SECONDS[:KIND,KIND]]].
Result<sim::Chaos> read_chaos_words(const std::string& text);

// A world with these options, as words; what is empty is as its file says.
struct WorldWords {
    std::string seed = {};
    std::vector<std::string> poses = {};
    std::string chaos = {};
};
Result<sim::WorldOptions> world_options(const WorldWords& words);

// The seconds of `--max-time`; empty: it never comes.
Result<std::optional<Duration>> parse_max_time(const std::string& text);

}  // namespace vagus::embed
