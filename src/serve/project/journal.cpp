#include "serve/project/journal.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "base/file.hpp"
#include "serve/project/paths.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMark = "vagus-journal/1 ";  // base, size, path, newline, text
constexpr size_t kEntriesMax = 2000;

std::optional<std::pair<std::string, Unsaved>> parse(std::string_view file) {
    const size_t line_end = file.find('\n');
    if (!file.starts_with(kMark) || line_end == file.npos) return std::nullopt;
    std::string_view line = file.substr(kMark.size(), line_end - kMark.size());
    Unsaved unsaved;
    size_t size = 0;
    auto [behind_base, bad_base] =
        std::from_chars(line.data(), line.data() + line.size(), unsaved.base, 16);
    if (bad_base != std::errc() || behind_base == line.data() + line.size()) return std::nullopt;
    line.remove_prefix(static_cast<size_t>(behind_base - line.data()) + 1);
    auto [behind_size, bad_size] = std::from_chars(line.data(), line.data() + line.size(), size);
    if (bad_size != std::errc() || behind_size == line.data() + line.size()) return std::nullopt;
    line.remove_prefix(static_cast<size_t>(behind_size - line.data()) + 1);
    unsaved.text = file.substr(line_end + 1);
    if (unsaved.text.size() != size || !check_path(line).ok()) return std::nullopt;
    return std::pair(std::string(line), std::move(unsaved));
}

}  // namespace

uint64_t hash_of(std::string_view text) {
    uint64_t hash = 0xcbf29ce484222325;
    for (const char letter : text) {
        hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
    }
    return hash;
}

std::map<std::string, Unsaved> Journal::read() const {
    std::map<std::string, Unsaved> found;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder_, failed)) {
        if (!entry.is_regular_file() || found.size() >= kEntriesMax) continue;
        const Result<std::string> file = read_file(entry.path().string());
        if (!file.ok()) continue;
        if (auto parsed = parse(file.value())) found.insert(std::move(*parsed));
    }
    return found;
}

Status Journal::write(const std::string& path, const Unsaved& unsaved) const {
    std::error_code failed;
    fs::create_directories(folder_, failed);
    return write_file(entry_of(path).string(),
                      fmt::format("{}{:x} {} {}\n{}", kMark, unsaved.base, unsaved.text.size(),
                                  path, unsaved.text));
}

void Journal::forget(const std::string& path) const {
    std::error_code failed;
    fs::remove(entry_of(path), failed);
}

fs::path Journal::entry_of(const std::string& path) const {
    return folder_ / fmt::format("{:016x}", hash_of(path));
}

}  // namespace vagus::serve
