// What was typed and not saved, kept in files of its own under .vagus/journal, so that nothing is
// lost when this process or the computer dies. Each text has a file: first the text as a whole and
// what it began as, then every change behind the one before. A change is with the system at once;
// the disk is waited for elsewhere (DiskSync). What cannot be read at the end of a file was cut off
// there: what comes before it counts. When a file has grown long, another one is begun, and the old
// one goes when the new one is on the disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "serve/project/disk_sync.hpp"

namespace vagus::serve {

constexpr size_t kJournalSlackBytes = 64u << 10;  // of changes, beside twice the text itself

struct Unsaved {
    std::optional<std::string> base;  // the file that the text began as; nothing: there was none
    std::string text;
    // Of the file, where it is not kept itself (an entry of a studio before this one).
    std::optional<uint64_t> base_hash = {};
    bool deleted = false;  // somebody said so here: it is no file, and is to be none
};

// FNV-1a, 64 bit: whether a file is the one that it was, not against anybody who means harm.
uint64_t hash_of(std::string_view text);

class Journal {
public:
    Journal() = default;
    // `sync` is borrowed. `first` and later numbers are not used by anything else in that folder.
    Journal(std::filesystem::path folder, DiskSync& sync, uint64_t first);

    // By path. Files that are no entries are passed over.
    std::map<std::string, Unsaved> read();
    Status write(const std::string& path, const Unsaved& unsaved);
    void forget(const std::string& path);

    uint64_t next_number() const { return next_number_; }

private:
    struct Entry {
        uint64_t number = 0;
        std::string file = {};                   // that changes are put into; empty: another one
        std::vector<std::string> obsolete = {};  // older ones
        Unsaved unsaved = {};
        size_t bytes = 0;
    };

    void read_entry(const std::string& file, std::map<std::string, Entry>& found) const;
    Status begin(const std::string& path, Entry& entry, const Unsaved& unsaved);
    Status append(Entry& entry, const Unsaved& unsaved);

    std::filesystem::path folder_;
    DiskSync* sync_ = nullptr;
    uint64_t next_number_ = 1;
    std::map<std::string, Entry> entries_;  // by path
};

}  // namespace vagus::serve
