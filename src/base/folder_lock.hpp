// A folder, or a file, that one process uses at a time.
//
//     const FolderLock lock = TRY(FolderLock::take("boards"));
//
// The system lets go of it when the process ends, in whatever way: nothing has to be cleaned up
// after one that was killed.
#pragma once

#include <string>

#include "base/result.hpp"

namespace vagus {

class FolderLock {
public:
    // Makes the folder if it is not there. Refused: another one holds it. Unavailable: it cannot be
    // made or opened, and why.
    static Result<FolderLock> take(const std::string& path);
    // For a file that is replaced when it is written, so that a lock on itself would be lost: the
    // lock is on PATH.lock beside it, which stays there. Links to a file that is there share it.
    // Refused and Unavailable as above.
    static Result<FolderLock> take_file(const std::string& path);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&&) = delete;

    // False: the file system has no locks, so another process may use the folder, too.
    bool holds() const { return holds_; }

private:
    // Of what is open; it is closed with the lock. `taken`: what is said where another holds it.
    static Result<FolderLock> lock(int open, const std::string& taken);
    FolderLock(int folder, bool holds) : folder_(folder), holds_(holds) {}

    int folder_ = -1;  // -1: it was moved
    bool holds_ = false;
};

}  // namespace vagus
