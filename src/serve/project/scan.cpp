#include "serve/project/scan.hpp"

#include <deque>

#include "base/text.hpp"
#include "serve/project/paths.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

FolderEntry looked_at(const fs::directory_entry& entry) {
    FolderEntry found{.name = entry.path().filename().string()};
    const bool link =
        fs::symlink_status(entry.path(), found.failed).type() == fs::file_type::symlink;
    if (found.failed) return found;
    const fs::file_type type = fs::status(entry.path(), found.failed).type();
    if (type == fs::file_type::not_found) {
        found.failed = std::make_error_code(std::errc::no_such_file_or_directory);
    }
    if (found.failed) return found;
    if (type == fs::file_type::directory) {
        found.is = link ? FolderEntry::Is::LinkToFolder : FolderEntry::Is::Folder;
    } else if (type == fs::file_type::regular) {
        found.is = FolderEntry::Is::File;
        found.size = fs::file_size(entry.path(), found.failed);
    }
    return found;
}

std::string why_of(const std::error_code& failed) {
    if (failed == std::errc::permission_denied) {
        return "it may not be read; give yourself the right to (chmod u+rwX), or move it out of "
               "the project";
    }
    if (failed == std::errc::too_many_symbolic_link_levels) {
        return "a link that leads to itself; delete it";
    }
    if (failed == std::errc::no_such_file_or_directory) {
        return "a link to what is not there; delete it";
    }
    return "it cannot be read: " + failed.message();
}

// Breadth first, so that a deep folder leaves room for what lies beside it.
class Scanner {
public:
    Scanner(const fs::path& root, const ReadFolder& read) : root_(root), read_(read) {}

    FolderScan scan() {
        left_.push_back({"", 0});
        while (!left_.empty() && scan_.entries.size() < kFilesMax) {
            const Folder folder = std::move(left_.front());
            left_.pop_front();
            look_into(folder);
        }
        scan_.more = scan_.more || !left_.empty();
        return std::move(scan_);
    }

private:
    struct Folder {
        std::string path;
        size_t depth = 0;
    };

    void look_into(const Folder& folder) {
        std::error_code failed;
        for (FolderEntry& entry : read_(root_ / folder.path, failed)) {
            const std::string path =
                folder.path.empty() ? entry.name : folder.path + "/" + entry.name;
            if (entry.name.starts_with('.')) continue;
            if (const auto why = fault_of_path(path)) {
                pass_over(shown(path), *why + "; rename it, or move it out of the project");
                continue;
            }
            if (scan_.entries.size() >= kFilesMax) {
                scan_.more = true;
                return;
            }
            keep(path, entry, folder.depth);
        }
        if (failed) pass_over(folder.path.empty() ? "." : folder.path, why_of(failed));
    }

    // What is no text in UTF-8 is not shown as one.
    static std::string shown(std::string path) {
        if (!malformed_utf8_at(path)) return path;
        for (char& byte : path) {
            if (static_cast<unsigned char>(byte) >= 0x80) byte = '?';
        }
        return path;
    }

    void keep(const std::string& path, const FolderEntry& entry, size_t depth) {
        if (entry.failed) return pass_over(path, why_of(entry.failed));
        if (entry.is == FolderEntry::Is::Other) {
            return pass_over(path, "it is neither a file nor a folder; move it out of the project");
        }
        scan_.entries.push_back({path, entry.is, entry.size});
        if (entry.is != FolderEntry::Is::Folder) return;
        if (depth < kFolderDepthMax) {
            left_.push_back({path, depth + 1});
        } else {
            scan_.more = true;
        }
    }

    void pass_over(const std::string& path, const std::string& why) {
        if (scan_.passed_over.size() < kPassedOverMax) scan_.passed_over.push_back({path, why});
    }

    const fs::path& root_;
    const ReadFolder& read_;
    FolderScan scan_;
    std::deque<Folder> left_;
};

}  // namespace

std::vector<FolderEntry> entries_of(const fs::path& folder, std::error_code& failed) {
    std::vector<FolderEntry> found;
    for (fs::directory_iterator entry(folder, failed);
         !failed && entry != fs::directory_iterator() && found.size() < kFolderEntriesMax;
         entry.increment(failed)) {
        found.push_back(looked_at(*entry));
    }
    return found;
}

FolderScan scan_folder(const fs::path& root, const ReadFolder& read) {
    return Scanner(root, read).scan();
}

}  // namespace vagus::serve
