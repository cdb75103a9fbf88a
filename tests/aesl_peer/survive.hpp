// Runs work that may crash or hang (the reference does, on some inputs) in child processes, so that
// the rest of the work goes on.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace vagus::aesl {

struct Survivors {
    std::vector<std::string> said;  // what each piece of work returned; empty if it was killed
    std::vector<size_t> killed;     // the pieces of work that ended their process
};

// Calls `work` for 0 … count-1 in order. A piece that crashes, or takes more than a few seconds of
// the processor, ends only itself.
Survivors survive(size_t count, const std::function<std::string(size_t)>& work);

}  // namespace vagus::aesl
