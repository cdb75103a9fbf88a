#include "cli/file_watch.hpp"

#include <algorithm>
#include <filesystem>

namespace vagus::cli {

FileWatch::FileWatch(std::vector<std::string> paths) {
    (void)add(paths);
}

bool FileWatch::add(const std::vector<std::string>& paths) {
    bool added = false;
    for (const std::string& path : paths) {
        const bool known = std::any_of(files_.begin(), files_.end(),
                                       [&path](const Watched& file) { return file.path == path; });
        const Mark mark = look(path);
        if (!known) files_.push_back({path, mark, mark});
        added = added || !known;
    }
    return added;
}

FileWatch::Mark FileWatch::look(const std::string& path) {
    std::error_code none;
    const auto written = std::filesystem::last_write_time(path, none);
    if (none) return {};
    const auto size = std::filesystem::file_size(path, none);
    if (none) return {};
    return {written.time_since_epoch().count(), static_cast<int64_t>(size)};
}

std::vector<std::string> FileWatch::changed(Time now) {
    if (next_ && now < *next_) return {};
    next_ = now + kLookEvery;
    std::vector<std::string> paths;
    for (Watched& file : files_) {
        const Mark mark = look(file.path);
        const bool rests = mark == file.seen;
        file.seen = mark;
        // A file that is gone for a moment is on its way to be replaced.
        if (!rests || mark == file.told || mark.size < 0) continue;
        file.told = mark;
        paths.push_back(file.path);
    }
    return paths;
}

}  // namespace vagus::cli
