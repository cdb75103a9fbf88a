// Changes plan files at random, from a seed, in all the ways that P31 speaks of: so that some may
// take over in a plan that runs, some may not, and some are no right plans.
#pragma once

#include <string>

#include "base/rng.hpp"
#include "tests/plans/change_oracle.hpp"

namespace vagus {

// Changes one of the files, up to three times; gives its path. Perhaps it is the same afterwards.
std::string change_at_random(ChangeOracle::Texts& texts, SplitMix64& random);

}  // namespace vagus
