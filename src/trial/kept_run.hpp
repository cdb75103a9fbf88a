// A run that is kept as a test which passes. A test runs the files of now from the beginning; the
// run may have been changed on its way, continued from an instant, or touched by hand. So the test
// is run once: where it does otherwise than the recording, it expects what the files of now do.
//
//     const KeptRun kept = TRY(keep_run(reader, {"Wall.test.json", scratch.path() + "/run.mcap"}));
//     TRY(write_file("Wall.test.json", kept.draft.text));
//     if (kept.differs) say("it expects what your files do from the beginning");
#pragma once

#include <string>

#include "base/result.hpp"
#include "mcap/reader.hpp"
#include "trial/from_recording.hpp"

namespace vagus::trial {

struct KeptPlace {
    std::string test;     // where the test is to lie: beside its plan, or its world
    std::string scratch;  // a file for the recording of that one run
};

struct KeptRun {
    Draft draft;
    bool differs = false;  // from the beginning the run was another one than the recorded one
};

// Where nothing touched the robot the test expects that, too; also where that needs what a person
// set in the run to be so from its start. A run that is not possible now is
// drafted from its recording alone. The Error says why there can be no test of it.
Result<KeptRun> keep_run(const mcap::Reader& reader, const KeptPlace& place);

}  // namespace vagus::trial
