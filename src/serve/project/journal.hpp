// What was typed and not saved, kept in files of its own under .vagus/journal, so that a crash
// loses at most the last second. One file a text: a first line with the path and what the file on
// disk was, then the text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace vagus::serve {

struct Unsaved {
    uint64_t base = 0;  // hash of the file that the text began as; 0: there was none
    std::string text;
};

// FNV-1a, 64 bit: whether a file is the one that it was, not against anybody who means harm.
uint64_t hash_of(std::string_view text);

class Journal {
public:
    explicit Journal(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // By path. Files that are no entries, or were cut off, are passed over.
    std::map<std::string, Unsaved> read() const;
    // Replaces the entry atomically.
    Status write(const std::string& path, const Unsaved& unsaved) const;
    void forget(const std::string& path) const;

private:
    std::filesystem::path entry_of(const std::string& path) const;
    std::filesystem::path folder_;
};

}  // namespace vagus::serve
