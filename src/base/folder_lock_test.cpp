#include "base/folder_lock.hpp"

#include <gtest/gtest.h>

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

TEST(FolderLock, SaysWhyAFolderCannotBeMade) {
    const auto taken = FolderLock::take("/dev/null/boards");
    ASSERT_FALSE(taken.ok());
    EXPECT_EQ(taken.error().code, Code::Unavailable);
}

}  // namespace
}  // namespace vagus
