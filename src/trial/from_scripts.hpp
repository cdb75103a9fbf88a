// Writes a test from a recording of robots that ran their scripts, without a plan: which user
// events first came, and by when, and where the robot was at the end.
//
//     const Draft draft = TRY(draft_script_test(reader, {.untouched = true}));
#pragma once

#include "trial/from_recording.hpp"

namespace vagus::trial {

constexpr size_t kEventsDrafted = 3;    // different ones, the first that came
constexpr double kPlaceRoom = 0.1;      // m, to each side of where it was
constexpr double kScriptsRunMin = 0.5;  // s of a run that says something

// Called by draft_test(), and as that. The test is to lie beside its world. Of several robots it is
// about the first.
Result<Draft> draft_script_test(const mcap::Reader& reader, const DraftOptions& options);

}  // namespace vagus::trial
