// The ends of runs as they are told: to pages, the log and the figures, each once.
//
//     RunEnds ends;
//     ends.add(end, t, wall_ms);
//     say(ends.kind(), ends.sentence());
//     topics.document("end", [&](const Json&) { return ends.document(); });
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "serve/life/orders.hpp"

namespace vagus::serve {

class RunEnds {
public:
    RunEnds();
    void add(const life::End& end, double t, double wall_ms);
    // Other nodes of the last one have answered by now.
    void renew(const life::End& end);
    bool differs(const StopReport& report) const;
    // A person knows of the nodes that did not answer. False: there is no such end.
    bool acknowledge(uint64_t number);

    // The last one: what is said of it, and how.
    std::string kind() const;
    std::string sentence() const;
    // Somebody has to be told that nodes did not answer.
    bool open() const;
    nlohmann::json document() const;

    // Of all: by why they came, and by the results of their plans.
    const std::map<std::string, uint64_t>& counts() const { return counts_; }
    const std::map<std::string, uint64_t>& results() const { return results_; }
    // Of the last one; empty: without a plan.
    std::string last_result() const { return last_ ? last_->end.result : ""; }
    // Of the last one: nodes that were not read back as stopped.
    size_t missing() const;

private:
    struct Told {
        life::End end;
        double t = 0, wall_ms = 0;
    };
    std::optional<Told> last_;
    bool acknowledged_ = false;
    std::map<std::string, uint64_t> counts_;
    std::map<std::string, uint64_t> results_ = {{"OK", 0}, {"Interrupted", 0}, {"Error", 0}};
};

// [StopNode] of the protocol.
nlohmann::json nodes_json(const std::vector<StopNode>& nodes);

}  // namespace vagus::serve
