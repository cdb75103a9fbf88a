// A recording of a real bus, run again openly: the plan decides again on what it heard, no node is
// there, no wheel turns (past_bus.hpp).
#pragma once

#include <memory>

#include "record/replay.hpp"

namespace vagus::record {

// What Rerun::open() gives for a recording of that kind. The Error says what cannot be asked of it.
Result<std::unique_ptr<Rerun>> open_bus_rerun(const mcap::Reader& reader, RunFile about,
                                              const RerunOptions& options);

}  // namespace vagus::record
