#include "serve/project/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/file.hpp"
#include "serve/project/difference.hpp"
#include "serve/project/paths.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMark1 = "vagus-journal/1 ";  // base, size, path, newline, text
constexpr std::string_view kMark = "vagus-journal/2 ";   // path, newline, records
constexpr size_t kEntriesMax = 2000;

// A record is a line of words, the last one a check of the others and of the bytes behind it:
//     whole - 12 9ae16a3b2f90404f       no file, 12 bytes of text
//     whole 10 12 9ae16a3b2f90404f      10 bytes of the file, then the text
//     change 3 5 7 9ae16a3b2f90404f     bytes 3 to 5 of the text become these 7
//     deleted 9ae16a3b2f90404f          the file is in the trash
std::string record(const std::string& words, std::string_view bytes) {
    return fmt::format("{} {:016x}\n{}", words, hash_of(words + std::string(bytes)), bytes);
}

template <typename Number>
std::optional<Number> number_of(std::string_view word, int radix = 10) {
    Number number = 0;
    const auto [end, bad] = std::from_chars(word.data(), word.data() + word.size(), number, radix);
    if (bad != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return number;
}

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        const size_t end = line.find(' ');
        words.push_back(line.substr(0, end));
        if (end == line.npos) return words;
        line.remove_prefix(end + 1);
    }
}

// Reads records one behind the other; false at the first that is none.
class Records {
public:
    explicit Records(std::string_view file) : rest_(file) {}

    // Whether there is a sound text at all.
    bool read(Unsaved& unsaved) {
        if (!read_line() || !read_whole(unsaved)) return false;
        while (read_line() && (read_change(unsaved) || read_deleted(unsaved))) {
        }
        return true;
    }
    size_t left() const { return rest_.size(); }

private:
    bool read_line() {
        const size_t end = rest_.find('\n');
        if (end == rest_.npos) return false;
        line_ = rest_.substr(0, end);
        words_ = words_of(line_);
        return true;
    }
    std::optional<size_t> size_at(size_t word) const {
        const auto size = number_of<size_t>(words_[word]);
        return size && *size <= rest_.size() ? size : std::nullopt;
    }
    // The bytes behind the line, if their check is right.
    std::optional<std::string_view> bytes(size_t size) const {
        const size_t at = line_.size() + 1;
        if (at + size > rest_.size()) return std::nullopt;
        const std::string_view found = rest_.substr(at, size);
        const std::string_view said = words_.back();
        const std::string words(line_.substr(0, line_.size() - said.size() - 1));
        const auto check = number_of<uint64_t>(said, 16);
        if (check != hash_of(words + std::string(found))) return std::nullopt;
        return found;
    }
    void pass(size_t size) { rest_.remove_prefix(line_.size() + 1 + size); }

    bool read_whole(Unsaved& unsaved) {
        if (words_.size() != 4 || words_[0] != "whole") return false;
        const bool is_new = words_[1] == "-";
        const auto base = is_new ? std::optional<size_t>(0) : size_at(1);
        const auto size = size_at(2);
        if (!base || !size) return false;
        const auto found = bytes(*base + *size);
        if (!found) return false;
        if (!is_new) unsaved.base = std::string(found->substr(0, *base));
        unsaved.text = std::string(found->substr(*base));
        pass(*base + *size);
        return true;
    }
    bool read_change(Unsaved& unsaved) {
        if (words_.size() != 5 || words_[0] != "change") return false;
        const auto from = number_of<size_t>(words_[1]);
        const auto to = number_of<size_t>(words_[2]);
        const auto size = size_at(3);
        if (!from || !to || !size || *from > *to || *to > unsaved.text.size()) return false;
        const auto found = bytes(*size);
        if (!found) return false;
        unsaved.text.replace(*from, *to - *from, *found);
        pass(*size);
        return true;
    }

    bool read_deleted(Unsaved& unsaved) {
        if (words_.size() != 2 || words_[0] != "deleted" || !bytes(0)) return false;
        unsaved.deleted = true;
        pass(0);
        return true;
    }

    std::string_view rest_, line_;
    std::vector<std::string_view> words_;
};

std::optional<std::pair<std::string, Unsaved>> parse_1(std::string_view file) {
    const size_t line_end = file.find('\n');
    if (!file.starts_with(kMark1) || line_end == file.npos) return std::nullopt;
    std::string_view line = file.substr(kMark1.size(), line_end - kMark1.size());
    const std::vector<std::string_view> words = words_of(line);
    if (words.size() < 3) return std::nullopt;
    const auto base = number_of<uint64_t>(words[0], 16);
    const auto size = number_of<size_t>(words[1]);
    line.remove_prefix(words[0].size() + words[1].size() + 2);
    Unsaved unsaved;
    unsaved.text = file.substr(line_end + 1);
    unsaved.base_hash = base;
    if (!base || size != unsaved.text.size() || !check_path(line).ok()) return std::nullopt;
    return std::pair(std::string(line), std::move(unsaved));
}

// "1f.8" is the eighth that was begun in the folder.
uint64_t number_in(const std::string& file) {
    const size_t dot = file.rfind('.');
    return dot == file.npos ? 0 : number_of<uint64_t>(file.substr(dot + 1)).value_or(0);
}

}  // namespace

uint64_t hash_of(std::string_view text) {
    uint64_t hash = 0xcbf29ce484222325;
    for (const char letter : text) {
        hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3;
    }
    return hash;
}

Journal::Journal(fs::path folder, DiskSync& sync, uint64_t first)
    : folder_(std::move(folder)), sync_(&sync), next_number_(first) {}

std::map<std::string, Unsaved> Journal::read() {
    std::error_code failed;
    for (auto entry = fs::directory_iterator(folder_, failed);
         !failed && entry != fs::directory_iterator(); entry.increment(failed)) {
        std::error_code no_file;
        if (entries_.size() >= kEntriesMax || !entry->is_regular_file(no_file)) continue;
        next_number_ = std::max(next_number_, number_in(entry->path().filename().string()) + 1);
        read_entry(entry->path().string(), entries_);
    }
    std::map<std::string, Unsaved> found;
    for (const auto& [path, entry] : entries_) found[path] = entry.unsaved;
    return found;
}

void Journal::read_entry(const std::string& file, std::map<std::string, Entry>& found) const {
    const Result<std::string> read = read_file(file);
    if (!read.ok()) return;
    const std::string_view text = read.value();
    Entry entry{.number = number_in(fs::path(file).filename().string()), .file = file};
    std::string path;
    if (auto old = parse_1(text)) {
        path = old->first;
        entry.unsaved = std::move(old->second);
        entry.obsolete = {std::exchange(entry.file, "")};
    } else {
        const size_t line_end = text.find('\n');
        if (!text.starts_with(kMark) || line_end == text.npos) return;
        path = text.substr(kMark.size(), line_end - kMark.size());
        Records records(text.substr(line_end + 1));
        if (!check_path(path).ok() || !records.read(entry.unsaved)) return;
        entry.bytes = text.size();
        // Behind what was cut off nothing could be read.
        if (records.left() > 0) entry.obsolete = {std::exchange(entry.file, "")};
    }
    const auto known = found.find(path);
    if (known == found.end()) {
        found.emplace(path, std::move(entry));
        return;
    }
    // The newer one counts.
    Entry& kept = known->second;
    if (entry.number > kept.number) std::swap(kept, entry);
    if (!entry.file.empty()) kept.obsolete.push_back(entry.file);
    kept.obsolete.insert(kept.obsolete.end(), entry.obsolete.begin(), entry.obsolete.end());
}

Status Journal::write(const std::string& path, const Unsaved& unsaved) {
    Entry& entry = entries_[path];
    const bool too_long = entry.bytes > 2 * unsaved.text.size() + kJournalSlackBytes;
    // Another length: another studio has the folder open, too, or somebody took the file away.
    std::error_code gone;
    const bool goes_on = !entry.file.empty() && !too_long && entry.unsaved.base == unsaved.base &&
                         entry.unsaved.deleted == unsaved.deleted &&
                         fs::file_size(entry.file, gone) == entry.bytes;
    return goes_on ? append(entry, unsaved) : begin(path, entry, unsaved);
}

Status Journal::begin(const std::string& path, Entry& entry, const Unsaved& unsaved) {
    std::error_code failed;
    fs::create_directories(folder_, failed);
    const std::string base = unsaved.base.value_or("");
    const std::string size = unsaved.base ? std::to_string(base.size()) : "-";
    const std::string words = fmt::format("whole {} {}", size, unsaved.text.size());
    const std::string deleted = unsaved.deleted ? record("deleted", "") : "";
    const std::string content =
        fmt::format("{}{}\n{}{}", kMark, path, record(words, base + unsaved.text), deleted);
    const auto file_of = [&](uint64_t number) {
        return (folder_ / fmt::format("{:016x}.{}", hash_of(path), number)).string();
    };
    while (fs::exists(file_of(next_number_), failed)) ++next_number_;
    const uint64_t number = next_number_++;
    const std::string file = file_of(number);
    const Status written = append_file(file, content);
    if (!written.ok()) {
        fs::remove(file, failed);
        return written;
    }
    std::vector<std::string> obsolete = std::move(entry.obsolete);
    if (!entry.file.empty()) obsolete.push_back(entry.file);
    sync_->post(file, obsolete);
    entry = {number, file, std::move(obsolete), unsaved, content.size()};
    return Status::done();
}

Status Journal::append(Entry& entry, const Unsaved& unsaved) {
    const TextDifference change = difference(entry.unsaved.text, unsaved.text);
    const std::string words =
        fmt::format("change {} {} {}", change.from, change.to, change.insert.size());
    const std::string content = record(words, change.insert);
    TRY(append_file(entry.file, content));
    sync_->post(entry.file);
    entry.bytes += content.size();
    entry.unsaved.text = unsaved.text;
    return Status::done();
}

void Journal::forget(const std::string& path) {
    const auto entry = entries_.extract(path);
    if (entry.empty()) return;
    std::error_code failed;
    fs::remove(entry.mapped().file, failed);
    for (const std::string& file : entry.mapped().obsolete) fs::remove(file, failed);
}

}  // namespace vagus::serve
