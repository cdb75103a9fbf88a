// What lies in a folder, as a project lists it. Never throws, never waits: a link that loops, a
// folder that may not be entered, a pipe are passed over and named, and the rest is listed.
//
//     const FolderScan scan = scan_folder(root);
//     for (const ScanFault& one : scan.passed_over) say("warning", one.path + ": " + one.why);
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <vector>

namespace vagus::serve {

constexpr size_t kFilesMax = 2000;
constexpr size_t kFolderDepthMax = 12;
constexpr size_t kFolderEntriesMax = 20'000;  // of one folder that are looked at
constexpr size_t kPassedOverMax = 100;        // that are named

// One name in a folder. A link is what it leads to, except that a folder is not entered by it.
struct FolderEntry {
    enum class Is { Folder, File, LinkToFolder, Other };
    std::string name;
    Is is = Is::Other;
    uintmax_t size = 0;           // of a file
    std::error_code failed = {};  // it could not be looked at
};

// In no order; a failure ends the list, which holds what was read until then.
std::vector<FolderEntry> entries_of(const std::filesystem::path& folder, std::error_code& failed);

struct ScanEntry {
    std::string path;  // from the root, with / between folders
    FolderEntry::Is is = FolderEntry::Is::File;
    uintmax_t size = 0;
};
struct ScanFault {
    std::string path;
    std::string why;  // with what can be done
    friend bool operator==(const ScanFault&, const ScanFault&) = default;
};
struct FolderScan {
    std::vector<ScanEntry> entries;
    bool more = false;  // than kFilesMax, or deeper than kFolderDepthMax
    std::vector<ScanFault> passed_over;
};

using ReadFolder =
    std::function<std::vector<FolderEntry>(const std::filesystem::path&, std::error_code&)>;

// What begins with a dot is left out, .vagus and .git among it. Other names that a project cannot
// have (paths.hpp) are passed over.
FolderScan scan_folder(const std::filesystem::path& root, const ReadFolder& read = entries_of);

}  // namespace vagus::serve
