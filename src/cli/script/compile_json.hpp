// The output of `compile --format json` (docs/formats.md, "Outputs").
#pragma once

#include <string>
#include <vector>

#include "aesl/compile.hpp"

namespace vagus::cli {

struct CompiledNode {
    std::string name;
    aesl::Compilation done;
};

std::string compile_json(const std::vector<CompiledNode>& nodes);

}  // namespace vagus::cli
