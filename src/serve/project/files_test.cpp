#include "serve/project/files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "base/file.hpp"
#include "serve/project/paths.hpp"
#include "serve/project/utf16.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view kProject =
    "<network>\n<node nodeId=\"1\" name=\"a\">var x &lt;\n</node>\n<node name=\"b\">y\n</node>\n"
    "</network>\n";

TEST(Utf16, OffsetsCountSurrogatesTwice) {
    const std::string text = "aé😀b";  // 1, 2, 4, 1 bytes; 1, 1, 2, 1 units
    EXPECT_EQ(byte_of_unit(text, 2), 3u);
    EXPECT_EQ(byte_of_unit(text, 3), std::nullopt);  // inside of the pair
    EXPECT_EQ(byte_of_unit(text, 4), 7u);
    EXPECT_EQ(byte_of_unit(text, 5), 8u);
    EXPECT_EQ(byte_of_unit(text, 6), std::nullopt);
    EXPECT_EQ(units_of(text, 7), 4u);
}

TEST(Paths, OnlyWhatIsInside) {
    for (const char* good : {"a", "a/b.aesl", "Größe/x y.txt", "a.b-c_d"}) {
        EXPECT_TRUE(check_path(good).ok()) << good;
    }
    for (const char* bad : {"", "/etc/passwd", "..", "a/../b", "a//b", "a/", ".vagus/x", "a\\b",
                            "a\nb", "a:b", "con.", " a", "a#1", "\xff"}) {
        EXPECT_FALSE(check_path(bad).ok()) << bad;
    }
    EXPECT_TRUE(check_path(std::string(128, 'a')).ok());
    EXPECT_FALSE(check_path(std::string(129, 'a')).ok());
}

struct FilesTest : testing::Test {
    void SetUp() override {
        root = fs::path(testing::TempDir()) /
               ("files-" + std::to_string(::getpid()) + "-" +
                testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(root);
        fs::create_directories(root / "carbot");
        write("carbot/a.aesl", kProject);
        write("note.txt", "hello\n");
    }
    void TearDown() override { fs::remove_all(root); }
    void write(const std::string& path, std::string_view text) {
        std::ofstream(root / path) << text;
    }
    std::string on_disk(const std::string& path) {
        return read_file((root / path).string()).value();
    }
    uint32_t edit(Files& files, const std::string& doc, std::vector<TextChange> changes) {
        const auto edited = files.edit(doc, files.open(doc).value().version, changes, 7);
        EXPECT_TRUE(edited.ok()) << edited.error().what;
        return edited.ok() ? edited.value() : 0;
    }
    fs::path root;
};

TEST_F(FilesTest, AScriptIsADocumentOfItsOwn) {
    Files files(root);
    EXPECT_EQ(files.open("carbot/a.aesl").value().language, "aesl-file");
    EXPECT_EQ(files.open("carbot/a.aesl#1").value().text, "var x <\n");
    EXPECT_EQ(files.open("carbot/a.aesl#2").value().text, "y\n");
    EXPECT_FALSE(files.open("carbot/a.aesl#3").ok());
    EXPECT_FALSE(files.open("carbot/a.aesl#0").ok());
    EXPECT_FALSE(files.open("nothing.txt").ok());
    edit(files, "carbot/a.aesl#2", {{0, 1, "z & 1"}});
    EXPECT_EQ(files.open("carbot/a.aesl#1").value().version, 1u);  // its text did not change
    EXPECT_TRUE(files.open("carbot/a.aesl#1").value().unsaved);    // but its file did
    EXPECT_TRUE(files.save("carbot/a.aesl#2").ok());
    std::string expected(kProject);
    expected.replace(expected.find(">y") + 1, 1, "z &amp; 1");
    EXPECT_EQ(on_disk("carbot/a.aesl"), expected);
}

TEST_F(FilesTest, ChangesCountInTheTextBeforeThem) {
    Files files(root);
    EXPECT_EQ(edit(files, "note.txt", {{4, 5, "p!"}, {0, 1, "J"}}), 2u);
    EXPECT_EQ(files.open("note.txt").value().text, "Jellp!\n");
    EXPECT_EQ(files.open("note.txt").value().by, 7u);
    const auto stale = files.edit("note.txt", 1, {{0, 0, "x"}}, 7);
    EXPECT_EQ(stale.error().code, Code::Refused);
    for (const auto& [from, to] : {std::pair(8, 8), {3, 2}, {0, 99}}) {
        const auto wrong = files.edit(
            "note.txt", 2, {{static_cast<size_t>(from), static_cast<size_t>(to), ""}}, 7);
        EXPECT_FALSE(wrong.ok()) << from;
    }
    EXPECT_FALSE(files.edit("note.txt", 2, {{0, 3, "a"}, {2, 4, "b"}}, 7).ok());  // overlap
}

TEST_F(FilesTest, SavingWhatWasNotChangedTouchesNothing) {
    Files files(root);
    ASSERT_TRUE(files.open("note.txt").ok());
    const auto written = fs::last_write_time(root / "note.txt");
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(fs::last_write_time(root / "note.txt"), written);
}

TEST_F(FilesTest, WhatWasTypedComesBackAfterACrash) {
    {
        Files files(root);
        files.tick(0s);
        edit(files, "note.txt", {{0, 5, "unsaved"}});
        files.tick(kJournalWithin);
        // Killed: nothing more is written.
    }
    Files files(root);
    EXPECT_THAT(files.recovered(), ElementsAre("note.txt"));
    EXPECT_EQ(files.open("note.txt").value().text, "unsaved\n");
    EXPECT_TRUE(files.open("note.txt").value().unsaved);
    EXPECT_FALSE(files.open("note.txt").value().disk);
    EXPECT_EQ(on_disk("note.txt"), "hello\n");
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "unsaved\n");
    EXPECT_TRUE(Files(root).recovered().empty());
}

TEST_F(FilesTest, AfterACrashAChangedFileIsShownBesideTheText) {
    {
        Files files(root);
        edit(files, "note.txt", {{0, 5, "mine"}});
        files.tick(kJournalWithin);
    }
    write("note.txt", "theirs\n");
    Files files(root);
    EXPECT_EQ(files.open("note.txt").value().text, "mine\n");
    EXPECT_EQ(files.open("note.txt").value().disk, "theirs\n");
    EXPECT_TRUE(files.keep_mine("note.txt").ok());
    EXPECT_FALSE(files.open("note.txt").value().disk);
    EXPECT_TRUE(files.revert("note.txt").ok());
    EXPECT_EQ(files.open("note.txt").value().text, "theirs\n");
}

TEST_F(FilesTest, AChangeOnDiskIsTakenOverByACleanTextAndShownBesideAnUnsavedOne) {
    Files files(root);
    ASSERT_TRUE(files.open("note.txt").ok());
    std::vector<std::string> changed;
    files.on_change([&](const std::string& path) { changed.push_back(path); });
    write("note.txt", "one\n");
    fs::last_write_time(root / "note.txt", fs::file_time_type::clock::now() + 5s);
    files.tick(kDiskEvery);
    EXPECT_EQ(files.open("note.txt").value().text, "one\n");
    EXPECT_THAT(changed, ElementsAre("note.txt"));
    edit(files, "note.txt", {{0, 3, "mine"}});
    write("note.txt", "two\n");
    fs::last_write_time(root / "note.txt", fs::file_time_type::clock::now() + 10s);
    files.tick(kDiskEvery * 2);
    EXPECT_EQ(files.open("note.txt").value().text, "mine\n");
    EXPECT_EQ(files.open("note.txt").value().disk, "two\n");
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "mine\n");
}

TEST_F(FilesTest, LinksThatLeaveTheProjectAreNotFollowed) {
    const fs::path outside = root.string() + "-outside";
    fs::create_directories(outside);
    std::ofstream(outside / "secret.txt") << "secret";
    fs::create_directory_symlink(outside, root / "way");
    fs::create_symlink(outside / "secret.txt", root / "link.txt");
    Files files(root);
    EXPECT_THAT(files.open("way/secret.txt").error().what, HasSubstr("leads out of the project"));
    EXPECT_FALSE(files.open("link.txt").ok());
    EXPECT_FALSE(files.bytes("link.txt").ok());
    EXPECT_FALSE(files.make("way/new.txt", "x").ok());
    EXPECT_FALSE(fs::exists(outside / "new.txt"));
    fs::remove_all(outside);
}

TEST_F(FilesTest, FilesAreMadeRenamedAndPutIntoTheTrash) {
    Files files(root);
    EXPECT_TRUE(files.make("new/b.txt", "b").ok());
    EXPECT_FALSE(files.make("new/b.txt", "c").ok());
    edit(files, "new/b.txt", {{0, 0, "ab"}});
    EXPECT_TRUE(files.rename("new", "old").ok());
    EXPECT_EQ(files.open("old/b.txt").value().text, "abb");
    EXPECT_FALSE(files.rename("old", "carbot").ok());
    EXPECT_TRUE(files.remove("old").ok());
    EXPECT_FALSE(fs::exists(root / "old"));
    EXPECT_TRUE(fs::exists(root / ".vagus/trash/old/b.txt"));
    bool more = true;
    std::vector<std::string> names;
    for (const FileInfo& file : files.list(more)) names.push_back(file.path + ":" + file.kind);
    EXPECT_THAT(names, ElementsAre("carbot:folder", "carbot/a.aesl:script", "note.txt:text"));
    EXPECT_FALSE(more);
}

TEST_F(FilesTest, WithoutAProjectEverythingIsRefused) {
    Files files;
    EXPECT_FALSE(files.is_open());
    bool more = true;
    EXPECT_TRUE(files.list(more).empty());
    EXPECT_FALSE(more);
    const Error expected{Code::Unavailable, "no project is open; open one first"};
    for (const Error& error :
         {files.open("a").error(), files.edit("a", 1, {}, 1).error(),
          files.replace("a", "", 1).error(), files.save("a").error(), files.save_all().error(),
          files.revert("a").error(), files.keep_mine("a").error(), files.text("a").error(),
          files.bytes("a").error(), files.make("a", "").error(), files.make_folder("a").error(),
          files.rename("a", "b").error(), files.remove("a").error()}) {
        EXPECT_EQ(error.code, expected.code);
        EXPECT_EQ(error.what, expected.what);
    }
    files.tick(1s);
    EXPECT_GT(files.next_tick(), 1000h);
}

TEST_F(FilesTest, LeavingKeepsWhatWasTypedInTheJournalAndForgetsTheRest) {
    Files files;
    files.enter(root);
    edit(files, "note.txt", {{0, 5, "typed"}});
    files.leave();  // before the journal was due
    EXPECT_FALSE(files.is_open());
    EXPECT_FALSE(files.open("note.txt").ok());
    EXPECT_FALSE(files.is_unsaved("note.txt"));
    files.enter(root);
    EXPECT_THAT(files.recovered(), ElementsAre("note.txt"));
    EXPECT_EQ(files.open("note.txt").value().text, "typed\n");
}

TEST_F(FilesTest, AFileOpenedAloneIsListedAloneAndRecoversOnlyItself) {
    {
        Files files(root);
        edit(files, "note.txt", {{0, 5, "typed"}});
        files.leave();
    }
    Files files;
    files.enter(root, {"carbot/a.aesl"});
    bool more = false;
    ASSERT_EQ(files.list(more).size(), 1u);
    EXPECT_EQ(files.list(more)[0].path, "carbot/a.aesl");
    EXPECT_TRUE(files.recovered().empty());
    EXPECT_EQ(files.open("note.txt").value().text, "typed\n");  // asked for: its text, too
    EXPECT_THAT(files.recovered(), ElementsAre("note.txt"));
}

TEST_F(FilesTest, AFileThatIsTakenAwayIsToldAndCanBeSavedAgain) {
    Files files(root);
    ASSERT_TRUE(files.open("note.txt").ok());
    fs::remove(root / "note.txt");
    std::vector<std::string> changed;
    files.on_change([&](const std::string& path) { changed.push_back(path); });
    files.tick(kDiskEvery);
    EXPECT_THAT(changed, ElementsAre("note.txt"));
    EXPECT_TRUE(files.open("note.txt").value().gone);
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "hello\n");
    EXPECT_FALSE(files.open("note.txt").value().gone);
}

TEST_F(FilesTest, LongAndBinaryFilesAreNotEdited) {
    write("long.txt", std::string(kTextBytesMax + 1, 'x'));
    write("binary.txt", "\xff\xfe");
    Files files(root);
    EXPECT_EQ(files.open("long.txt").error().code, Code::Limit);
    EXPECT_THAT(files.open("binary.txt").error().what, HasSubstr("UTF-8"));
    write("full.txt", std::string(kTextBytesMax, 'x'));
    EXPECT_EQ(files.edit("full.txt", files.open("full.txt").value().version, {{0, 0, "y"}}, 1)
                  .error()
                  .code,
              Code::Limit);
}

}  // namespace
}  // namespace vagus::serve
