// Writes a test from a recording: of a plan's run the order in which actors first came, by when the
// last of them had, and how it ended, with some room: for a person to trim. Without a plan it is
// from_scripts.hpp that writes it.
//
//     const Draft draft = TRY(draft_test(reader));
//     TRY(write_file("Wall.test.json", draft.text));
#pragma once

#include <string>
#include <vector>

#include "base/result.hpp"
#include "mcap/reader.hpp"

namespace vagus::trial {

constexpr double kRoom = 1.25;  // times what it took then

struct DraftOptions {
    bool untouched = false;  // in a world: it expects, too, that nothing ever touches the robot
    bool events = true;      // without a plan: it expects those that came first
    bool set = false;        // variables that a person set in that run have those values from its
                             // start
};

struct Draft {
    std::string text = {};                // of the test file
    std::string plan = {}, world = {};    // files that it names, as it names them; perhaps empty
    bool was_set = false;                 // a person set variables of the plan in that run
    std::vector<std::string> hints = {};  // what a test cannot do again
};

// The test is to lie beside its plan, or its world. A run that had not ended, or that a person
// ended, is one whose time was over then. The Error says why there can be no test of it.
Result<Draft> draft_test(const mcap::Reader& reader, const DraftOptions& options = {});

}  // namespace vagus::trial
