// Valid programs made up from a seed: every kind of statement, vectors, slices, computed indices,
// natives, deques, subs, events, `when` in loops, constants, odd layout. The same seed gives the
// same program in every run of one build. For tests only.
#pragma once

#include <cstdint>

#include "aesl/node_file.hpp"
#include "reference/outcome.hpp"

namespace vagus::aesl {

// What the programs may use.
enum class Avoid {
    Nothing,
    // Where the specification says that the reference is wrong: `deque.insert` (A.2), a sub whose
    // last instruction is a `return` in an `if` (4.8).
    DefectsOfTheReference,
};

// The node for which programs are generated: that of the golden cases, with more room, so that few
// programs fail for want of it (the reference never releases temporaries, section 4.5).
NodeFile roomy(NodeFile golden_node);

// A program for `node`, which has the variables, events and natives of the golden node, and a few
// stimuli. Most programs compile and run; some end in a run-time error, and a few in a compile
// error or an endless loop.
Case generate(uint64_t seed, const NodeFile& node, Avoid avoid);

}  // namespace vagus::aesl
