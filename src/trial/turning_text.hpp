// What `vagus why FILE --turning-point` says.
//
//     print(format_turning(told));
#pragma once

#include <string>

#include "record/why.hpp"
#include "trial/continuation.hpp"
#include "trial/turning.hpp"

namespace vagus::trial {

// All that was found.
struct TurningTold {
    std::string file = {};       // the recording
    std::string robot = {};      // whose condition it is, where robots have projects of their own
    std::string condition = {};  // as it was typed
    TurningQuestion question = {};
    RunEnd run = {};  // as it was recorded
    Turning turning = {};
    record::Chain there = {};  // what there was where it turned
    // Recordings of continuations from before it turned; empty: there was none.
    std::string with = {};
    std::string without = {};
};

// What was found, as one sentence: where it turned, or that chance did not decide it.
std::string turning_sentence(const Turning& turning);
// The curve, the instant at which it turned, what was there, and the two recordings; or that chance
// did not decide it.
std::string format_turning(const TurningTold& told);
// The same as one object of JSON (docs/formats.md).
std::string format_turning_json(const TurningTold& told);

}  // namespace vagus::trial
