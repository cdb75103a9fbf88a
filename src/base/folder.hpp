// Folders on the disk.
#pragma once

#include <string>

#include "base/result.hpp"

namespace vagus {

// Names in a folder survive a power cut from now on: those that were created, renamed and deleted.
Status sync_folder(const std::string& path);

}  // namespace vagus
