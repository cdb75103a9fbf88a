#include "serve/workbench/recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <utility>

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kBegins = "run-";
constexpr std::string_view kEnds = ".mcap";

// Recordings of a folder by their numbers, each with its size.
std::map<uint64_t, std::pair<fs::path, uint64_t>> recordings_in(const fs::path& folder) {
    std::map<uint64_t, std::pair<fs::path, uint64_t>> found;
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(kBegins) || !name.ends_with(kEnds)) continue;
        uint64_t number = 0;
        const char* const end = name.data() + name.size() - kEnds.size();
        const auto read = std::from_chars(name.data() + kBegins.size(), end, number);
        if (read.ec != std::errc() || read.ptr != end) continue;
        std::error_code unknown;
        const uint64_t size = entry.file_size(unknown);
        found[number] = {entry.path(), unknown ? 0 : size};
    }
    return found;
}

}  // namespace

void Recordings::enter(fs::path folder) {
    folder_ = std::move(folder);
    now_.clear();
    before_.clear();
}

Result<std::string> Recordings::next(bool had_begun, const std::string& needed) {
    over(had_begun);
    if (folder_.empty()) return Error{Code::Unavailable, "no project is open"};
    std::error_code failed;
    fs::create_directories(folder_, failed);
    if (failed) {
        return Error{Code::Unavailable, fmt::format("{}: this folder for recordings cannot be "
                                                    "made: {}",
                                                    folder_.string(), failed.message())};
    }
    make_room(needed);
    const auto all = recordings_in(folder_);
    const uint64_t number = all.empty() ? 1 : all.rbegin()->first + 1;
    now_ = (folder_ / fmt::format("{}{}{}", kBegins, number, kEnds)).string();
    return now_;
}

// One in which no time has passed deletes its file when it ends.
void Recordings::over(bool had_begun) {
    std::error_code failed;
    if (had_begun && !now_.empty() && fs::exists(now_, failed)) before_ = now_;
    now_.clear();
}

void Recordings::make_room(const std::string& needed) const {
    const auto all = recordings_in(folder_);
    size_t count = all.size();
    uint64_t bytes = 0;
    for (const auto& [number, one] : all) bytes += one.second;
    for (const auto& [number, one] : all) {
        const auto& [path, size] = one;
        const bool fits = count <= kRecordingsKept && bytes <= kRecordingsBytesMax;
        if (fits || path.string() == before_) return;
        if (path.string() == needed) continue;
        std::error_code ignored;
        fs::remove(path, ignored);
        bytes -= size;
        --count;
    }
}

std::vector<Recordings::Kept> Recordings::kept() const {
    using std::chrono::duration_cast, std::chrono::file_clock, std::chrono::milliseconds;
    std::vector<Kept> kept;
    for (const auto& [number, one] : recordings_in(folder_)) {
        const auto& [path, bytes] = one;
        if (path.string() == now_) continue;
        std::error_code unknown;
        const auto written = file_clock::to_sys(fs::last_write_time(path, unknown));
        if (unknown) continue;  // it has just gone
        const auto since = duration_cast<milliseconds>(written.time_since_epoch());
        kept.push_back({path.string(), number, bytes, static_cast<double>(since.count())});
    }
    std::ranges::reverse(kept);
    return kept;
}

bool Recordings::keeps(const std::string& path) const {
    return std::ranges::any_of(kept(), [&path](const Kept& one) { return one.path == path; });
}

std::string Recordings::of_run(bool has_begun) const {
    return has_begun || before_.empty() ? now_ : before_;
}

}  // namespace vagus::serve
