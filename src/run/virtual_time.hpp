// Runs a plan in virtual time: time jumps to the next thing due, code takes no time, and a run is
// the same to the byte each time (docs/plans.md, P21a and section 6). One thread decides; actors'
// code runs in turn with it, on a fiber of the same thread (fiber.hpp).
//
//     const RunOptions options = {.seed = 1, .on_trace = [](const plan::TraceEvent& event) { … }};
//     VirtualTime run(graph, library, options);
//     const Ended ended = run.run();
//
// Several on one clock are taken in turn, the earliest first; those at one time in the order of
// their owner. What they have around them is at the same instant for all (surroundings.hpp).
//
//     for (VirtualTime* run : runs) run->start();
//     while (VirtualTime* first = earliest(runs)) first->step();   // by now(), of those not over()
//     for (VirtualTime* run : runs) tell(run->finish());
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/rng.hpp"
#include "plan/machine.hpp"
#include "run/code.hpp"
#include "run/debug_values.hpp"
#include "run/fiber.hpp"
#include "run/heard_events.hpp"
#include "run/held_events.hpp"
#include "run/options.hpp"

namespace vagus::run {

class VirtualTime final : private EventGate {
public:
    // All three are borrowed for the life of the run.
    VirtualTime(const plan::Graph& graph, const CodeLibrary& library, const RunOptions& options);
    ~VirtualTime() override;

    Ended run();

    // The same in parts, without a debugger: start(), step() until over(), finish().
    void start();
    // Takes the next thing due at now(), or lets the clock move on to when the next one is.
    void step();
    bool over() const { return machine_.over(); }
    Time now() const { return now_; }
    Ended finish();

    // Ends the run as soon as what is being taken is done (P28). From any thread.
    void abort() { abort_asked_ = true; }
    // Writes a variable of the outermost plan as soon as what is being taken is done (P29); a value
    // that does not fit its type is dropped. For on_trace and for actors' code.
    void set(int slot, plan::Value value) { sets_asked_.emplace_back(slot, std::move(value)); }

    // Of the outermost plan, as it is now; nullptr: no plan has begun.
    const plan::Value* variable(int slot) const {
        return machine_.depth() > 0 ? &machine_.variable(0, slot) : nullptr;
    }

    // ---- for a run that follows the clock of another: from on_trace and from Surroundings ----
    // What was decided took until then.
    void move_clock(Time to) { now_ = std::max(now_, to); }
    // What comes while no code waits is kept for the next one that does, as in real time.
    void keep_unheard() { keeps_unheard_ = true; }
    // From now on tokens count from this one.
    void move_tokens(uint16_t token) { numbers_.move_to(token); }
    // Ends the run as abort() does, but with the result Error, at once.
    void fail(std::string_view why);
    // Does at once what was asked of the debugger of that run: a variable is set, an event raised,
    // a new version of the plan taken, the run ended. The Error says why it is not done; all else
    // that is asked never is.
    Status do_as_asked(const Request& request);

    // From now on what is random in the code of actors is drawn from that seed. As set().
    void reseed(uint64_t seed) { random_ = SplitMix64(seed); }

private:
    class Context;
    class WatchContext;
    struct Watching;
    struct Code;

    Ended decide();
    void obey();
    void obey(plan::StartWatch& command);
    void obey(plan::StopWatch& command);
    void obey(plan::Activate& command);
    void obey(plan::StartCode& command);
    void obey(plan::StopCode& command);
    void obey(plan::SubPlanOver& command);
    void obey(plan::RankAgain& command);

    bool take_first_due();
    bool may_check(const Watching& watching) const;
    void take_check(Watching& watching);
    void check(Watching& watching, const Check& check);
    bool passes_over(const Watching& by, const plan::Given& given) const;
    void take_code();
    void after_turn();
    void leave_out_missed(int level);
    void emit(const BusEvent& event);
    void deliver(const BusEvent& event);
    void deliver_to_code(const BusEvent& event);
    void meet_surroundings();
    std::vector<BusEvent> pass(std::vector<BusEvent> arrived);
    void hold(std::vector<BusEvent> arrived);
    void leave_surroundings();
    Time own_due() const;
    std::optional<Time> next_due() const;
    bool waits_for_surroundings();
    bool advance();
    bool pause_comes_first(Time next) const;
    void let_debug();
    // ---- EventGate ----
    void close_gate() override;
    void open_gate() override;
    HeldNow held() override;
    bool let_go(uint64_t number) override;
    bool drop(uint64_t number) override { return held_.take(number).has_value(); }

    void write_from_outside();
    void hand_out_trace();

    const CodeLibrary& library_;
    const RunOptions& options_;
    plan::Machine machine_;
    SplitMix64 random_;
    Numbers numbers_;
    Time now_{0};
    bool timed_out_ = false;
    bool met_ = false;  // an instant of the surroundings has begun and not ended
    std::atomic<bool> abort_asked_ = false;
    std::vector<std::pair<int, plan::Value>> sets_asked_;
    std::vector<std::unique_ptr<Watching>> watching_;  // in the order of P21
    std::optional<plan::Activate> begin_due_;
    std::optional<plan::SubPlanOver> over_due_;
    std::unique_ptr<Code> code_;
    bool keeps_unheard_ = false;
    HeardEvents between_;   // came while no code ran
    uint32_t trigger_ = 0;  // number of the frame that what is decided now follows from
    bool gate_closed_ = false;
    HeldEvents held_;
    uint64_t last_held_ = 0;         // its number
    std::vector<BusEvent> passing_;  // let go, to be heard at the next instant
    std::unique_ptr<Fiber> fiber_;   // of the first code that may wait, and all further ones
};

}  // namespace vagus::run
