// A version of a project as one file, for robots that fetch it: the list of its files as
// deployed.json has it, on one line, and behind it their bytes in the same order.
//
//     const CollectedBundle collected = TRY(collect_bundle(project));
//     const std::string bytes = TRY(pack(collected));
//     const Packed packed = TRY(unpack(bytes));
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "serve/workbench/bundle.hpp"

namespace vagus::serve {

constexpr size_t kPackedBytesMax = kBundleBytesMax + (4u << 20);

struct Packed {
    Bundle bundle;
    std::vector<std::string> contents;  // of its files, in their order
};

// The Error names a file that cannot be read, or changed meanwhile.
Result<std::string> pack(const CollectedBundle& collected);
// The hashes of the files are checked where they are written down (deployments.hpp).
Result<Packed> unpack(std::string_view bytes);

}  // namespace vagus::serve
