#include "serve/project/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/file.hpp"
#include "base/text.hpp"
#include "serve/project/paths.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMovedMax = 1000;  // renamed files that are found under their old names

Error not_there(const std::string& doc) {
    return {Code::NotFound, doc + ": there is no such file in the project"};
}

bool is_in(const std::string& folder, const std::string& path) {
    return path == folder || path.starts_with(folder + "/");
}

}  // namespace

Status Files::check_open() const {
    if (is_open()) return Status::done();
    return Error{Code::Unavailable, "no project is open; open one first"};
}

void Files::enter(fs::path root, std::vector<std::string> only) {
    leave();
    root_ = std::move(root);
    only_ = std::move(only);
    journal_ = Journal(root_ / kOwnFolder / "journal", sync_, journal_.next_number());
    waiting_ = journal_.read();
    next_disk_ = next_tick_ = now_;
    std::vector<std::string> paths = only_;
    if (only_.empty()) {
        for (const auto& [path, unsaved] : waiting_) paths.push_back(path);
    }
    for (const std::string& path : paths) {
        if (!waiting_.contains(path) || load(path).ok()) continue;
        (void)load_without_file(path).ok();
    }
}

// The file is gone, or is no text any more; what was typed is not.
Result<Files::File*> Files::load_without_file(const std::string& path) {
    const auto unsaved = waiting_.extract(path);
    if (unsaved.empty()) return not_there(path);
    File& file = files_[path];
    file.text = OpenText(path, "", first_version_);
    file.gone = true;
    recover(path, file, unsaved.mapped());
    return &file;
}

// A text of an earlier session; `file` is as it is on disk.
void Files::recover(const std::string& path, File& file, Unsaved unsaved) {
    if (file.text.bytes() == unsaved.text) return journal_.forget(path);
    std::string disk = file.saved;
    if (!unsaved.base_hash) {
        file.saved = unsaved.base.value_or("");
    } else if (!file.gone && hash_of(disk) != *unsaved.base_hash) {
        file.conflict = Conflict{disk};
    }
    file.text.take(unsaved.text, "server");
    file.unsaved = unsaved.text != file.saved;
    file.journaled = true;
    file.deleted = file.gone && unsaved.deleted;
    // Deleted, here or by somebody else: it is here for whoever still has it open.
    if (file.gone && (file.deleted || !file.unsaved)) {
        file.unclaimed = true;
        return;
    }
    // The file changed meanwhile: what both did is put together, or both are shown. The journal
    // gets it with the next change: reading a project writes nothing.
    const CameBack back = unsaved.deleted ? CameBack::Yes : CameBack::No;
    if (!file.gone && take_disk(file, std::move(disk), back)) {
        file.unsaved = file.text.bytes() != file.saved;
    }
    if (file.unsaved || file.conflict) return recovered_.push_back(path);
    file.journaled = false;
    journal_.forget(path);
}

// Of a text that was typed and then deleted, the trash has only what was saved.
bool Files::is_in_trash(const std::string& path, const File& file) const {
    if (!file.unsaved) return true;
    const fs::path place = place_in_trash(fs::path(path).filename());
    return write_file_unsynced(place.string(), file.text.bytes()).ok();
}

void Files::drop_unclaimed() {
    for (auto at = files_.begin(); at != files_.end();) {
        auto& [path, file] = *at;
        if (file.unclaimed && !file.drop_due) file.drop_due = now_ + kUnclaimedFor;
        const bool due = file.unclaimed && now_ >= *file.drop_due;
        if (!due || !is_in_trash(path, file)) {
            ++at;
            continue;
        }
        journal_.forget(path);
        first_version_ = std::max(first_version_, file.text.newest_version() + 1);
        at = files_.erase(at);
    }
}

void Files::leave() {
    for (auto& [path, file] : files_) {
        if (file.journal_due) write_journal(path, file);
        first_version_ = std::max(first_version_, file.text.newest_version() + 1);
    }
    ++session_;
    root_.clear();
    only_.clear();
    waiting_.clear();
    files_.clear();
    moved_.clear();
    recovered_.clear();
    passed_over_.clear();
    told_passed_over_.clear();
}

std::vector<FileInfo> Files::list(bool& more) const {
    more = false;
    if (!is_open()) return {};
    if (!only_.empty()) return list_only();
    std::vector<FileInfo> found;
    FolderScan scan = scan_folder(root_);
    more = scan.more;
    passed_over_ = std::move(scan.passed_over);
    for (ScanEntry& entry : scan.entries) {
        const bool folder = entry.is == FolderEntry::Is::Folder;
        const bool link = entry.is == FolderEntry::Is::LinkToFolder;
        const std::string kind = folder ? "folder" : link ? "other" : kind_of_file(entry.path);
        const bool unsaved = is_unsaved(entry.path);
        found.push_back({std::move(entry.path), kind, entry.size, unsaved});
    }
    add_unsaved_without_file(found);
    std::sort(found.begin(), found.end(),
              [](const FileInfo& a, const FileInfo& b) { return a.path < b.path; });
    return found;
}

// Each once, as long as it is so; one at a time.
void Files::tell_passed_over() {
    const auto is_in = [](const std::vector<ScanFault>& list, const ScanFault& one) {
        return std::find(list.begin(), list.end(), one) != list.end();
    };
    std::erase_if(told_passed_over_,
                  [&](const ScanFault& one) { return !is_in(passed_over_, one); });
    for (const ScanFault& one : passed_over_) {
        if (is_in(told_passed_over_, one)) continue;
        told_passed_over_.push_back(one);
        trouble_ = one.path + ": passed over: " + one.why;
        return;
    }
}

// Texts that were never saved have no file yet.
void Files::add_unsaved_without_file(std::vector<FileInfo>& found) const {
    for (const auto& [path, file] : files_) {
        const bool listed = std::any_of(found.begin(), found.end(),
                                        [&](const FileInfo& info) { return info.path == path; });
        if (!listed && file.unsaved && !file.deleted) {
            found.push_back({path, kind_of_file(path), file.text.text(0).size(), true});
        }
    }
}

std::vector<FileInfo> Files::list_only() const {
    std::vector<FileInfo> found;
    for (const std::string& path : only_) {
        std::error_code failed;
        const uintmax_t size = fs::file_size(root_ / path, failed);
        if (failed && !counts_as_file(path)) continue;
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
    place.path = path_now(place.path);
    return place;
}

// A file that was renamed is found under its old name, too, until there is another one of that
// name: what was typed into it while it moved is not lost.
std::string Files::path_now(const std::string& path) const {
    std::string now = path;
    for (size_t steps = 0; steps <= moved_.size() && !files_.contains(now); ++steps) {
        const auto to = moved_.find(now);
        if (to == moved_.end()) break;
        std::error_code failed;
        if (fs::exists(root_ / now, failed)) break;
        now = to->second;
    }
    return now;
}

// Pages may still know the text that had this name before: what they say of a version of that one
// is not to fit another text.
uint32_t Files::first_version_of(const std::string& path) const {
    uint32_t first = first_version_;
    auto moved = moved_.find(path);
    for (size_t steps = 0; steps <= moved_.size() && moved != moved_.end(); ++steps) {
        const auto text = files_.find(moved->second);
        if (text != files_.end()) first = std::max(first, text->second.text.newest_version() + 1);
        moved = moved_.find(moved->second);
    }
    return first;
}

std::optional<std::string> Files::moved_to(const std::string& doc) const {
    const size_t mark = doc.rfind('#');
    const std::string path = doc.substr(0, mark);
    const std::string now = path_now(path);
    if (now == path) return std::nullopt;
    return mark == std::string::npos ? now : now + doc.substr(mark);
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
    if (!fs::is_regular_file(real_path, failed)) return load_without_file(path);
    if (fs::file_size(real_path, failed) > kTextBytesMax) {
        return Error{Code::Limit, fmt::format("{}: more than {} bytes; the studio edits shorter "
                                              "texts only",
                                              path, kTextBytesMax)};
    }
    File file;
    file.written = fs::last_write_time(real_path, failed);
    file.size = fs::file_size(real_path, failed);
    file.saved = TRY(read_file(real_path.string()));
    if (malformed_utf8_at(file.saved)) {
        return Error{Code::BadInput, path + ": not a text in UTF-8; the studio cannot edit it"};
    }
    file.text = OpenText(path, file.saved, first_version_of(path));
    File& kept = files_[path] = std::move(file);
    if (auto unsaved = waiting_.extract(path); !unsaved.empty()) {
        recover(path, kept, std::move(unsaved.mapped()));
    }
    return &kept;
}

Result<Files::Opened> Files::opened(const std::string& doc) {
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    if (!file->text.has(place.part)) {
        return Error{Code::NotFound,
                     fmt::format("{}: the file has {} scripts", doc, file->text.scripts())};
    }
    file->unclaimed = false;
    return Opened{place.path, file, place.part};
}

DocumentState Files::state_of(const Opened& opened) const {
    const File& file = *opened.file;
    const Updates& updates = file.text.updates(opened.part);
    return {.version = updates.version(),
            .language = file.text.language(opened.part),
            .ends = std::string(file.text.ends()),
            .unsaved = file.unsaved,
            .by = updates.by(),
            .conflict = file.conflict.has_value(),
            .disk_hash = file.conflict ? fmt::format("{:016x}", hash_of(file.conflict->bytes)) : "",
            .no_text = file.conflict ? file.conflict->why_no_text : "",
            .gone = file.gone};
}

Result<DocumentView> Files::open(const std::string& doc) {
    const Opened found = TRY(opened(doc));
    return DocumentView{state_of(found), found.file->text.text(found.part)};
}

Result<DocumentState> Files::state(const std::string& doc) {
    return state_of(TRY(opened(doc)));
}

Result<DocumentState> Files::state_now(const std::string& doc) {
    const Opened found = TRY(opened(doc));
    look_at_disk(found.path, *found.file, Look::Closely);
    return state(doc);
}

Result<Missing> Files::since(const std::string& doc, uint32_t version) {
    const Opened found = TRY(opened(doc));
    const Updates& updates = found.file->text.updates(found.part);
    Missing missing{updates.version(), {}, {}};
    if (auto kept = updates.since(version)) {
        missing.updates = std::move(*kept);
    } else {
        missing.text = found.file->text.text(found.part);
    }
    return missing;
}

uint32_t Files::version(const std::string& doc) {
    const Result<Opened> found = opened(doc);
    return found.ok() ? found.value().file->text.updates(found.value().part).version() : 0;
}

Result<uint32_t> Files::edit(const std::string& doc, uint32_t version,
                             std::vector<TextChange> changes, const std::string& by) {
    const Opened found = TRY(opened(doc));
    OpenText& text = found.file->text;
    const uint32_t now = text.updates(found.part).version();
    if (now != version) {
        return Error{Code::Refused, fmt::format("{}: the text is at version {} by now", doc, now)};
    }
    TRY(text.edit(found.part, std::move(changes), by));
    if (text.updates(found.part).version() != now) changed(found.path, *found.file);
    return text.updates(found.part).version();
}

Result<uint32_t> Files::replace(const std::string& doc, std::string_view after,
                                const std::string& by) {
    const Opened found = TRY(opened(doc));
    OpenText& text = found.file->text;
    const uint32_t now = text.updates(found.part).version();
    TRY(text.replace(found.part, after, by));
    if (text.updates(found.part).version() != now) changed(found.path, *found.file);
    return text.updates(found.part).version();
}

void Files::changed(const std::string& path, File& file) {
    keep_in_journal(path, file);
    changed_(path);
}

void Files::keep_in_journal(const std::string& path, File& file) {
    file.unsaved = file.text.bytes() != file.saved;
    // After a failure it waits for its turn: a full disk is not asked at every letter.
    if (!file.journal_due) write_journal(path, file);
}

bool Files::is_unsaved(const std::string& doc) const {
    const auto found = files_.find(doc.substr(0, doc.rfind('#')));
    return found != files_.end() && found->second.unsaved;
}

Result<std::string> Files::text(const std::string& path) const {
    const auto known = files_.find(path);
    if (known == files_.end()) return FileText::read(TRY(bytes(path))).text();
    if (!counts_as_file(path)) return not_there(path);
    return known->second.text.text(0);
}

// A text of which a file is there, or is to be.
bool Files::counts_as_file(const std::string& path) const {
    const auto known = files_.find(path);
    if (known == files_.end()) return false;
    const File& file = known->second;
    return !file.gone || (file.unsaved && !file.deleted);
}

bool Files::exists(const std::string& path) const {
    if (counts_as_file(path)) return true;
    const Result<fs::path> real_path = real(path);
    std::error_code failed;
    return real_path.ok() && fs::is_regular_file(real_path.value(), failed);
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
    if (counts_as_file(path)) {
        return Error{Code::Refused, path + ": there is an unsaved text of that name; save it"};
    }
    fs::create_directories(real_path.parent_path(), failed);
    TRY(write_file_unsynced(real_path.string(), content));
    sync_.post(real_path.string());
    moved_.erase(path);
    if (const auto known = files_.find(path); known != files_.end()) {
        look_at_disk(path, known->second, Look::Closely);
    }
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
    if (fs::exists(to_path, failed) || is_unsaved(to)) {
        return Error{Code::Refused, to + ": there is such a file already; take another name"};
    }
    fs::create_directories(to_path.parent_path(), failed);
    fs::rename(from_path, to_path, failed);
    if (failed) {
        return Error{Code::Unavailable,
                     fmt::format("{}: cannot be renamed: {}", path, failed.message())};
    }
    // Texts move along, those of a folder's files too.
    std::vector<std::string> names;
    for (const auto& [name, file] : files_) {
        if (is_in(path, name)) names.push_back(name);
    }
    for (const std::string& name : names) {
        move(name, to + name.substr(path.size()), std::move(files_.extract(name).mapped()));
    }
    for (std::string& name : only_) {
        if (is_in(path, name)) name = to + name.substr(path.size());
    }
    changed_(path);
    changed_(to);
    return Status::done();
}

void Files::move(const std::string& path, const std::string& to, File file) {
    if (moved_.contains(to)) {
        const uint32_t first = first_version_of(to);
        if (first > first_version_) {
            file.text.begin_again(std::max(first, file.text.newest_version() + 1));
        }
        moved_.erase(to);
    }
    if (moved_.size() >= kMovedMax) moved_.erase(moved_.begin());
    moved_[path] = to;
    file.text.move_to(to);
    // There may be a text of that name whose file was deleted: its versions do not come back.
    if (const auto other = files_.find(to); other != files_.end()) {
        file.text.begin_again(other->second.text.newest_version() + 1);
    }
    std::replace(recovered_.begin(), recovered_.end(), path, to);
    if (file.sync > 0) file.sync = sync_.post((root_ / to).string());
    file.journaled_as.push_back(path);
    File& kept = files_[to] = std::move(file);
    keep_in_journal(to, kept);
}

// A text that was renamed keeps the entry of its old name until it has one of the new: the disk may
// be full.
void Files::journal_is_written(File& file) {
    for (const std::string& old : std::exchange(file.journaled_as, {})) {
        if (!files_.contains(old)) journal_.forget(old);
    }
}

// A free one.
fs::path Files::place_in_trash(const fs::path& name) const {
    std::error_code failed;
    const fs::path trash = root_ / kOwnFolder / "trash";
    fs::create_directories(trash, failed);
    fs::path place = trash / name;
    for (int i = 2; fs::exists(place, failed); ++i) {
        place = trash / fmt::format("{} {}", name.string(), i);
    }
    return place;
}

Status Files::remove_text(const std::string& path, File& file) {
    file.saved = file.text.bytes();
    TRY(write_file_unsynced(place_in_trash(fs::path(path).filename()).string(), file.saved));
    file.deleted = true;
    std::erase(recovered_, path);
    changed(path, file);
    return Status::done();
}

Status Files::remove(const std::string& path) {
    const fs::path real_path = TRY(real(path));
    std::error_code failed;
    const auto known = files_.find(path);
    if (known != files_.end() && known->second.gone && counts_as_file(path)) {
        return remove_text(path, known->second);
    }
    fs::rename(real_path, place_in_trash(real_path.filename()), failed);
    if (failed) {
        return Error{Code::Unavailable,
                     fmt::format("{}: cannot be deleted: {}", path, failed.message())};
    }
    // Texts stay: to be looked at, and saved again.
    for (auto& [name, file] : files_) {
        if (!is_in(path, name)) continue;
        // What the file had last, which is in the trash now.
        if (file.conflict) file.saved = std::exchange(file.conflict, std::nullopt)->bytes;
        file.gone = file.deleted = true;
        changed(name, file);
    }
    changed_(path);
    return Status::done();
}

void Files::tick(Time now) {
    now_ = now;
    next_tick_ = Time::max();
    hear_disk();
    if (!is_open()) return;
    if (now >= next_disk_) {
        next_disk_ = now + kDiskEvery;
        for (auto& [path, file] : files_) look_at_disk(path, file, Look::IfTouched);
        drop_unclaimed();
    }
    next_tick_ = next_disk_;
    for (auto& [path, file] : files_) {
        if (file.journal_due && now >= *file.journal_due) write_journal(path, file);
        if (file.journal_due) next_tick_ = std::min(next_tick_, *file.journal_due);
    }
}

void Files::write_journal(const std::string& path, File& file) {
    file.journal_due.reset();
    // It is in an editor, and saving is to make the file again.
    const bool taken = file.gone && !file.text.bytes().empty();
    if (!file.unsaved && !taken && file.sync == 0) {
        if (std::exchange(file.journaled, false)) journal_.forget(path);
        return journal_is_written(file);
    }
    const Status written = journal_.write(
        path, {.base = file.saved, .text = file.text.bytes(), .deleted = file.deleted});
    if (written.ok()) {
        file.journaled = true;
        journal_fails_ = false;
        return journal_is_written(file);
    }
    if (!std::exchange(journal_fails_, true)) {
        trouble_ =
            "unsaved changes cannot be journaled, and are tried again: " + written.error().what;
    }
    file.journal_due = now_ + kJournalAgain;
    next_tick_ = std::min(next_tick_, *file.journal_due);
}

std::optional<std::string> Files::take_trouble() {
    if (!trouble_) tell_passed_over();
    return std::exchange(trouble_, std::nullopt);
}

}  // namespace vagus::serve
