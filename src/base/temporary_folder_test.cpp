#include "base/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "base/test_folder.hpp"

namespace vagus {
namespace {

namespace fs = std::filesystem;

// $TMPDIR is a folder of the test while it lives.
class TemporaryFolders : public testing::Test {
protected:
    TemporaryFolders() {
        if (const char* const value = std::getenv("TMPDIR")) before_ = value;
        ::setenv("TMPDIR", among_.string().c_str(), 1);
    }
    ~TemporaryFolders() override {
        before_ ? ::setenv("TMPDIR", before_->c_str(), 1) : ::unsetenv("TMPDIR");
    }

    static TemporaryFolder make(std::string_view name = "a") {
        return std::move(TemporaryFolder::make(name).value());
    }
    // Made by a process that ends without deleting anything, as one that is killed does.
    void leave_behind(std::string_view name) {
        const pid_t child = ::fork();
        if (child == 0) {
            const TemporaryFolder folder = make(name);
            fs::create_directories(folder.path() + "/inside");
            ::_exit(0);
        }
        ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    }
    size_t there() const {
        size_t count = 0;
        for ([[maybe_unused]] const auto& one : fs::directory_iterator(among_.path())) ++count;
        return count;
    }

    test::Folder among_;
    std::optional<std::string> before_;
};

TEST_F(TemporaryFolders, GoWithTheirOwner) {
    std::optional<TemporaryFolder> folder(make());
    EXPECT_EQ(fs::path(folder->path()).parent_path(), among_.path());
    fs::create_directories(folder->path() + "/inside");
    const TemporaryFolder other(std::move(*folder));
    folder.reset();
    EXPECT_TRUE(fs::exists(other.path()));
}

TEST_F(TemporaryFolders, OneWhoseOwnerWasKilledGoesWhenTheNextIsMade) {
    leave_behind("a");
    EXPECT_EQ(there(), 1u);
    const TemporaryFolder folder = make();
    EXPECT_EQ(there(), 1u);
    EXPECT_TRUE(fs::exists(folder.path()));
}

TEST_F(TemporaryFolders, ThoseOfOthersStay) {
    const TemporaryFolder living = make();
    leave_behind("b");
    fs::create_directories(among_ / "vagus-a-xyz");  // not one of ours
    fs::create_directory_symlink(among_ / "vagus-a-xyz", among_ / "vagus-a-abcdef");
    const TemporaryFolder folder = make();
    EXPECT_TRUE(fs::exists(living.path()));
    EXPECT_TRUE(fs::exists(among_ / "vagus-a-xyz"));
    EXPECT_EQ(there(), 5u);
}

TEST_F(TemporaryFolders, WithoutAPlaceForThemTheErrorNamesIt) {
    ::setenv("TMPDIR", (among_ / "gone").string().c_str(), 1);
    const auto made = TemporaryFolder::make("a");
    ASSERT_FALSE(made.ok());
    EXPECT_NE(made.error().what.find("is the disk full?"), std::string::npos);
}

}  // namespace
}  // namespace vagus
