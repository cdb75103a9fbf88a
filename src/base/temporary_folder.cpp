#include "base/temporary_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <utility>

namespace vagus {
namespace {

constexpr std::string_view kDrawn = "XXXXXX";
constexpr int kMadeMax = 10;  // tries

int open_folder(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

bool is_own(int folder) {
    struct stat its = {};
    return ::fstat(folder, &its) == 0 && its.st_uid == ::geteuid();
}

void delete_folder(const std::filesystem::path& path) {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
}

// Whoever has the lock of a folder may delete it.
void delete_without_owner(const std::filesystem::path& path) {
    const int folder = open_folder(path);
    if (folder < 0) return;
    if (is_own(folder) && ::flock(folder, LOCK_EX | LOCK_NB) == 0) delete_folder(path);
    ::close(folder);
}

void delete_those_without_owner(const std::filesystem::path& among, const std::string& prefix) {
    std::error_code error;
    std::filesystem::directory_iterator entry(among, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        const bool is_one =
            name.size() == prefix.size() + kDrawn.size() && name.starts_with(prefix);
        if (is_one) delete_without_owner(entry->path());
    }
}

// Between the making and the locking another process may have taken it for one without owner.
bool is_still_there(const std::string& path, int folder) {
    struct stat named = {}, locked = {};
    return ::stat(path.c_str(), &named) == 0 && ::fstat(folder, &locked) == 0 &&
           named.st_ino == locked.st_ino;
}

}  // namespace

Result<TemporaryFolder> TemporaryFolder::make(std::string_view name) {
    std::error_code error;
    const std::filesystem::path among = std::filesystem::temp_directory_path(error);
    const std::string prefix = "vagus-" + std::string(name) + "-";
    std::string path = (among / (prefix + std::string(kDrawn))).string();
    if (!error) delete_those_without_owner(among, prefix);
    for (int tries = 0; !error && tries < kMadeMax; ++tries) {
        path = (among / (prefix + std::string(kDrawn))).string();
        if (::mkdtemp(path.data()) == nullptr) break;
        const int folder = open_folder(path);
        if (folder < 0) continue;
        // Where the disk has no locks, nobody deletes it but its owner.
        (void)::flock(folder, LOCK_EX);
        if (is_still_there(path, folder)) return TemporaryFolder(path, folder);
        ::close(folder);
    }
    return Error{Code::Unavailable, path + ": no folder can be made there; is the disk full?"};
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}

TemporaryFolder::~TemporaryFolder() {
    if (!path_.empty()) delete_folder(path_);
    if (lock_ >= 0) ::close(lock_);
}

}  // namespace vagus
