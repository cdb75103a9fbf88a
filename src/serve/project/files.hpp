// The files of a project as the studio edits them: texts with versions, unsaved changes in the
// journal, changes from outside noticed. Scripts inside an .aesl file are documents of their own,
// PATH#N, cut out of the file and put back without touching the rest.
//
//     Files files;
//     files.enter(root);
//     auto opened = files.open("carbot/carbot.aesl#1");
//     auto edited = files.edit("carbot/carbot.aesl#1", opened.value().version, {{0, 3, "var"}});
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
#include "serve/project/journal.hpp"
#include "serve/project/text_change.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kJournalWithin = 500ms;  // of a change
constexpr Duration kDiskEvery = 1s;         // changes from outside are looked for
constexpr size_t kTextBytesMax = 2u << 20;
constexpr size_t kFilesMax = 2000;
constexpr size_t kFolderDepthMax = 12;

struct FileInfo {
    std::string path;
    std::string kind;  // as in the protocol: folder, script, plan, …
    uintmax_t size = 0;
    bool unsaved = false;
};

struct DocumentView {
    std::string text;
    uint32_t version = 0;
    std::string language;  // as in the protocol: aesl, aesl-file, plan, …
    bool unsaved = false;
    uint32_t by = 0;                  // who changed it last; 0: the server
    std::optional<std::string> disk;  // the file, if it changed under an unsaved text
    bool gone = false;                // somebody took the file away
};

// What a name of a file says: "plan" for NAME.plan.json.
std::string kind_of_file(std::string_view path);

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
    std::vector<FileInfo> list(bool& more) const;
    const std::vector<std::string>& recovered() const { return recovered_; }
    // Called with the path of each file whose text changed, whoever did it.
    void on_change(std::function<void(const std::string& path)> changed) {
        changed_ = std::move(changed);
    }

    // ---- documents ----
    Result<DocumentView> open(const std::string& doc);
    // The Error has code Refused if `version` is not the one there is.
    Result<uint32_t> edit(const std::string& doc, uint32_t version,
                          const std::vector<TextChange>& changes, uint32_t by);
    // The whole text of a file anew.
    Result<uint32_t> replace(const std::string& doc, std::string text, uint32_t by);
    Status save(const std::string& doc);
    Result<std::vector<std::string>> save_all();
    Status revert(const std::string& doc);
    Status keep_mine(const std::string& doc);
    bool is_unsaved(const std::string& doc) const;
    // Of the text; 0 if it cannot be opened.
    uint32_t version(const std::string& doc);

    // ---- files ----
    // The text as it is edited, or as it is on disk.
    Result<std::string> text(const std::string& path) const;
    // A file, or a text that was never saved.
    bool exists(const std::string& path) const;
    Result<uintmax_t> size(const std::string& path) const;
    Result<std::string> bytes(const std::string& path) const;
    Status make(const std::string& path, std::string_view content);
    Status make_folder(const std::string& path);
    Status rename(const std::string& path, const std::string& to);
    Status remove(const std::string& path);  // into .vagus/trash

    void tick(Time now);
    Time next_tick() const { return next_tick_; }
    // What stands between now and a file on disk, or an empty text: for the console.
    std::optional<std::string> take_trouble();

private:
    struct File {
        std::string text;   // with the line feeds of the file
        std::string saved;  // as it is on disk, as far as we know
        std::filesystem::file_time_type written{};
        uint32_t version = 1;
        std::map<int, std::pair<uint32_t, std::string>> parts;  // version and text of each script
        uint32_t by = 0;
        std::optional<std::string> disk;
        bool gone = false;
        std::optional<Time> journal_due;
        bool journaled = false;
    };
    struct Place {
        std::string path;
        int part = 0;  // 0: the file
    };

    Status check_open() const;
    Result<Place> place_of(const std::string& doc) const;
    void recover(const std::string& path, File& file, Unsaved unsaved);
    Result<File*> load(const std::string& path);
    void changed(const std::string& path, File& file, uint32_t by);
    void refresh_parts(const std::string& path, File& file);
    void look_at_disk(const std::string& path, File& file);
    void write_journal(const std::string& path, File& file);
    Result<std::filesystem::path> real(const std::string& path) const;

    void add_unsaved_without_file(std::vector<FileInfo>& found) const;
    std::vector<FileInfo> list_only() const;

    std::filesystem::path root_;
    std::vector<std::string> only_;
    uint64_t session_ = 0;
    Journal journal_{{}};
    // Entries of the journal for files that nobody has opened yet.
    std::map<std::string, Unsaved> waiting_;
    std::map<std::string, File> files_;
    std::vector<std::string> recovered_;
    std::function<void(const std::string&)> changed_ = [](const std::string&) {};
    Time now_{};
    Time next_disk_{};
    Time next_tick_{};
    std::optional<std::string> trouble_;
};

}  // namespace vagus::serve
