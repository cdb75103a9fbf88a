// A plan that runs, as the host talks with it: through its debugger, between two of its decisions.
// Each request of a page has a number and gets one answer, also when the plan ends before it came
// to it.
#pragma once

#include <cstdint>
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

    void hold();   // also a step
    void go_on();  // also from within a step
    // On to the next actor that begins, and held there.
    void step();
    void abort();

    enum class Then { Hold, GoOn };
    struct Write {
        int level = 0;
        std::string variable;
        plan::Value value;
    };
    // Its answer will have the number `request`.
    void set(uint64_t request, Write write, Then then);

    // A new version of the plan (P31): the answer has what stands in its way. `only_ask`: it takes
    // over in no case.
    void take_version(uint64_t request, plan::NewVersion next, bool only_ask);
    // The same question, answered at once; between two decisions, on the thread of the run.
    std::vector<std::string> reasons_against(const plan::NewVersion& next) const {
        return debugger_.reasons_against(next);
    }

    struct Answered {
        uint64_t request = 0;
        std::string why;                                       // why it was not done; empty: it is
        std::optional<std::vector<std::string>> reasons = {};  // against a new version
    };
    struct Heard {
        std::vector<Answered> answers;
        std::optional<run::Where> stepped;  // held before an actor, after step()
    };
    Heard hear();
    // The plan is over: what nobody will come to any more.
    std::vector<Answered> forget();

private:
    run::Debugger debugger_;
    bool stepping_ = false;
    std::map<uint64_t, uint64_t> asked_;  // number at the debugger to request
    std::vector<Answered> refused_;       // before they came to the debugger
};

}  // namespace vagus::serve
