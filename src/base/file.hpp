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
// The same without waiting for the disk, which sync_file() does: a reader of the file gets the new
// content from now on, but a power cut before sync_file() may leave the old one, or none.
Status write_file_unsynced(const std::string& path, std::string_view content);

// Puts bytes behind the end of a file, which is made if it is not there. They are with the system
// then, whatever becomes of this process; sync_file() waits until they are on the disk. What was
// written half is taken back.
Status append_file(const std::string& path, std::string_view content);
// Waits for the disk: seconds, on a slow one. A file that is gone by now is no error.
Status sync_file(const std::string& path);

}  // namespace vagus
