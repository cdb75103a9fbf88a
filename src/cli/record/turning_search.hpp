// The search for the instant at which something was decided (trial/turning.hpp), with each
// continuation in a process of its own.
//
//     const auto found = find_turning_point(*continued, reader, {.file = "run.mcap"}, tell);
//     if (found.ok()) print(trial::format_turning(found.value()));
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "mcap/reader.hpp"
#include "trial/continuation.hpp"
#include "trial/turning_text.hpp"

namespace vagus::cli {

struct TurningSearch {
    std::string file = {};  // the recording
    int64_t tries = trial::kTriesUsual;
    int64_t at_once = 0;                    // 0: as many as there are processors
    std::string results = "turning-point";  // where the two continuations go
    std::string robot = {};                 // whose condition it is, in a fleet
};

enum class SearchStage : uint8_t { Run, Curve, Narrowing, Recordings };
struct SearchProgress {
    SearchStage stage = SearchStage::Run;
    size_t done = 0, of = 0;  // continuations of those that are asked for now
};
// False: nobody waits for it any more, and the search ends with an Error.
using TellSearch = std::function<bool(const SearchProgress&)>;

// `reader` is of the recording of `continued`. An Error of another code than BadInput is of a
// continuation that could not be run.
Result<trial::TurningTold> find_turning_point(trial::Continued& continued,
                                              const mcap::Reader& reader,
                                              const TurningSearch& search, const TellSearch& told);

}  // namespace vagus::cli
