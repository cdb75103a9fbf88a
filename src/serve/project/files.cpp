#include "serve/project/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "aesl/project.hpp"
#include "aesl/project_text.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "serve/project/difference.hpp"
#include "serve/project/paths.hpp"
#include "serve/project/utf16.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

Error not_there(const std::string& doc) {
    return {Code::NotFound, doc + ": there is no such file in the project"};
}

bool is_project(std::string_view text) {
    const size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    return first != text.npos && text[first] == '<';
}

std::string language_of(const std::string& path, int part, std::string_view text) {
    const std::string kind = kind_of_file(path);
    if (part > 0) return "aesl";
    if (kind == "script") return is_project(text) ? "aesl-file" : "aesl";
    if (kind == "plan" || kind == "world" || kind == "toolbox") return kind;
    return path.ends_with(".json") ? "json" : "text";
}

}  // namespace

std::string kind_of_file(std::string_view path) {
    if (path.ends_with(".aesl")) return "script";
    if (path.ends_with(".plan.json")) return "plan";
    if (path.ends_with(".world.json")) return "world";
    if (path.ends_with(".toolbox.json")) return "toolbox";
    if (path == "vagus.json" || path.ends_with("/vagus.json")) return "project";
    if (path.ends_with(".png") || path.ends_with(".jpg") || path.ends_with(".svg")) {
        return "picture";
    }
    for (const std::string_view end : {".txt", ".md", ".json", ".py", ".c", ".cpp", ".h", ".hpp"}) {
        if (path.ends_with(end)) return "text";
    }
    return "other";
}

Status Files::check_open() const {
    if (is_open()) return Status::done();
    return Error{Code::Unavailable, "no project is open; open one first"};
}

void Files::enter(fs::path root, std::vector<std::string> only) {
    leave();
    root_ = std::move(root);
    only_ = std::move(only);
    journal_ = Journal(root_ / kOwnFolder / "journal");
    waiting_ = journal_.read();
    next_disk_ = next_tick_ = now_;
    std::vector<std::string> paths = only_;
    if (only_.empty()) {
        for (const auto& [path, unsaved] : waiting_) paths.push_back(path);
    }
    for (const std::string& path : paths) {
        if (!waiting_.contains(path) || load(path).ok()) continue;
        // The file is gone, the text is not.
        const auto unsaved = waiting_.extract(path);
        if (unsaved.empty()) continue;
        File& file = files_[path];
        file.gone = true;
        recover(path, file, unsaved.mapped());
    }
}

// A text of an earlier session; `file` is as it is on disk.
void Files::recover(const std::string& path, File& file, Unsaved unsaved) {
    if (file.text == unsaved.text) return journal_.forget(path);
    // The file changed meanwhile: both are shown.
    if (!file.gone && hash_of(file.saved) != unsaved.base) file.disk = file.saved;
    file.text = std::move(unsaved.text);
    file.journaled = true;
    refresh_parts(path, file);
    recovered_.push_back(path);
}

void Files::leave() {
    for (auto& [path, file] : files_) {
        if (file.journal_due) write_journal(path, file);
    }
    ++session_;
    root_.clear();
    only_.clear();
    journal_ = Journal({});
    waiting_.clear();
    files_.clear();
    recovered_.clear();
}

std::vector<FileInfo> Files::list(bool& more) const {
    more = false;
    if (!is_open()) return {};
    if (!only_.empty()) return list_only();
    std::vector<FileInfo> found;
    std::error_code failed;
    for (auto entry = fs::recursive_directory_iterator(root_, failed);
         !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
        const std::string path = fs::relative(entry->path(), root_).generic_string();
        const bool folder = entry->is_directory() && !entry->is_symlink();
        if (!check_path(path).ok()) {
            if (folder) entry.disable_recursion_pending();
            continue;
        }
        if (entry.depth() >= static_cast<int>(kFolderDepthMax)) entry.disable_recursion_pending();
        if (found.size() >= kFilesMax) {
            more = true;
            break;
        }
        FileInfo info{path, folder ? "folder" : kind_of_file(path), 0, is_unsaved(path)};
        if (!folder) info.size = entry->is_regular_file() ? entry->file_size() : 0;
        found.push_back(std::move(info));
    }
    add_unsaved_without_file(found);
    std::sort(found.begin(), found.end(),
              [](const FileInfo& a, const FileInfo& b) { return a.path < b.path; });
    return found;
}

// Texts that were never saved have no file yet.
void Files::add_unsaved_without_file(std::vector<FileInfo>& found) const {
    for (const auto& [path, file] : files_) {
        const bool listed = std::any_of(found.begin(), found.end(),
                                        [&](const FileInfo& info) { return info.path == path; });
        if (!listed && file.text != file.saved) {
            found.push_back({path, kind_of_file(path), file.text.size(), true});
        }
    }
}

std::vector<FileInfo> Files::list_only() const {
    std::vector<FileInfo> found;
    for (const std::string& path : only_) {
        std::error_code failed;
        const uintmax_t size = fs::file_size(root_ / path, failed);
        if (failed && !is_unsaved(path)) continue;
        found.push_back({path, kind_of_file(path), failed ? 0 : size, is_unsaved(path)});
    }
    return found;
}

Result<Files::Place> Files::place_of(const std::string& doc) const {
    TRY(check_open());
    const size_t mark = doc.rfind('#');
    Place place{doc.substr(0, mark), 0};
    if (mark != std::string::npos) {
        const std::string_view digits = std::string_view(doc).substr(mark + 1);
        const auto [end, bad] =
            std::from_chars(digits.data(), digits.data() + digits.size(), place.part);
        if (bad != std::errc() || end != digits.data() + digits.size() || place.part < 1) {
            return Error{Code::BadInput, doc + ": expected PATH#N for the script of a node"};
        }
    }
    TRY(check_path(place.path));
    return place;
}

Result<fs::path> Files::real(const std::string& path) const {
    TRY(check_open());
    return path_in(root_, path);
}

Result<Files::File*> Files::load(const std::string& path) {
    const auto known = files_.find(path);
    if (known != files_.end()) return &known->second;
    const fs::path real_path = TRY(real(path));
    std::error_code failed;
    if (!fs::is_regular_file(real_path, failed)) return not_there(path);
    if (fs::file_size(real_path, failed) > kTextBytesMax) {
        return Error{Code::Limit, fmt::format("{}: more than {} bytes; the studio edits shorter "
                                              "texts only",
                                              path, kTextBytesMax)};
    }
    File file;
    file.written = fs::last_write_time(real_path, failed);
    file.text = TRY(read_file(real_path.string()));
    if (malformed_utf8_at(file.text)) {
        return Error{Code::BadInput, path + ": not a text in UTF-8; the studio cannot edit it"};
    }
    file.saved = file.text;
    File& kept = files_[path] = std::move(file);
    refresh_parts(path, kept);
    if (auto unsaved = waiting_.extract(path); !unsaved.empty()) {
        recover(path, kept, std::move(unsaved.mapped()));
    }
    return &kept;
}

void Files::refresh_parts(const std::string& path, File& file) {
    if (kind_of_file(path) != "script" || !is_project(file.text)) return;
    if (!aesl::parse_project(file.text, path).ok()) return;  // the scripts stay as they were
    const aesl::ProjectText text(file.text);
    for (size_t i = 0; i < text.scripts(); ++i) {
        auto& [version, script] = file.parts[static_cast<int>(i) + 1];
        std::string now = text.script(i);
        if (version == 0 || now != script) ++version;
        script = std::move(now);
    }
    file.parts.erase(file.parts.upper_bound(static_cast<int>(text.scripts())), file.parts.end());
}

Result<DocumentView> Files::open(const std::string& doc) {
    const Place place = TRY(place_of(doc));
    const File* file = TRY(load(place.path));
    DocumentView view{file->text,
                      file->version,
                      language_of(place.path, place.part, file->text),
                      file->text != file->saved,
                      file->by,
                      file->disk,
                      file->gone};
    if (place.part == 0) return view;
    const auto part = file->parts.find(place.part);
    if (part == file->parts.end()) {
        return Error{Code::NotFound,
                     fmt::format("{}: the file has {} scripts", doc, file->parts.size())};
    }
    view.version = part->second.first;
    view.text = part->second.second;
    view.disk.reset();
    return view;
}

uint32_t Files::version(const std::string& doc) {
    const Result<Place> place = place_of(doc);
    if (!place.ok()) return 0;
    const Result<File*> file = load(place.value().path);
    if (!file.ok()) return 0;
    if (place.value().part == 0) return file.value()->version;
    const auto part = file.value()->parts.find(place.value().part);
    return part == file.value()->parts.end() ? 0 : part->second.first;
}

Result<uint32_t> Files::edit(const std::string& doc, uint32_t version,
                             const std::vector<TextChange>& changes, uint32_t by) {
    const DocumentView before = TRY(open(doc));
    if (before.version != version) {
        return Error{Code::Refused,
                     fmt::format("{}: the text is at version {} by now", doc, before.version)};
    }
    auto text = applied(before.text, changes);
    if (!text) {
        return Error{Code::BadInput, doc +
                                         ": a change lies outside of the text, inside a "
                                         "character, or over another"};
    }
    return replace(doc, std::move(*text), by);
}

Result<uint32_t> Files::replace(const std::string& doc, std::string text, uint32_t by) {
    if (text.size() > kTextBytesMax) {
        return Error{Code::Limit, fmt::format("{}: the text would have {} bytes; at most {} are "
                                              "edited",
                                              doc, text.size(), kTextBytesMax)};
    }
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    if (place.part == 0) {
        file->text = std::move(text);
    } else {
        const auto part = file->parts.find(place.part);
        if (part == file->parts.end()) return not_there(doc);
        const aesl::ProjectText project(file->text);
        const auto index = static_cast<size_t>(place.part) - 1;
        if (index >= project.scripts() || project.script(index) != part->second.second) {
            return Error{Code::Refused,
                         doc +
                             ": the file around the script is no project at the moment; mend "
                             "it first"};
        }
        const TextDifference change = difference(part->second.second, text);
        file->text = project.replace(index, change.from, change.to, change.insert);
    }
    changed(place.path, *file, by);
    return TRY(open(doc)).version;
}

void Files::changed(const std::string& path, File& file, uint32_t by) {
    ++file.version;
    file.by = by;
    refresh_parts(path, file);
    if (!file.journal_due) file.journal_due = now_ + kJournalWithin;
    next_tick_ = std::min(next_tick_, *file.journal_due);
    changed_(path);
}

Status Files::save(const std::string& doc) {
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    if (file->text == file->saved && !file->disk && !file->gone) return Status::done();
    const fs::path real_path = TRY(real(place.path));
    TRY(write_file(real_path.string(), file->text));
    std::error_code failed;
    file->written = fs::last_write_time(real_path, failed);
    file->saved = file->text;
    file->disk.reset();
    file->gone = false;
    file->journal_due.reset();
    file->journaled = false;
    journal_.forget(place.path);
    std::erase(recovered_, place.path);
    changed_(place.path);
    return Status::done();
}

Result<std::vector<std::string>> Files::save_all() {
    TRY(check_open());
    std::vector<std::string> saved;
    for (auto& [path, file] : files_) {
        if (file.text == file.saved) continue;
        TRY(save(path));
        saved.push_back(path);
    }
    return saved;
}

Status Files::revert(const std::string& doc) {
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    if (file->disk) file->saved = std::exchange(file->disk, std::nullopt).value();
    file->text = file->saved;
    changed(place.path, *file, 0);
    file->journal_due.reset();
    journal_.forget(place.path);
    std::erase(recovered_, place.path);
    return Status::done();
}

Status Files::keep_mine(const std::string& doc) {
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    if (file->disk) file->saved = std::exchange(file->disk, std::nullopt).value();
    changed(place.path, *file, 0);
    return Status::done();
}

bool Files::is_unsaved(const std::string& doc) const {
    const auto found = files_.find(doc.substr(0, doc.rfind('#')));
    return found != files_.end() && found->second.text != found->second.saved;
}

Result<std::string> Files::text(const std::string& path) const {
    const auto known = files_.find(path);
    if (known != files_.end()) return known->second.text;
    return bytes(path);
}

bool Files::exists(const std::string& path) const {
    const auto known = files_.find(path);
    if (known != files_.end() && !known->second.gone) return true;
    const Result<fs::path> real_path = real(path);
    std::error_code failed;
    return is_unsaved(path) || (real_path.ok() && fs::is_regular_file(real_path.value(), failed));
}

Result<uintmax_t> Files::size(const std::string& path) const {
    const fs::path real_path = TRY(real(path));
    std::error_code failed;
    if (!fs::is_regular_file(real_path, failed)) return not_there(path);
    const uintmax_t size = fs::file_size(real_path, failed);
    if (failed) return not_there(path);
    return size;
}

Result<std::string> Files::bytes(const std::string& path) const {
    (void)TRY(size(path));
    const fs::path real_path = TRY(real(path));
    return read_file(real_path.string());
}

Status Files::make(const std::string& path, std::string_view content) {
    const fs::path real_path = TRY(real(path));
    std::error_code failed;
    if (fs::exists(real_path, failed)) {
        return Error{Code::Refused, path + ": there is such a file already; take another name"};
    }
    fs::create_directories(real_path.parent_path(), failed);
    TRY(write_file(real_path.string(), content));
    changed_(path);
    return Status::done();
}

Status Files::make_folder(const std::string& path) {
    const fs::path real_path = TRY(real(path));
    std::error_code failed;
    if (fs::create_directories(real_path, failed)) {
        changed_(path);
        return Status::done();
    }
    return Error{Code::Refused, fmt::format("{}: cannot make the folder: {}", path,
                                            failed ? failed.message() : "it is there already")};
}

Status Files::rename(const std::string& path, const std::string& to) {
    const fs::path from_path = TRY(real(path));
    const fs::path to_path = TRY(real(to));
    std::error_code failed;
    if (fs::exists(to_path, failed)) {
        return Error{Code::Refused, to + ": there is such a file already; take another name"};
    }
    fs::create_directories(to_path.parent_path(), failed);
    fs::rename(from_path, to_path, failed);
    if (failed) {
        return Error{Code::Unavailable,
                     fmt::format("{}: cannot be renamed: {}", path, failed.message())};
    }
    // Texts move along, those of a folder's files too.
    std::map<std::string, File> moved;
    for (auto& [name, file] : files_) {
        const bool below = name.starts_with(path + "/");
        if (name != path && !below) continue;
        journal_.forget(name);
        if (file.text != file.saved) file.journal_due = now_;
        moved.emplace(to + name.substr(path.size()), std::move(file));
    }
    std::erase_if(files_, [&](const auto& entry) {
        return entry.first == path || entry.first.starts_with(path + "/");
    });
    files_.merge(moved);
    next_tick_ = now_;
    changed_(path);
    changed_(to);
    return Status::done();
}

Status Files::remove(const std::string& path) {
    const fs::path real_path = TRY(real(path));
    std::error_code failed;
    const fs::path trash = root_ / kOwnFolder / "trash";
    fs::create_directories(trash, failed);
    fs::path place = trash / real_path.filename();
    for (int i = 2; fs::exists(place, failed); ++i) {
        place = trash / fmt::format("{} {}", real_path.filename().string(), i);
    }
    fs::rename(real_path, place, failed);
    if (failed) {
        return Error{Code::Unavailable,
                     fmt::format("{}: cannot be deleted: {}", path, failed.message())};
    }
    for (const auto& [name, file] : files_) {
        if (name == path || name.starts_with(path + "/")) journal_.forget(name);
    }
    std::erase_if(files_, [&](const auto& entry) {
        return entry.first == path || entry.first.starts_with(path + "/");
    });
    changed_(path);
    return Status::done();
}

void Files::tick(Time now) {
    now_ = now;
    next_tick_ = Time::max();
    if (!is_open()) return;
    if (now >= next_disk_) {
        next_disk_ = now + kDiskEvery;
        for (auto& [path, file] : files_) look_at_disk(path, file);
    }
    next_tick_ = next_disk_;
    for (auto& [path, file] : files_) {
        if (file.journal_due && now >= *file.journal_due) write_journal(path, file);
        if (file.journal_due) next_tick_ = std::min(next_tick_, *file.journal_due);
    }
}

void Files::write_journal(const std::string& path, File& file) {
    file.journal_due.reset();
    if (file.text == file.saved) {
        if (std::exchange(file.journaled, false)) journal_.forget(path);
        return;
    }
    const Status written = journal_.write(path, {hash_of(file.saved), file.text});
    file.journaled = written.ok();
    if (written.ok()) return;
    trouble_ = "what is typed cannot be kept: " + written.error().what;
    file.journal_due = now_ + kDiskEvery;
}

void Files::look_at_disk(const std::string& path, File& file) {
    const Result<fs::path> real_path = real(path);
    if (!real_path.ok()) return;
    std::error_code failed;
    const auto written = fs::last_write_time(real_path.value(), failed);
    const bool gone = static_cast<bool>(failed);
    if (file.gone != gone) {
        file.gone = gone;
        changed_(path);
    }
    if (gone || written == file.written) return;
    file.written = written;
    const Result<std::string> text = read_file(real_path.value().string());
    if (!text.ok() || text.value() == file.saved || text.value().size() > kTextBytesMax ||
        malformed_utf8_at(text.value())) {
        return;
    }
    if (file.text == file.saved) {
        file.text = file.saved = text.value();
        changed(path, file, 0);
        file.journal_due.reset();
    } else {
        file.disk = text.value();
        changed(path, file, file.by);
    }
}

std::optional<std::string> Files::take_trouble() {
    return std::exchange(trouble_, std::nullopt);
}

}  // namespace vagus::serve
