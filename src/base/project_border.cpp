#include "base/project_border.hpp"

#include <algorithm>
#include <filesystem>

namespace vagus {
namespace {

namespace fs = std::filesystem;

// What Vagus keeps beside a project. A project in there, such as an older version of the one
// around it, is no part of that one.
constexpr const char* kKeptFolder = ".vagus";

fs::path folder_of(const std::string& file) {
    const fs::path folder = fs::path(file).parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

bool holds_project(const fs::path& folder) {
    std::error_code error;
    return fs::is_regular_file(folder / kProjectFileName, error);
}

// With as many links followed as there are; what does not exist is kept as it is written.
fs::path without_links(const fs::path& path) {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(path, error);
    return error ? fs::absolute(path, error).lexically_normal() : real;
}

bool is_within(const fs::path& folder, const fs::path& path) {
    const auto [left, unused] =
        std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return left == folder.end();
}

}  // namespace

std::string project_border(const std::string& file) {
    std::string border;
    fs::path folder = without_links(folder_of(file));
    while (true) {
        if (holds_project(folder)) border = folder.string();
        if (folder == folder.parent_path() || folder.filename() == kKeptFolder) return border;
        folder = folder.parent_path();
    }
}

std::string innermost_project(const std::string& file) {
    fs::path folder = without_links(folder_of(file));
    while (!holds_project(folder)) {
        if (folder == folder.parent_path()) return "";
        folder = folder.parent_path();
    }
    return folder.string();
}

Status check_inside(const std::string& border, const std::string& path) {
    if (border.empty() || is_within(border, without_links(path))) return Status::done();
    return Error{Code::Refused, path + " is outside of the project " + border +
                                    " (the folder of its vagus.json); copy the file into the "
                                    "project, and name that copy"};
}

Result<std::string> path_beside(const std::string& file, const std::string& named) {
    const std::string path = (folder_of(file) / named).lexically_normal().string();
    TRY(check_inside(project_border(file), path));
    return path;
}

}  // namespace vagus
