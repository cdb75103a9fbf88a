// Files against the disk: what is saved, and what somebody else wrote there meanwhile.
#include <fmt/format.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/text.hpp"
#include "serve/project/files.hpp"
#include "serve/project/merge.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

Error conflict_of(const std::string& path) {
    return {Code::Refused,
            path +
                ": the file changed on disk where the text has unsaved changes; compare the two, "
                "keep one of them, then save"};
}

// Line by line. The first line of a script follows the tag of its node, in one line of the
// file: so scripts are put together by themselves, then what is around them.
std::string both_texts(const std::string& path, std::string_view saved, std::string_view mine,
                       std::string_view disk) {
    OpenText base(path, saved, 1);
    OpenText my(path, mine, 1);
    OpenText its(path, disk, 1);
    const size_t scripts = base.scripts();
    if (my.scripts() != scripts || its.scripts() != scripts) return with_both(saved, mine, disk);
    for (int part = 1; part <= static_cast<int>(scripts); ++part) {
        const std::string both = with_both(base.text(part), my.text(part), its.text(part));
        for (OpenText* one : {&base, &my, &its}) {
            if (!one->replace(part, both, "").ok()) return with_both(saved, mine, disk);
        }
    }
    return with_both(base.bytes(), my.bytes(), its.bytes());
}

}  // namespace

Status Files::save(const std::string& doc) {
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    look_at_disk(place.path, *file, Look::Closely);
    if (file->conflict) return conflict_of(place.path);
    if (!file->unsaved && !file->gone) return Status::done();
    return write(place.path, *file);
}

Status Files::write(const std::string& path, File& file) {
    const fs::path real_path = TRY(real(path));
    std::error_code failed;
    if (file.gone) fs::create_directories(real_path.parent_path(), failed);
    std::string bytes = file.text.bytes();
    TRY(write_file_unsynced(real_path.string(), bytes));
    file.sync = sync_.post(real_path.string());
    file.written = fs::last_write_time(real_path, failed);
    file.size = bytes.size();
    file.saved = std::move(bytes);
    file.gone = file.deleted = false;
    file.journal_due.reset();
    file.unsaved = false;
    std::erase(recovered_, path);
    changed_(path);
    return Status::done();
}

// The journal has what was saved until the disk has it: the old file may come back with a power
// cut.
void Files::hear_disk() {
    const DiskSync::News news = sync_.take();
    on_disk_ = news.done;
    for (const DiskSync::Failure& failure : news.failures) trouble_ = failure.why;
    for (auto& [path, file] : files_) {
        if (file.sync == 0 || file.sync > on_disk_) continue;
        const uint64_t number = std::exchange(file.sync, 0);
        const bool failed = std::ranges::any_of(
            news.failures, [&](const auto& one) { return one.number == number; });
        if (!failed && !file.journal_due) write_journal(path, file);
    }
    while (!disk_waits_.empty() && disk_waits_.front().number <= on_disk_) {
        const DiskWait wait = std::move(disk_waits_.front());
        disk_waits_.erase(disk_waits_.begin());
        const bool failed = !news.failures.empty();
        wait.then(failed ? Status(Error{Code::Unavailable, news.failures.front().why})
                         : Status::done());
    }
}

void Files::when_on_disk(std::function<void(const Status&)> then) {
    if (on_disk_ >= sync_.last()) return then(Status::done());
    disk_waits_.push_back({sync_.last(), std::move(then)});
}

std::vector<std::string> Files::unsaved() const {
    std::vector<std::string> paths;
    for (const auto& [path, file] : files_) {
        if (file.conflict || (file.unsaved && !file.deleted)) paths.push_back(path);
    }
    return paths;
}

Status Files::save_all(std::vector<std::string>& saved) {
    TRY(check_open());
    std::string refused;
    bool conflict = false;
    for (const std::string& path : unsaved()) {
        const Status done = save(path);
        if (done.ok()) saved.push_back(path);
        if (done.ok()) continue;
        refused += (refused.empty() ? "" : "; ") + done.error().what;
        conflict = conflict || has_conflict(path);
    }
    if (refused.empty()) return Status::done();
    return Error{conflict ? Code::Refused : Code::Unavailable, refused};
}

Status Files::revert(const std::string& doc, const std::string& by) {
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    look_at_disk(place.path, *file, Look::Closely);
    if (file->conflict) {
        if (!file->conflict->why_no_text.empty()) {
            return Error{Code::BadInput, place.path + ": " + file->conflict->why_no_text};
        }
        file->saved = std::exchange(file->conflict, std::nullopt)->bytes;
    }
    file->text.take(file->saved, by);
    std::erase(recovered_, place.path);
    changed(place.path, *file);
    return Status::done();
}

Status Files::keep_mine(const std::string& doc) {
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    if (file->conflict) file->saved = std::exchange(file->conflict, std::nullopt)->bytes;
    changed(place.path, *file);
    return Status::done();
}

Status Files::keep_both(const std::string& doc, const std::string& by) {
    const Place place = TRY(place_of(doc));
    File* file = TRY(load(place.path));
    look_at_disk(place.path, *file, Look::Closely);
    if (!file->conflict) return Status::done();
    if (!file->conflict->why_no_text.empty()) {
        return Error{Code::BadInput, place.path + ": " + file->conflict->why_no_text};
    }
    const std::string both =
        both_texts(place.path, file->saved, file->text.bytes(), file->conflict->bytes);
    if (both.size() > kTextBytesMax) {
        return Error{Code::Limit, place.path +
                                      ": both together are too long to be edited; compare "
                                      "them, and keep one"};
    }
    file->saved = std::exchange(file->conflict, std::nullopt)->bytes;
    file->text.take(both, by);
    changed(place.path, *file);
    return Status::done();
}

Result<std::string> Files::disk_text(const std::string& doc) {
    const Opened found = TRY(opened(doc));
    if (!found.file->conflict) {
        return Error{Code::NotFound, doc + ": the file on disk is the one that the text began as"};
    }
    const Conflict& conflict = *found.file->conflict;
    if (!conflict.why_no_text.empty()) {
        return Error{Code::BadInput, found.path + ": " + conflict.why_no_text};
    }
    const OpenText disk(found.path, conflict.bytes, 1);
    if (disk.has(found.part)) return disk.text(found.part);
    return Error{Code::NotFound,
                 fmt::format("{}: the file on disk has {} scripts", doc, disk.scripts())};
}

bool Files::has_conflict(const std::string& doc) const {
    const auto found = files_.find(doc.substr(0, doc.rfind('#')));
    return found != files_.end() && found->second.conflict;
}

void Files::look_at_disk(const std::string& path, File& file, Look look) {
    // What leads out of the project is no file of it.
    const Result<fs::path> real_path = real(path);
    std::error_code failed;
    const bool gone = !real_path.ok() || !fs::is_regular_file(real_path.value(), failed);
    const auto written = gone ? file.written : fs::last_write_time(real_path.value(), failed);
    const uintmax_t size = gone ? 0 : fs::file_size(real_path.value(), failed);
    const bool same = file.gone == gone && file.written == written && file.size == size;
    if (look == Look::IfTouched && (same || (gone && file.gone))) return;
    const bool came_or_went = std::exchange(file.gone, gone) != gone;
    if (gone) {
        // Nobody's text would be overwritten any more.
        const bool was_conflict = std::exchange(file.conflict, std::nullopt).has_value();
        if (came_or_went || was_conflict) changed(path, file);
        return;
    }
    file.deleted = false;
    file.written = written;
    file.size = size;
    Result<std::string> bytes = read_file(real_path.value().string());
    const auto before = file.conflict;
    bool taken = false;
    if (bytes.ok()) {
        taken =
            take_disk(file, std::move(bytes.value()), came_or_went ? CameBack::Yes : CameBack::No);
    } else {
        file.conflict = Conflict{"", bytes.error().what};
    }
    if (taken || came_or_went) return changed(path, file);
    if (file.conflict != before) changed_(path);
}

// The bytes of the file as somebody else may have written it. True: the text follows them.
bool Files::take_disk(File& file, std::string bytes, CameBack back) const {
    if (bytes == file.saved) {
        file.conflict.reset();
        return false;
    }
    const bool no_text = malformed_utf8_at(bytes).has_value();
    if (no_text || bytes.size() > kTextBytesMax) {
        const char* const why = no_text ? "the file on disk is no text in UTF-8 any more"
                                        : "the file on disk is too long to be edited";
        file.conflict = Conflict{std::move(bytes), why};
        return false;
    }
    std::optional<std::string> both = bytes;
    if (file.unsaved && file.text.bytes() != bytes) {
        both = back == CameBack::No ? merged(file.saved, file.text.bytes(), bytes) : std::nullopt;
    }
    if (!both || both->size() > kTextBytesMax) {
        file.conflict = Conflict{std::move(bytes)};
        return false;
    }
    file.text.take(*both, "disk");
    file.saved = std::move(bytes);
    file.conflict.reset();
    return true;
}

}  // namespace vagus::serve
