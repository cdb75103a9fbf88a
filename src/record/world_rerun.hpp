// The recording of a world without a plan of its own, run again: `sim`, also with robots that have
// projects, and runs of the studio.
#pragma once

#include <memory>

#include "record/replay.hpp"

namespace vagus::record {

// What Rerun::open() gives for such a recording; the folder has its files.
std::unique_ptr<Rerun> make_world_rerun(RunFile about, UnpackedFolder folder);

}  // namespace vagus::record
