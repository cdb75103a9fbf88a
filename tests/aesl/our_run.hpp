// A case through our compiler and our machine, as an Outcome; and what the tests of this folder and
// of tests/aesl_peer share.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "aesl/compile.hpp"
#include "aesl/node_file.hpp"
#include "reference/outcome.hpp"

namespace vagus::aesl {

// Words of bytecode are counted so that callers can leave out what another compiler cannot do.
struct OurRun {
    Outcome outcome;
    size_t bytecode_words = 0;
    std::string message;  // of the error
};
OurRun run_ours(const Case& program, const NodeFile& node, Dialect dialect = Dialect::Auto);

// Errors that say that a program is too large for the node: another compiler may manage it.
bool is_want_of_room(const Outcome& outcome);

// The node of testdata/golden/aesl.
NodeFile golden_node();

// NNN-name of every golden case, in order.
std::vector<std::string> golden_names();
Golden golden_case(const std::string& name);

// Leaves in `outcome.memory` what the README of the golden cases has in `memory`: the user's
// variables, and of the node's those that are not all zero.
Outcome in_golden_form(Outcome outcome, const NodeFile& node);

// Seeds to run: `count` from 1 on; VAGUS_LONG multiplies the count by 20; VAGUS_SEED names a single
// one.
std::vector<uint64_t> seeds(uint64_t count);

// For messages: how to repeat the case, its text, and both outcomes.
std::string explain(uint64_t seed, const Case& program, const std::string& expected,
                    const std::string& found);

}  // namespace vagus::aesl
