#include "base/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace vagus {

Result<FolderLock> FolderLock::take(const std::string& path) {
    std::error_code failed;
    std::filesystem::create_directories(path, failed);
    if (failed) return Error{Code::Unavailable, path + ": " + failed.message()};
    const int folder = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return Error{Code::Unavailable, path + ": " + std::strerror(errno)};
    return lock(folder, path + ": another program uses this folder");
}

Result<FolderLock> FolderLock::take_file(const std::string& path) {
    std::error_code failed;  // then the path as it was given
    const std::filesystem::path found = std::filesystem::weakly_canonical(path, failed);
    const std::string beside = (failed ? path : found.string()) + ".lock";
    const int file = ::open(beside.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) return Error{Code::Unavailable, beside + ": " + std::strerror(errno)};
    return lock(file, path + ": another program uses this file");
}

Result<FolderLock> FolderLock::lock(int open, const std::string& taken) {
    const bool holds = ::flock(open, LOCK_EX | LOCK_NB) == 0;
    const bool is_taken = !holds && errno == EWOULDBLOCK;
    FolderLock made(open, holds);
    if (is_taken) return Error{Code::Refused, taken};
    return made;
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::exchange(other.folder_, -1)), holds_(other.holds_) {}

FolderLock::~FolderLock() {
    if (folder_ >= 0) ::close(folder_);
}

}  // namespace vagus
