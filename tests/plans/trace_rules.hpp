// Watches a trace for breaches of what always holds (docs/plans.md, section 4).
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "plan/graph.hpp"
#include "plan/trace.hpp"

namespace vagus {

class TraceRules {
public:
    // Borrowed: of the plan whose trace it is.
    explicit TraceRules(const plan::Graph& graph) : graph_(&graph) {}

    void see(const plan::TraceEvent& event);
    // After the run; sentences, empty if all held.
    const std::vector<std::string>& finish();

private:
    // A global supervisor that raised (P23): from its event until an activation after its remedy.
    struct Rest {
        uint64_t since = 0;   // activation that its event ended
        uint64_t remedy = 0;  // the first one after it that is no computation; 0: yet to come
    };
    struct Running {              // one plan
        uint64_t active = 0;      // activation whose code runs; 0: none
        uint64_t last_begun = 0;  // highest activation that began here
        std::string writer;       // who may write now
        std::map<std::string, Rest> resting;
    };

    void complain(const plan::TraceEvent& event, const std::string& what);
    const plan::GraphPlan& plan_of(const std::string& path) const;
    bool is_computation(const std::string& path, std::string_view actor) const;
    void note_activation(const plan::TraceEvent& event, std::string_view actor,
                         uint64_t activation);
    void note_raised(const plan::TraceEvent& event, const plan::EventRaised& raised);

    void note_change(const plan::TraceEvent& event, std::shared_ptr<const plan::Graph> graph);

    const plan::Graph* graph_;                    // the newest version (P31)
    std::shared_ptr<const plan::Graph> changed_;  // that, after a change
    std::map<std::string, Running> plans_;
    std::set<uint64_t> over_;  // activations that ended or were interrupted
    int64_t last_us_ = 0;
    uint64_t highest_ = 0;
    bool ended_ = false;
    std::vector<std::string> breaches_;
};

}  // namespace vagus
