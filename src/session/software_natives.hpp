// The natives that software nodes have code for, by their names: the 30 of natives.def, and two for
// tests of compilers, sys.nop() and sys.sum(dest, src) (testdata/golden/aesl/README.md).
#pragma once

#include <string_view>

#include "aesl/target.hpp"
#include "base/result.hpp"
#include "node/description.hpp"

namespace vagus::session {

// The native of that name that has code here (not null). Fails if there is none, or if it takes
// another number of words from the stack than the parameters say: then it would read its arguments
// from the wrong places.
Result<const node::Native*> code_of_native(const aesl::NativeFunction& native);

}  // namespace vagus::session
