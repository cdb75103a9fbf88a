// Files: the only part of `base` that touches the system.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace vagus {

constexpr size_t kFileBytesMax = 256u << 20;

// The whole file. The Error names the file and the system's reason. "-" is standard input.
Result<std::string> read_file(const std::string& path);

// Writes beside the file and renames over it, so that a crash leaves the old file or the new one,
// never half of it.
// What is no file (/dev/stdout, a pipe) is written to as it is.
Status write_file(const std::string& path, std::string_view content);

}  // namespace vagus
