// The files of a project as the studio edits them: texts with versions, unsaved changes in the
// journal, changes from outside noticed. Scripts inside an .aesl file are documents of their own,
// PATH#N, cut out of the file and put back without touching the rest.
//
//     Files files;
//     files.enter(root);
//     auto opened = files.open("carbot/carbot.aesl#1");
//     files.edit("carbot/carbot.aesl#1", opened.value().version, {{0, 3, "var"}}, "a1b2");
//     files.save("carbot/carbot.aesl");
//     files.tick(now);                 // journal, the disk
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/project/disk_sync.hpp"
#include "serve/project/journal.hpp"
#include "serve/project/open_text.hpp"
#include "serve/project/scan.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kJournalAgain = 1s;  // after the journal could not be written
constexpr Duration kDiskEvery = 1s;     // changes from outside are looked for
// A text without a file that nobody asks for after a restart is kept so long: pages come back.
constexpr Duration kUnclaimedFor = 10min;

struct FileInfo {
    std::string path;
    std::string kind;  // as in the protocol: folder, script, plan, …
    uintmax_t size = 0;
    bool unsaved = false;
};

struct DocumentState {
    uint32_t version = 0;
    std::string language;  // as in the protocol: aesl, aesl-file, plan, …
    std::string ends;      // lf, crlf, mixed
    bool unsaved = false;
    std::string by;         // who changed it last: Update::by
    bool conflict = false;  // the file changed on disk where the text is unsaved
    std::string disk_hash;  // of what it has there then
    std::string no_text;    // why that cannot be shown or taken; empty: it can
    bool gone = false;      // the file is not on disk
};

struct DocumentView : DocumentState {
    std::string text;  // each line end is one line feed
};

// What leads from an older version of a text to the one there is.
struct Missing {
    uint32_t version = 0;  // that there is
    std::vector<Update> updates;
    std::optional<std::string> text;  // instead of updates, where they are not kept any more
};

class Files {
public:
    // Nothing is open: list() is empty, and whatever is asked is refused as Unavailable.
    Files() = default;
    explicit Files(std::filesystem::path root) { enter(std::move(root)); }

    // Opens a folder. Unsaved texts of an earlier session are taken from the journal: recovered()
    // names them. With `only`, for files that were opened alone, list() names no others; they can
    // still be opened by their paths.
    void enter(std::filesystem::path root, std::vector<std::string> only = {});
    // Writes what is not yet in the journal, then forgets everything.
    void leave();
    bool is_open() const { return !root_.empty(); }
    // Another number after each enter() and leave().
    uint64_t session() const { return session_; }

    const std::filesystem::path& root() const { return root_; }
    // What cannot be listed is passed over, and told as trouble.
    std::vector<FileInfo> list(bool& more) const;
    const std::vector<std::string>& recovered() const { return recovered_; }
    // Called with the path of each file whose text changed, whatever changed it.
    void on_change(std::function<void(const std::string& path)> changed) {
        changed_ = std::move(changed);
    }

    // ---- documents ----
    Result<DocumentView> open(const std::string& doc);
    Result<DocumentState> state(const std::string& doc);
    // The same after a look at the disk.
    Result<DocumentState> state_now(const std::string& doc);
    Result<Missing> since(const std::string& doc, uint32_t version);
    // The Error has code Refused if `version` is not the one there is.
    Result<uint32_t> edit(const std::string& doc, uint32_t version, std::vector<TextChange> changes,
                          const std::string& by);
    // The whole text; what is alike stays as it is.
    Result<uint32_t> replace(const std::string& doc, std::string_view text, const std::string& by);
    // Refused while the file on disk is another one than the text began as: whatever somebody else
    // wrote up to this moment is merged, or stays and is shown as a conflict. The file has the new
    // text then, for everybody; when_on_disk() says when a power cut cannot take it back. Until
    // then it is in the journal, too.
    Status save(const std::string& doc);
    // Saves what can be saved; the Error names what cannot, and has code Refused if a file has a
    // conflict. Files that were deleted here stay deleted, as do others that are gone from the disk
    // and have nothing unsaved.
    Status save_all(std::vector<std::string>& saved);
    // What that would save.
    std::vector<std::string> unsaved() const;
    // Calls `then` from tick() when all that was written up to now is on the disk, or says what is
    // not; at once if that is so already. Nobody waits meanwhile.
    void when_on_disk(std::function<void(const Status&)> then);
    // Called on another thread when tick() has something to do.
    void on_wake(std::function<void()> wake) { sync_.on_news(std::move(wake)); }
    Status revert(const std::string& doc, const std::string& by);
    // What is on disk may be replaced by the next save.
    Status keep_mine(const std::string& doc);
    // The text has what is on disk as well, which is mine in front of theirs where both touch one
    // line; it can be saved then.
    Status keep_both(const std::string& doc, const std::string& by);
    // What is on disk, while there is a conflict.
    Result<std::string> disk_text(const std::string& doc);
    bool is_unsaved(const std::string& doc) const;
    bool has_conflict(const std::string& doc) const;
    // Of the text; 0 if it cannot be opened.
    uint32_t version(const std::string& doc);
    // Where a document went whose file was renamed; nothing if it was not.
    std::optional<std::string> moved_to(const std::string& doc) const;

    // ---- files ----
    // The text as it is edited, or as it is on disk, with line feeds.
    Result<std::string> text(const std::string& path) const;
    // A file, or a text that was never saved.
    bool exists(const std::string& path) const;
    Result<uintmax_t> size(const std::string& path) const;
    Result<std::string> bytes(const std::string& path) const;
    Status make(const std::string& path, std::string_view content);
    Status make_folder(const std::string& path);
    Status rename(const std::string& path, const std::string& to);
    // Into .vagus/trash. What was typed and not saved stays as a text without a file: save() makes
    // it again. A text that has no file already goes into the trash itself.
    Status remove(const std::string& path);

    void tick(Time now);
    Time next_tick() const { return next_tick_; }
    // What is between now and a file on disk, or an empty text: for the console.
    std::optional<std::string> take_trouble();

private:
    // A file on disk that is another one than the text began as.
    struct Conflict {
        std::string bytes;
        std::string why_no_text = {};  // it cannot be shown
        friend bool operator==(const Conflict&, const Conflict&) = default;
    };
    struct File {
        OpenText text;
        std::string saved;  // bytes, as they are on disk as far as we know
        std::filesystem::file_time_type written{};
        uintmax_t size = 0;
        std::optional<Conflict> conflict;
        bool unsaved = false;  // the text's bytes are not `saved`
        bool gone = false;
        bool deleted = false;    // gone, because somebody said so here: `saved` is in the trash
        bool unclaimed = false;  // of an earlier session; nobody has asked for it in this one
        std::optional<Time> drop_due;     // if nobody does
        std::optional<Time> journal_due;  // it could not be written
        uint64_t sync = 0;                // number of the wait for the disk; 0: it is there
        bool journaled = false;
        std::vector<std::string> journaled_as;  // names it had, whose entries are still needed
    };
    struct Place {
        std::string path;
        int part = 0;  // 0: the file
    };

    struct Opened {
        std::string path;
        File* file = nullptr;
        int part = 0;
    };

    Status check_open() const;
    Result<Place> place_of(const std::string& doc) const;
    std::string path_now(const std::string& path) const;
    uint32_t first_version_of(const std::string& path) const;
    Result<File*> load(const std::string& path);
    Result<File*> load_without_file(const std::string& path);
    bool counts_as_file(const std::string& path) const;
    std::filesystem::path place_in_trash(const std::filesystem::path& name) const;
    Status remove_text(const std::string& path, File& file);
    Result<Opened> opened(const std::string& doc);
    DocumentState state_of(const Opened& opened) const;
    void recover(const std::string& path, File& file, Unsaved unsaved);
    bool is_in_trash(const std::string& path, const File& file) const;
    void drop_unclaimed();

    // The text or what is on disk is another one: the journal follows, and who listens.
    void changed(const std::string& path, File& file);
    void keep_in_journal(const std::string& path, File& file);
    void write_journal(const std::string& path, File& file);
    void journal_is_written(File& file);

    enum class Look { IfTouched, Closely };
    void look_at_disk(const std::string& path, File& file, Look look);
    // A file that was gone has nothing to do with the text of its name.
    enum class CameBack { No, Yes };
    bool take_disk(File& file, std::string bytes, CameBack back) const;
    Status write(const std::string& path, File& file);
    void move(const std::string& path, const std::string& to, File file);
    Result<std::filesystem::path> real(const std::string& path) const;

    void hear_disk();
    void tell_passed_over();
    void add_unsaved_without_file(std::vector<FileInfo>& found) const;
    std::vector<FileInfo> list_only() const;

    std::filesystem::path root_;
    std::vector<std::string> only_;
    uint64_t session_ = 0;
    DiskSync sync_;
    struct DiskWait {
        uint64_t number = 0;
        std::function<void(const Status&)> then;
    };
    std::vector<DiskWait> disk_waits_;  // the oldest first
    uint64_t on_disk_ = 0;              // up to this number
    Journal journal_;
    // Entries of the journal for files that nobody has opened yet.
    std::map<std::string, Unsaved> waiting_;
    std::map<std::string, File> files_;
    std::map<std::string, std::string> moved_;  // old path, new path
    uint32_t first_version_ = 1;  // of a text that is opened: no version is used twice
    std::vector<std::string> recovered_;
    std::function<void(const std::string&)> changed_ = [](const std::string&) {};
    Time now_{};
    Time next_disk_{};
    Time next_tick_{};
    std::optional<std::string> trouble_;
    bool journal_fails_ = false;                  // told once
    mutable std::vector<ScanFault> passed_over_;  // by the last list()
    std::vector<ScanFault> told_passed_over_;
};

}  // namespace vagus::serve
