// A line of a trace (docs/plans.md, section 6), read back: from a run, or from a file that anybody
// may have written.
//
//     const auto line = TraceLine::read(text);
//     if (!line.ok()) return line.error();          // expected what, found what
//     if (const auto event = line.value().event()) follower.see(*event);
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "plan/trace.hpp"

namespace vagus::serve {

class TraceLine {
public:
    static Result<TraceLine> read(std::string_view text);

    double t() const { return json_["t"]; }
    std::string plan() const { return json_["plan"]; }  // instance path
    // What happened; its names point into this line. Nothing for a kind that a newer Vagus writes.
    std::optional<plan::TraceEvent> event() const;

private:
    explicit TraceLine(nlohmann::json json) : json_(std::move(json)) {}
    nlohmann::json json_;
};

}  // namespace vagus::serve
