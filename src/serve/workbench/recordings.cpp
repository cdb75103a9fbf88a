#include "serve/workbench/recordings.hpp"

#include <fmt/format.h>

#include <charconv>
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

Result<std::string> Recordings::next(bool had_begun) {
    none(had_begun);
    if (folder_.empty()) return Error{Code::Unavailable, "no project is open"};
    std::error_code failed;
    fs::create_directories(folder_, failed);
    if (failed) {
        return Error{Code::Unavailable, fmt::format("{}: this folder for recordings cannot be "
                                                    "made: {}",
                                                    folder_.string(), failed.message())};
    }
    make_room();
    const auto all = recordings_in(folder_);
    const uint64_t number = all.empty() ? 1 : all.rbegin()->first + 1;
    now_ = (folder_ / fmt::format("{}{}{}", kBegins, number, kEnds)).string();
    return now_;
}

// One in which no time has passed deletes its file when it ends.
void Recordings::none(bool had_begun) {
    std::error_code failed;
    if (had_begun && !now_.empty() && fs::exists(now_, failed)) before_ = now_;
    now_.clear();
}

void Recordings::make_room() const {
    auto all = recordings_in(folder_);
    uint64_t bytes = 0;
    for (const auto& [number, one] : all) bytes += one.second;
    for (auto oldest = all.begin(); oldest != all.end(); oldest = all.erase(oldest)) {
        const auto& [path, size] = oldest->second;
        const bool fits = all.size() <= kRecordingsKept && bytes <= kRecordingsBytesMax;
        if (fits || path.string() == before_) return;
        std::error_code ignored;
        fs::remove(path, ignored);
        bytes -= size;
    }
}

std::string Recordings::of_run(bool has_begun) const {
    return has_begun || before_.empty() ? now_ : before_;
}

}  // namespace vagus::serve
