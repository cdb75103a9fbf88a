#include "serve/workbench/git.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace vagus::serve {

namespace {

constexpr char kBetween = '\x1f';  // the fields of a commit

// A folder may be somebody else's: its configuration must not start programs. Variables that lead
// to another repository are those of whoever started the studio.
std::vector<std::string> git_words(const std::string& folder) {
    return {"env",
            "-u",
            "GIT_DIR",
            "-u",
            "GIT_WORK_TREE",
            "GIT_ALLOW_PROTOCOL=none",
            "GIT_OPTIONAL_LOCKS=0",
            "git",
            "--no-pager",
            "--literal-pathspecs",
            "-c",
            "core.fsmonitor=false",
            "-C",
            folder};
}

// Hashes, names, HEAD~2, v1.0^{}: never an option, nor the name of a path.
bool is_revision(std::string_view typed) {
    constexpr std::string_view kSigns = "._/~^@{}-";
    if (typed.empty() || typed.size() > kRevisionMax || typed.front() == '-') return false;
    for (const char letter : typed) {
        const bool plain = (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
                           (letter >= 'A' && letter <= 'Z');
        if (!plain && kSigns.find(letter) == kSigns.npos) return false;
    }
    return true;
}

Result<Printing> start(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return Printing::start(words, kGitTextMax);
}

std::string_view cut(std::string_view& text, char end) {
    const std::string_view field = text.substr(0, text.find(end));
    text.remove_prefix(std::min(text.size(), field.size() + 1));
    return field;
}

}  // namespace

Result<Printing> ask_git_for_versions(const std::string& folder, const std::string& path) {
    return start(git_words(folder), {"log", "-z", "--no-show-signature",
                                     fmt::format("--max-count={}", kGitVersionsMax),
                                     "--format=%H%x1f%ct%x1f%an%x1f%s", "--", path});
}

std::vector<GitVersion> git_versions(std::string_view printed) {
    std::vector<GitVersion> versions;
    while (!printed.empty() && versions.size() < kGitVersionsMax) {
        std::string_view commit = cut(printed, '\0');
        GitVersion version;
        version.revision = cut(commit, kBetween);
        const std::string_view seconds = cut(commit, kBetween);
        int64_t when = 0;
        (void)std::from_chars(seconds.data(), seconds.data() + seconds.size(), when);
        version.when_wall = static_cast<double>(when) * 1000;
        version.by = cut(commit, kBetween);
        version.subject = commit;
        if (is_revision(version.revision)) versions.push_back(std::move(version));
    }
    return versions;
}

Result<Printing> ask_git_for_text(const std::string& folder, const std::string& path,
                                  const std::string& revision) {
    if (!is_revision(revision)) {
        return Error{Code::BadInput,
                     fmt::format("in.revision: expected a revision of git, as 1a2b3c4 or HEAD~2, "
                                 "found \"{}\"",
                                 revision)};
    }
    return start(git_words(folder), {"cat-file", "blob", revision + ":./" + path});
}

}  // namespace vagus::serve
