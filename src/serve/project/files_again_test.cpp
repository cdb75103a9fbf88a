// Texts without a file, and names that another text had before: what pages that come back find.
#include <gmock/gmock.h>

#include "serve/project/test_files.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

struct FilesAgainTest : FilesTest {};

// What was seen: delete a file that nothing was typed into, restart; its tab could not save it.
TEST_F(FilesAgainTest, ADeletedTextThatIsOpenSurvivesManyRestarts) {
    {
        Files files(root);
        ASSERT_TRUE(files.open("note.txt").ok());
        EXPECT_TRUE(files.remove("note.txt").ok());
    }
    for (int restart = 0; restart < 3; ++restart) {
        Files files(root);
        files.tick(1s);
        if (restart == 1) {
            ASSERT_TRUE(files.open("note.txt").ok());
        }
        files.tick(1s + kUnclaimedFor - 1ms);
    }
    Files files(root);
    EXPECT_TRUE(files.recovered().empty());
    EXPECT_FALSE(files.exists("note.txt"));
    EXPECT_EQ(files.open("note.txt").value().text, "hello\n");
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "hello\n");
}

TEST_F(FilesAgainTest, ADeletedTextThatNobodyAsksForIsInTheTrashAsItWasTyped) {
    {
        Files files(root);
        edit(files, "note.txt", {{0, 5, "typed"}});
        EXPECT_TRUE(files.remove("note.txt").ok());
    }
    {
        Files files(root);
        files.tick(1s);
        files.tick(1s + kUnclaimedFor);
        EXPECT_FALSE(files.open("note.txt").ok());
        EXPECT_EQ(on_disk(".vagus/trash/note.txt 2"), "typed\n");
    }
    EXPECT_FALSE(Files(root).open("note.txt").ok());
}

// Else the text is said to be saved, and what runs is the other file.
TEST_F(FilesAgainTest, AFileThatIsReplacedByALinkOutOfTheProjectIsGone) {
    const fs::path outside = root.string() + "-outside.txt";
    std::ofstream(outside) << "another";
    Files files(root);
    ASSERT_TRUE(files.open("note.txt").ok());
    fs::remove(root / "note.txt");
    fs::create_symlink(outside, root / "note.txt");
    files.tick(kDiskEvery);
    EXPECT_TRUE(files.state("note.txt").value().gone);
    EXPECT_EQ(files.save("note.txt").error().code, Code::BadInput);
    EXPECT_EQ(on_disk("note.txt"), "another");
    fs::remove(root / "note.txt");
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "hello\n");
    fs::remove(outside);
}

TEST_F(FilesAgainTest, AfterARestartANewFileIsNotMergedWithTheDeletedTextOfItsName) {
    {
        Files files(root);
        write("note.txt", "one\ntwo\n");
        edit(files, "note.txt", {{0, 3, "typed"}});
        EXPECT_TRUE(files.remove("note.txt").ok());
    }
    write("note.txt", "one\nother\n");
    Files files(root);
    EXPECT_THAT(files.recovered(), ElementsAre("note.txt"));
    EXPECT_EQ(files.open("note.txt").value().text, "typed\ntwo\n");
    EXPECT_EQ(files.disk_text("note.txt").value(), "one\nother\n");
}

// A page that was away knows the old text by its old name.
TEST_F(FilesAgainTest, VersionsOfARenamedTextDoNotFitTheOneThatGetsItsName) {
    write("other.txt", "other\n");
    Files files(root);
    ASSERT_TRUE(files.open("other.txt").ok());
    edit(files, "note.txt", {{0, 0, "a"}});
    const uint32_t known = edit(files, "note.txt", {{0, 0, "b"}});
    edit(files, "other.txt", {{0, 0, "a"}});
    edit(files, "other.txt", {{0, 0, "b"}});
    ASSERT_TRUE(files.rename("note.txt", "old.txt").ok());
    ASSERT_TRUE(files.rename("other.txt", "note.txt").ok());
    EXPECT_FALSE(files.edit("note.txt", known, {{0, 1, ""}}, "me").ok());
    EXPECT_EQ(files.since("note.txt", known).value().text, "baother\n");
    ASSERT_TRUE(files.rename("note.txt", "third.txt").ok());
    const uint32_t third = files.version("third.txt");
    ASSERT_TRUE(files.make("note.txt", "new\n").ok());
    EXPECT_GT(files.version("note.txt"), third);
}

}  // namespace
}  // namespace vagus::serve
