// Watches a trace for breaches of what always holds (docs/plans.md, section 4).
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "plan/trace.hpp"

namespace vagus {

class TraceRules {
public:
    void see(const plan::TraceEvent& event);
    // After the run; sentences, empty if all held.
    const std::vector<std::string>& finish();

private:
    struct Running {              // one plan
        uint64_t active = 0;      // activation whose code runs; 0: none
        uint64_t last_begun = 0;  // highest activation that began here
        bool may_write_actor = false;
        std::string writer;  // who may write now
    };

    void complain(const plan::TraceEvent& event, const std::string& what);

    std::map<std::string, Running> plans_;
    std::set<uint64_t> over_;  // activations that ended or were interrupted
    int64_t last_us_ = 0;
    uint64_t highest_ = 0;
    bool ended_ = false;
    std::vector<std::string> breaches_;
};

}  // namespace vagus
