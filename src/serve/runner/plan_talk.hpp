// A running plan, as the runner talks with it: through its debugger, between two of its decisions.
// Whatever is asked gets one answer, also when the plan ends before it came to it.
//
//     PlanTalk talk(graph);
//     talk.ask_held(run::SetVariable{0, "n", value}, answered, PlanTalk::Then::GoOn);
//     const PlanTalk::Heard heard = talk.hear();  // now and then; it calls `answered`
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "run/debugger.hpp"

namespace vagus::serve {

class PlanTalk {
public:
    // The graph is borrowed.
    explicit PlanTalk(const plan::Graph& graph) : debugger_(graph, run::Debugger::At::Run) {}
    run::Debugger& debugger() { return debugger_; }
    // Is told of each request that the plan will come to.
    void on_asked(std::function<void(const run::Request&)> told) { told_ = std::move(told); }

    void hold();   // also a step
    void go_on();  // also from within a step, and from a breakpoint
    // On to the next actor that begins, and held there.
    void step();
    void give_up_step();
    // On with one event of those that wait, without a number the first, and held again at the next
    // thing that the plan does. Refused, it stays where it is.
    using Answered = std::function<void(const Result<run::Reply>& reply)>;
    void step_event(std::optional<uint64_t> number, Answered answered);
    void abort();
    // Held by what it came to: a breakpoint, or the end of a step.
    bool is_paused() const { return paused_; }

    // At once, also while it runs.
    void ask(run::Request request, Answered answered);
    // What it was asked in a run before this one, which is lived again.
    void ask_again(const run::Request& request);
    // What a debugger does for a plan that is held only. A plan that paused by itself stays so.
    enum class Then { Hold, GoOn };
    void ask_held(run::Request request, Answered answered, Then then);

    // What is in the way of a new version (P31), at once: between two decisions, on the thread
    // of the run.
    std::vector<std::string> reasons_against(const plan::NewVersion& next) const {
        return debugger_.reasons_against(next);
    }

    struct Heard {
        std::optional<run::Where> stepped;   // held after step() or step_event()
        std::optional<run::Stopped> broken;  // held at a breakpoint
    };
    Heard hear();
    // The plan is over: answers what nobody will come to any more.
    void forget();

private:
    Result<uint64_t> post(run::Request request);

    run::Debugger debugger_;
    std::function<void(const run::Request&)> told_ = [](const run::Request&) {};
    bool stepping_ = false;
    bool paused_ = false;
    std::map<uint64_t, Answered> asked_;  // by number at the debugger
};

}  // namespace vagus::serve
