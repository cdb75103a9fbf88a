#include "base/project_border.hpp"
#include "base/test_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/file.hpp"

namespace vagus {
namespace {

namespace fs = std::filesystem;

// all/vagus.json, all/one/vagus.json, all/other/, outside/.
class ProjectBorderTest : public testing::Test {
protected:
    ProjectBorderTest() {
        for (const char* sub : {"all/one/deep", "all/other", "outside"}) {
            fs::create_directories(folder_ / sub);
        }
        for (const char* file : {"all/vagus.json", "all/one/vagus.json", "outside/f"}) {
            EXPECT_TRUE(write_file(path(file), "{}").ok());
        }
    }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    // The path from the folder of this test, or the kind of error.
    std::string found(const std::string& file, const std::string& named) const {
        const Result<std::string> at = path_beside(path(file), named);
        if (at.ok()) return fs::path(at.value()).lexically_relative(folder_).string();
        return at.error().code == Code::Refused ? "refused" : "another error";
    }

    test::Folder folder_;
};

TEST_F(ProjectBorderTest, TheOutermostProjectIsTheBorderAndTheInnermostIsOpened) {
    EXPECT_EQ(project_border(path("all/one/deep/w.world.json")), path("all"));
    EXPECT_EQ(innermost_project(path("all/one/deep/w.world.json")), path("all/one"));
    EXPECT_EQ(innermost_project(path("all/other/w.world.json")), path("all"));
    EXPECT_EQ(project_border(path("outside/w.world.json")), "");
}

// An older version of a project is below it, and is no part of it.
TEST_F(ProjectBorderTest, WhatIsKeptBesideAProjectIsNoPartOfIt) {
    const fs::path kept = fs::path(path("all")) / ".vagus" / "versions" / "1" / "files";
    fs::create_directories(kept / "one");
    EXPECT_TRUE(write_file((kept / "vagus.json").string(), "{}").ok());
    EXPECT_EQ(project_border((kept / "one" / "w.world.json").string()), kept.string());
    EXPECT_EQ(project_border((kept.parent_path() / "w.world.json").string()), "");
}

TEST_F(ProjectBorderTest, PathsCountFromTheFolderOfTheFile) {
    EXPECT_EQ(found("all/one/w.json", "s.aesl"), "all/one/s.aesl");
    EXPECT_EQ(found("all/one/w.json", "../other/s.aesl"), "all/other/s.aesl");
    EXPECT_EQ(found("all/one/w.json", path("all/other/s.aesl")), "all/other/s.aesl");
}

TEST_F(ProjectBorderTest, NoPathLeadsOut) {
    EXPECT_EQ(found("all/one/w.json", "../../outside/f"), "refused");
    EXPECT_EQ(found("all/one/w.json", "../../allmost/f"), "refused") << "a name that begins alike";
    EXPECT_EQ(found("all/one/w.json", path("outside/f")), "refused");
    EXPECT_EQ(found("all/w.json", "/etc/passwd"), "refused");
    EXPECT_EQ(found("outside/w.json", "../all/one/f"), "all/one/f") << "no project, no border";
}

TEST_F(ProjectBorderTest, LinksThatLeaveAreNotFollowed) {
    fs::create_symlink(folder_ / "outside", folder_ / "all/link");
    fs::create_symlink(folder_ / "outside/f", folder_ / "all/one/f");
    fs::create_symlink("../other", folder_ / "all/one/near");
    EXPECT_EQ(found("all/w.json", "link/f"), "refused");
    EXPECT_EQ(found("all/one/w.json", "f"), "refused");
    EXPECT_EQ(found("all/one/w.json", "near/s.aesl"), "all/one/near/s.aesl");
}

TEST_F(ProjectBorderTest, TheErrorNamesPathAndProject) {
    const Status inside = check_inside(path("all"), path("outside/f"));
    EXPECT_EQ(inside.error().what,
              path("outside/f") + " is outside of the project " + path("all") +
                  " (the folder of its vagus.json); copy the file into the project, and name that "
                  "copy");
}

}  // namespace
}  // namespace vagus
