// What git keeps of a file in the folder of a project. Git is asked by a child; nothing in its
// configuration makes it start another program or ask somebody else for what it does not have.
//
//     auto log = ask_git_for_versions(root, "Go.plan.json").value();
//     if (log.read() && log.good()) show(git_versions(log.text()));   // asked until it has ended
//     auto text = ask_git_for_text(root, "Go.plan.json", "HEAD~2");
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "serve/process.hpp"

namespace vagus::serve {

constexpr size_t kGitVersionsMax = 30;
constexpr size_t kRevisionMax = 64;
constexpr size_t kGitTextMax = 4u << 20;  // bytes

struct GitVersion {
    std::string revision;  // the hash of a commit
    double when_wall = 0;  // ms since 1970
    std::string by;
    std::string subject;
};

// The last commits that changed a file, the newest first; `path` counts from the folder.
Result<Printing> ask_git_for_versions(const std::string& folder, const std::string& path);
std::vector<GitVersion> git_versions(std::string_view printed);

// The text of a file at a revision. The Error says what is no revision.
Result<Printing> ask_git_for_text(const std::string& folder, const std::string& path,
                                  const std::string& revision);

}  // namespace vagus::serve
