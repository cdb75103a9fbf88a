#include "base/folder_lock.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "base/test_folder.hpp"

namespace vagus {
namespace {

TEST(FolderLock, IsHeldByOneAtATime) {
    const test::Folder folder;
    const std::string path = (folder / "new/boards").string();
    {
        const auto first = FolderLock::take(path);
        ASSERT_TRUE(first.ok());
        EXPECT_TRUE(first.value().holds());
        const auto second = FolderLock::take(path);
        ASSERT_FALSE(second.ok());
        EXPECT_EQ(second.error().code, Code::Refused);
        EXPECT_EQ(second.error().what, path + ": another program uses this folder");
    }
    EXPECT_TRUE(FolderLock::take(path).ok());
}

// The file is replaced, as write_file() does, and is still held; so it is by the name of a link.
TEST(FolderLock, HoldsAFileThatIsReplaced) {
    const test::Folder folder;
    const std::string path = (folder / "rover.abo").string();
    {
        const auto first = FolderLock::take_file(path);
        ASSERT_TRUE(first.ok());
        ASSERT_TRUE(write_file(path, "new").ok());
        const std::string link = (folder / "link.abo").string();
        std::filesystem::create_symlink(path, link);
        for (const std::string& name : {path, link}) {
            const auto second = FolderLock::take_file(name);
            ASSERT_FALSE(second.ok());
            EXPECT_EQ(second.error().code, Code::Refused);
            EXPECT_EQ(second.error().what, name + ": another program uses this file");
        }
    }
    EXPECT_TRUE(FolderLock::take_file(path).ok());
}

TEST(FolderLock, SaysWhyAFolderCannotBeMade) {
    const auto taken = FolderLock::take("/dev/null/boards");
    ASSERT_FALSE(taken.ok());
    EXPECT_EQ(taken.error().code, Code::Unavailable);
}

}  // namespace
}  // namespace vagus
