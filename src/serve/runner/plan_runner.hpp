// The plan of a run as its process holds it: with its debugger, its breakpoints, the versions that
// take over from it, and what pages see of it. Everything is told by the teller.
//
//     PlanRunner plan(teller, pacer, {.wall = now, .run = run_time});
//     plan.begin(loaded, path, PlanRunner::On::World);
//     plan.tell_version();                  // once the server knows that it is opened
//     run(plan.debugger(), [&](const plan::TraceEvent& event) { plan.see(event); });
//     plan.hear();                          // now and then
//     plan.tell();
//     plan.end_talk();
//     plan.forget();
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "embed/loaded_plan.hpp"
#include "serve/follow/plan_follower.hpp"
#include "serve/runner/pacer.hpp"
#include "serve/runner/plan_change.hpp"
#include "serve/runner/plan_held.hpp"
#include "serve/runner/plan_stops.hpp"
#include "serve/runner/plan_talk.hpp"
#include "serve/runner/teller.hpp"

namespace vagus::serve {

constexpr size_t kRunningTextsMax = 8u << 20;  // bytes of the files of a plan that are told

class PlanRunner {
public:
    struct Clocks {
        std::function<Time()> wall;
        std::function<double()> run;  // seconds
    };
    // In a world its clock holds the plan; on a bus its debugger does.
    enum class On { World, Bus };

    // The teller and the pacer are borrowed.
    PlanRunner(Teller& teller, Pacer& pacer, Clocks clocks)
        : teller_(teller), pacer_(pacer), clocks_(std::move(clocks)) {}

    // Before begin(): who is told of what its debugger is asked, and of files that it changes by.
    using Asked = std::function<void(const run::Request&)>;
    void on_asked(Asked told) { asked_ = std::move(told); }
    void on_changed(PlanChange::Read told) { changed_ = std::move(told); }

    // ---- its life ----
    void begin(const embed::LoadedPlan& plan, const std::string& path, On on);
    // What runs is the first version.
    void tell_version();
    // Nobody comes to what was asked and not answered yet.
    void end_talk();
    void forget();

    bool runs() const { return talk_.has_value(); }
    bool is_on_bus() const { return runs() && on_ == On::Bus; }
    // It has come to a breakpoint or to the end of a step.
    bool is_paused() const { return runs() && talk_->is_paused(); }
    // Only while it runs.
    run::Debugger& debugger() { return talk_->debugger(); }

    // ---- what it does ----
    void see(const plan::TraceEvent& event);
    // What the debugger says. What the plan came to holds it, and the clock of its world with it.
    void hear();
    void tell();
    // It came to something that pages want to know before the next time.
    bool take_haste() { return std::exchange(haste_, false); }

    // ---- what it is told ----
    void want(std::vector<talk::BreakpointOrder> breakpoints);
    void tend_stops();
    void hold() { talk_->hold(); }
    void abort() { talk_->abort(); }
    // The pacer was set to another pace.
    void pace();
    void go_on();
    // What its debugger was asked in a run before this one, which is lived again.
    void ask_again(const run::Request& request);
    // While it is lived again nobody asks which events are held: asking takes them from the bus,
    // and that was recorded where it was done then.
    void relive(bool on) { relives_ = on; }
    void step();
    void obey(const talk::SetVariable& order);
    void obey(const talk::RaiseEvent& order);
    void obey(const talk::HandleHeld& order);
    void obey(const talk::ChangePlan& order);
    void obey(const talk::CheckPlan& order);

private:
    bool is_held() const;
    void ask_held(uint64_t request, run::Request asked);
    void let_an_instant_pass();
    void let_time_pass();
    void stand_at(const run::Where& where, std::vector<uint64_t> breakpoints);
    void tell_stops();
    void take_version(const plan::Graph& graph);
    talk::PlanNow plan_now() const;

    Teller& teller_;
    Pacer& pacer_;
    const Clocks clocks_;
    On on_ = On::World;
    std::optional<PlanFollower> follower_;
    std::optional<PlanTalk> talk_;
    std::optional<PlanChange> change_;
    PlanStops stops_;
    PlanHeld held_;
    Asked asked_ = [](const run::Request&) {};
    PlanChange::Read changed_ = [](const auto&) {};
    std::vector<uint64_t> broken_at_;  // breakpoints that hold it, by their numbers
    bool haste_ = false;
    bool relives_ = false;

    PlanFollower::Plans plans_;  // of the version that runs; owners: this and followers
    std::map<std::string, std::string> texts_;  // of its files
    const plan::Graph* version_ = nullptr;      // tells versions apart; null: the first
    uint64_t number_ = 0;                       // of the version
};

}  // namespace vagus::serve
