// What nodes have told of themselves: of equal descriptions there is one.
#pragma once

#include <algorithm>
#include <vector>

#include "aesl/target.hpp"
#include "base/shared_value.hpp"

namespace vagus::debug {

// Different descriptions that are looked at; a network has few kinds of nodes. Of further ones each
// node has its own.
constexpr size_t kTargetsKept = 64;

class KnownTargets {
public:
    // The one that is equal, or this one from now on.
    SharedValue<aesl::Target> of(aesl::Target target) {
        const auto known = std::find_if(known_.begin(), known_.end(),
                                        [&](const auto& one) { return *one == target; });
        if (known != known_.end()) return *known;
        SharedValue<aesl::Target> own(std::move(target));
        if (known_.size() < kTargetsKept) known_.push_back(own);
        return own;
    }

private:
    std::vector<SharedValue<aesl::Target>> known_;
};

}  // namespace vagus::debug
