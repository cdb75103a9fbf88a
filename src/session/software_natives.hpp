// The natives that software nodes have code for, by their names: the 30 of natives.def, and two for tests of
// compilers, sys.nop() and sys.sum(dest, src) (testdata/golden/aesl/README.md).
#pragma once

#include <string_view>

#include "aesl/target.hpp"
#include "base/result.hpp"
#include "node/description.hpp"

namespace vagus::session {

// The code for a native of that name. Fails if there is none, or if it takes another number of words from the stack
// than the parameters say: then it would read its arguments from the wrong places.
Result<node::NativeFunction> code_of_native(const aesl::NativeFunction& native);

}  // namespace vagus::session
