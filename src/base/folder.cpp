#include "base/folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace vagus {

Status sync_folder(const std::string& path) {
    const int folder = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool synced = folder >= 0 && ::fsync(folder) == 0;
    const int reason = errno;
    if (folder >= 0) ::close(folder);
    if (synced) return Status::done();
    return Error{Code::Unavailable,
                 path + ": cannot be written to the disk: " + std::strerror(reason)};
}

}  // namespace vagus
