// A folder for as long as its owner lives, below the system's folder for such ones ($TMPDIR).
//
//     const TemporaryFolder folder = TRY(TemporaryFolder::make("unpacked"));
//     write_file(folder.path() + "/index.html", page);
//
// A process that is killed deletes nothing. So each folder is locked by its owner, and whoever
// makes one first deletes those of the same name whose owner has ended: the system lets go of its
// locks.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace vagus {

class TemporaryFolder {
public:
    // vagus-NAME-XXXXXX, which only this user may read. The Error names what could not be made.
    static Result<TemporaryFolder> make(std::string_view name);
    // With all that is in it.
    ~TemporaryFolder();
    TemporaryFolder(TemporaryFolder&& other) noexcept;
    TemporaryFolder& operator=(TemporaryFolder&&) = delete;

    const std::string& path() const { return path_; }

private:
    TemporaryFolder(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}

    std::string path_;  // empty: it was moved
    int lock_ = -1;     // copies of this process have it, too, until they end
};

}  // namespace vagus
