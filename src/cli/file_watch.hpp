// Notices that files were saved. Editors write a file in pieces, or write another and rename it: a
// change counts once the file stayed the same for two looks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"

namespace vagus::cli {

// With two looks a change is told after half a second at most.
constexpr Duration kLookEvery = std::chrono::milliseconds(150);

class FileWatch {
public:
    explicit FileWatch(std::vector<std::string> paths);
    // Those that are watched already stay as they are; true if there was another. A caller that has
    // read a file before it was watched reads it again, to miss no save.
    bool add(const std::vector<std::string>& paths);
    // Paths of files that were saved since; `now` is any steady time. Cheap between the looks.
    std::vector<std::string> changed(Time now);

private:
    // What tells one state of a file from another; size -1: not there.
    struct Mark {
        int64_t written = 0;
        int64_t size = -1;
        friend bool operator==(const Mark&, const Mark&) = default;
    };
    struct Watched {
        std::string path;
        Mark told;
        Mark seen;
    };
    static Mark look(const std::string& path);

    std::vector<Watched> files_;
    std::optional<Time> next_;
};

}  // namespace vagus::cli
