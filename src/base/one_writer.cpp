#include "base/one_writer.hpp"

#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace vagus {

// The lock goes with the descriptor, so a writer that was killed holds nothing. A file system
// without locks refuses nobody.
Status begin_to_write(int descriptor, const std::string& path) {
    struct stat found = {};
    if (::fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode)) return Status::done();
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        return Error{Code::Refused, path +
                                        ": another program is writing it; name another file, or "
                                        "wait until that one has ended"};
    }
    if (::ftruncate(descriptor, 0) == 0) return Status::done();
    return Error{Code::Unavailable, path + ": cannot be written: " + std::strerror(errno)};
}

}  // namespace vagus
