// How often each element of a running plan has had its turn, how long it took, and which arrow was
// taken last: counted from the trace, for each instance of a plan by its path.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "plan/trace.hpp"

namespace vagus::serve {

class PlanCounts {
public:
    void see(const plan::TraceEvent& event);
    // [PlanCount] and PlanTaken of the protocol; null: none yet.
    nlohmann::json counts(const std::string& path) const;
    nlohmann::json taken(const std::string& path) const;

private:
    struct Count {
        uint64_t times = 0;
        double seconds = 0;  // of the activations that are over
        double last = 0;
    };
    struct Instance {
        std::map<std::string, Count> actors, supervisors;
        std::string active;  // actor
        double since = 0;
        nlohmann::json taken;
    };
    void begin(Instance& one, std::string_view actor, double t);
    void end(Instance& one, double t);
    void take(Instance& one, const char* is, std::string_view element, std::string_view outcome,
              std::string_view target);

    std::map<std::string, Instance> instances_;  // by path
    uint64_t arrows_ = 0;
};

}  // namespace vagus::serve
