#include "serve/project/files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <semaphore>

#include "serve/project/paths.hpp"
#include "serve/project/test_files.hpp"
#include "serve/project/utf16.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view kNetwork =
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

struct ProjectFilesTest : FilesTest {
    void SetUp() override {
        FilesTest::SetUp();
        write("carbot/a.aesl", kNetwork);
    }
};

TEST_F(ProjectFilesTest, AScriptIsADocumentOfItsOwn) {
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
    std::string expected(kNetwork);
    expected.replace(expected.find(">y") + 1, 1, "z &amp; 1");
    EXPECT_EQ(on_disk("carbot/a.aesl"), expected);
}

TEST_F(ProjectFilesTest, ChangesCountInTheTextBeforeThem) {
    Files files(root);
    EXPECT_EQ(edit(files, "note.txt", {{4, 5, "p!"}, {0, 1, "J"}}), 2u);
    EXPECT_EQ(files.open("note.txt").value().text, "Jellp!\n");
    EXPECT_EQ(files.open("note.txt").value().by, "me");
    const auto stale = files.edit("note.txt", 1, {{0, 0, "x"}}, "me");
    EXPECT_EQ(stale.error().code, Code::Refused);
    for (const auto& [from, to] : {std::pair(8, 8), {3, 2}, {0, 99}}) {
        const auto wrong = files.edit(
            "note.txt", 2, {{static_cast<size_t>(from), static_cast<size_t>(to), ""}}, "me");
        EXPECT_FALSE(wrong.ok()) << from;
    }
    EXPECT_FALSE(files.edit("note.txt", 2, {{0, 3, "a"}, {2, 4, "b"}}, "me").ok());  // overlap
}

TEST_F(ProjectFilesTest, SavingWhatWasNotChangedTouchesNothing) {
    Files files(root);
    ASSERT_TRUE(files.open("note.txt").ok());
    const auto written = fs::last_write_time(root / "note.txt");
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(fs::last_write_time(root / "note.txt"), written);
}

TEST_F(ProjectFilesTest, WhatWasTypedComesBackAfterACrash) {
    {
        Files files(root);
        edit(files, "note.txt", {{0, 5, "unsaved"}});
        // Killed: nothing more is written.
    }
    Files files(root);
    EXPECT_THAT(files.recovered(), ElementsAre("note.txt"));
    EXPECT_EQ(files.open("note.txt").value().text, "unsaved\n");
    EXPECT_TRUE(files.open("note.txt").value().unsaved);
    EXPECT_FALSE(files.has_conflict("note.txt"));
    EXPECT_EQ(on_disk("note.txt"), "hello\n");
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "unsaved\n");
    EXPECT_TRUE(Files(root).recovered().empty());
}

TEST_F(ProjectFilesTest, AfterACrashAChangedFileIsShownBesideTheText) {
    {
        Files files(root);
        edit(files, "note.txt", {{0, 5, "mine"}});
    }
    write("note.txt", "theirs\n");
    Files files(root);
    EXPECT_EQ(files.open("note.txt").value().text, "mine\n");
    EXPECT_EQ(files.disk_text("note.txt").value(), "theirs\n");
    EXPECT_TRUE(files.keep_mine("note.txt").ok());
    EXPECT_FALSE(files.has_conflict("note.txt"));
    EXPECT_TRUE(files.revert("note.txt", "me").ok());
    EXPECT_EQ(files.open("note.txt").value().text, "theirs\n");
}

TEST_F(ProjectFilesTest, BothCanBeKeptAndSaved) {
    {
        Files files(root);
        edit(files, "note.txt", {{0, 5, "mine"}});
    }
    write("note.txt", "theirs\n");
    Files files(root);
    EXPECT_TRUE(files.keep_both("note.txt", "me").ok());
    EXPECT_FALSE(files.has_conflict("note.txt"));
    EXPECT_EQ(files.open("note.txt").value().text, "mine\ntheirs\n");
    ASSERT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "mine\ntheirs\n");
}

TEST_F(ProjectFilesTest, BothLinesOfAScriptAreKeptWithoutTheTagBeforeThem) {
    const auto file = [](const std::string& left) {
        return "<network>\n<node nodeId=\"1\" name=\"left\">" + left +
               "</node>\n<node nodeId=\"2\" name=\"right\">var r\n</node>\n</network>\n";
    };
    write("two.aesl", file("var a = 0"));
    Files files(root);
    ASSERT_EQ(files.open("two.aesl#1").value().text, "var a = 0");
    edit(files, "two.aesl#1", {{8, 9, "1"}});
    write("two.aesl", file("var a = 2"));
    EXPECT_FALSE(files.save("two.aesl").ok());
    EXPECT_TRUE(files.keep_both("two.aesl#1", "me").ok());
    EXPECT_EQ(files.open("two.aesl#1").value().text, "var a = 1\nvar a = 2");
    ASSERT_TRUE(files.save("two.aesl").ok());
    EXPECT_EQ(on_disk("two.aesl"), file("var a = 1\nvar a = 2"));
}

TEST_F(ProjectFilesTest, AChangeOnDiskIsTakenOverByACleanTextAndShownBesideAnUnsavedOne) {
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
    EXPECT_EQ(files.disk_text("note.txt").value(), "two\n");
    EXPECT_FALSE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "two\n");
}

TEST_F(ProjectFilesTest, LinksThatLeaveTheProjectAreNotFollowed) {
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

TEST_F(ProjectFilesTest, FilesAreMadeRenamedAndPutIntoTheTrash) {
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

TEST_F(ProjectFilesTest, WithoutAProjectEverythingIsRefused) {
    Files files;
    EXPECT_FALSE(files.is_open());
    bool more = true;
    EXPECT_TRUE(files.list(more).empty());
    EXPECT_FALSE(more);
    const Error expected{Code::Unavailable, "no project is open; open one first"};
    std::vector<std::string> saved;
    for (const Error& error :
         {files.open("a").error(), files.edit("a", 1, {}, "me").error(),
          files.replace("a", "", "me").error(), files.save("a").error(),
          files.save_all(saved).error(), files.revert("a", "me").error(),
          files.keep_mine("a").error(), files.keep_both("a", "me").error(), files.text("a").error(),
          files.bytes("a").error(), files.make("a", "").error(), files.make_folder("a").error(),
          files.rename("a", "b").error(), files.remove("a").error()}) {
        EXPECT_EQ(error.code, expected.code);
        EXPECT_EQ(error.what, expected.what);
    }
    files.tick(1s);
    EXPECT_GT(files.next_tick(), 1000h);
}

TEST_F(ProjectFilesTest, LeavingKeepsWhatWasTypedInTheJournalAndForgetsTheRest) {
    Files files;
    files.enter(root);
    edit(files, "note.txt", {{0, 5, "typed"}});
    files.leave();
    EXPECT_FALSE(files.is_open());
    EXPECT_FALSE(files.open("note.txt").ok());
    EXPECT_FALSE(files.is_unsaved("note.txt"));
    files.enter(root);
    EXPECT_THAT(files.recovered(), ElementsAre("note.txt"));
    EXPECT_EQ(files.open("note.txt").value().text, "typed\n");
}

TEST_F(ProjectFilesTest, AFileOpenedAloneIsListedAloneAndRecoversOnlyItself) {
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

TEST_F(ProjectFilesTest, AFileThatIsTakenAwayIsToldAndCanBeSavedAgain) {
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

// What was seen: type, delete the file in the tree, kill -9; the text was nowhere any more.
TEST_F(ProjectFilesTest, WhatWasTypedIntoADeletedFileComesBackAfterACrash) {
    {
        Files files(root);
        edit(files, "note.txt", {{0, 5, "typed"}});
        EXPECT_TRUE(files.remove("note.txt").ok());
        edit(files, "note.txt", {{0, 0, "and "}});
        EXPECT_FALSE(files.exists("note.txt"));
        std::vector<std::string> saved;
        EXPECT_TRUE(files.save_all(saved).ok());
        EXPECT_TRUE(saved.empty());  // deleted is deleted
        // Killed.
    }
    EXPECT_EQ(on_disk(".vagus/trash/note.txt"), "hello\n");
    Files files(root);
    EXPECT_THAT(files.recovered(), ElementsAre());
    EXPECT_FALSE(files.exists("note.txt"));
    bool more = false;
    for (const FileInfo& file : files.list(more)) EXPECT_NE(file.path, "note.txt");
    std::vector<std::string> saved;
    EXPECT_TRUE(files.save_all(saved).ok());
    EXPECT_TRUE(saved.empty());  // as before
    EXPECT_EQ(files.open("note.txt").value().text, "and typed\n");
    EXPECT_TRUE(files.open("note.txt").value().gone);
    edit(files, "note.txt", {{0, 0, "more "}});
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "more and typed\n");
}

TEST_F(ProjectFilesTest, ATextWithoutAFileGoesIntoTheTrashItself) {
    {
        Files files(root);
        edit(files, "note.txt", {{0, 5, "typed"}});
        fs::remove(root / "note.txt");
    }
    {
        Files files(root);
        EXPECT_TRUE(files.exists("note.txt"));
        EXPECT_TRUE(files.remove("note.txt").ok());
        EXPECT_FALSE(files.exists("note.txt"));
        EXPECT_EQ(on_disk(".vagus/trash/note.txt"), "typed\n");
    }
    EXPECT_TRUE(Files(root).recovered().empty());
}

TEST_F(ProjectFilesTest, ATextWhoseFileSomebodyTookAwaySurvivesARestart) {
    {
        Files files(root);
        ASSERT_TRUE(files.open("note.txt").ok());
        fs::remove(root / "note.txt");
        files.tick(kDiskEvery);
    }
    {
        Files files(root);
        EXPECT_TRUE(files.recovered().empty());  // nobody typed anything
        bool more = false;
        for (const FileInfo& file : files.list(more)) EXPECT_NE(file.path, "note.txt");
        EXPECT_TRUE(files.open("note.txt").value().gone);
        EXPECT_EQ(files.open("note.txt").value().text, "hello\n");
        EXPECT_TRUE(files.save("note.txt").ok());
        EXPECT_EQ(on_disk("note.txt"), "hello\n");
    }
}

TEST_F(ProjectFilesTest, AFileMadeInThePlaceOfADeletedOneIsShownBesideTheUnsavedText) {
    Files files(root);
    edit(files, "note.txt", {{0, 5, "typed"}});
    EXPECT_TRUE(files.remove("note.txt").ok());
    EXPECT_TRUE(files.make("note.txt", "another\n").ok());
    EXPECT_TRUE(files.has_conflict("note.txt"));
    EXPECT_EQ(files.open("note.txt").value().text, "typed\n");
    EXPECT_EQ(files.disk_text("note.txt").value(), "another\n");
    EXPECT_FALSE(files.save("note.txt").ok());
}

TEST_F(ProjectFilesTest, LongAndBinaryFilesAreNotEdited) {
    write("long.txt", std::string(kTextBytesMax + 1, 'x'));
    write("binary.txt", "\xff\xfe");
    Files files(root);
    EXPECT_EQ(files.open("long.txt").error().code, Code::Limit);
    EXPECT_THAT(files.open("binary.txt").error().what, HasSubstr("UTF-8"));
    write("full.txt", std::string(kTextBytesMax, 'x'));
    EXPECT_EQ(files.edit("full.txt", files.open("full.txt").value().version, {{0, 0, "y"}}, "me")
                  .error()
                  .code,
              Code::Limit);
}

// ---- what somebody else writes meanwhile ----

// What was seen: a file that was overwritten although somebody had changed it a moment before.
TEST_F(ProjectFilesTest, SavingLooksAtTheDiskAtThatMoment) {
    Files files(root);
    edit(files, "note.txt", {{0, 5, "mine"}});
    write("note.txt", "theirs\n");  // no tick has seen it
    EXPECT_THAT(files.save("note.txt").error().what, HasSubstr("note.txt: the file changed"));
    std::vector<std::string> saved;
    EXPECT_THAT(files.save_all(saved).error().what, HasSubstr("note.txt: the file changed"));
    EXPECT_TRUE(saved.empty());
    EXPECT_EQ(on_disk("note.txt"), "theirs\n");
    EXPECT_TRUE(files.keep_mine("note.txt").ok());
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "mine\n");
}

TEST_F(ProjectFilesTest, ContentCountsWhereTimeAndSizeSayNothing) {
    Files files(root);
    edit(files, "note.txt", {{0, 5, "mine"}});
    const auto written = fs::last_write_time(root / "note.txt");
    write("note.txt", "HELLO\n");
    fs::last_write_time(root / "note.txt", written);
    EXPECT_FALSE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "HELLO\n");
}

TEST_F(ProjectFilesTest, AConflictInOneFileDoesNotKeepOthersFromBeingSaved) {
    write("other.txt", "other\n");
    Files files(root);
    edit(files, "note.txt", {{0, 5, "mine"}});
    edit(files, "other.txt", {{0, 5, "more"}});
    write("note.txt", "theirs\n");
    std::vector<std::string> saved;
    EXPECT_FALSE(files.save_all(saved).ok());
    EXPECT_THAT(saved, ElementsAre("other.txt"));
}

TEST_F(ProjectFilesTest, OtherLinesThatChangeOnDiskAreTakenIntoAnUnsavedText) {
    write("three.txt", "one\ntwo\nthree\n");
    Files files(root);
    edit(files, "three.txt", {{0, 3, "ONE"}});
    write("three.txt", "one\ntwo\nthree and more\n");
    fs::last_write_time(root / "three.txt", fs::file_time_type::clock::now() + 5s);
    files.tick(kDiskEvery);
    const DocumentView view = files.open("three.txt").value();
    EXPECT_EQ(view.text, "ONE\ntwo\nthree and more\n");
    EXPECT_EQ(view.by, "disk");
    EXPECT_TRUE(view.unsaved);
    EXPECT_FALSE(view.conflict);
    const Missing missing = files.since("three.txt", 2).value();
    ASSERT_EQ(missing.updates.size(), 1u);
    EXPECT_EQ(missing.updates[0], (Update{3, {{13, 13, " and more"}}, "disk"}));
    EXPECT_TRUE(files.save("three.txt").ok());
    EXPECT_EQ(on_disk("three.txt"), "ONE\ntwo\nthree and more\n");
}

// What was seen: for a script in an .aesl the page never shows that the file changed.
TEST_F(ProjectFilesTest, AConflictIsOneOfEachScriptOfTheFile) {
    Files files(root);
    edit(files, "carbot/a.aesl#1", {{4, 5, "z"}});
    std::string other(kNetwork);
    other.replace(other.find("var x"), 5, "var q");
    write("carbot/a.aesl", other);
    EXPECT_FALSE(files.save("carbot/a.aesl#1").ok());
    for (const char* doc : {"carbot/a.aesl", "carbot/a.aesl#1", "carbot/a.aesl#2"}) {
        EXPECT_TRUE(files.state(doc).value().conflict) << doc;
    }
    EXPECT_EQ(files.disk_text("carbot/a.aesl#1").value(), "var q <\n");
    EXPECT_EQ(files.disk_text("carbot/a.aesl").value(), other);
}

TEST_F(ProjectFilesTest, WhatIsNoTextAnyMoreIsNotOverwritten) {
    Files files(root);
    edit(files, "note.txt", {{0, 0, "x"}});
    write("note.txt", "\xff\xfe");
    EXPECT_FALSE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "\xff\xfe");
    EXPECT_THAT(files.disk_text("note.txt").error().what, HasSubstr("no text in UTF-8"));
    EXPECT_THAT(files.state("note.txt").value().no_text, HasSubstr("no text in UTF-8"));
    EXPECT_FALSE(files.revert("note.txt", "me").ok());
    EXPECT_TRUE(files.keep_mine("note.txt").ok());
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "xhello\n");
}

TEST_F(ProjectFilesTest, AFileThatGoesBackToWhatItWasIsNoConflictAnyMore) {
    Files files(root);
    edit(files, "note.txt", {{0, 5, "mine"}});
    write("note.txt", "theirs\n");
    EXPECT_FALSE(files.save("note.txt").ok());
    write("note.txt", "hello\n");
    EXPECT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "mine\n");
}

// ---- line ends ----

TEST_F(ProjectFilesTest, LineEndsAndTheMarkStayWhereNobodyTypes) {
    write("dos.txt", "\xef\xbb\xbfone\r\ntwo\r\nthree\nfour");
    Files files(root);
    const DocumentView view = files.open("dos.txt").value();
    EXPECT_EQ(view.text, "one\ntwo\nthree\nfour");
    EXPECT_EQ(view.ends, "mixed");
    edit(files, "dos.txt", {{4, 4, "new\r\n"}});  // each line end counts one
    EXPECT_EQ(files.open("dos.txt").value().text, "one\nnew\ntwo\nthree\nfour");
    EXPECT_TRUE(files.save("dos.txt").ok());
    EXPECT_EQ(on_disk("dos.txt"), "\xef\xbb\xbfone\r\nnew\r\ntwo\r\nthree\nfour");
}

// ---- the journal ----

TEST_F(ProjectFilesTest, AfterACrashOtherLinesThatChangedOnDiskAreTakenIn) {
    write("three.txt", "one\r\ntwo\r\nthree\r\n");
    {
        Files files(root);
        edit(files, "three.txt", {{0, 3, "ONE"}});
    }
    write("three.txt", "one\r\ntwo\r\nTHREE\r\n");
    Files files(root);
    EXPECT_EQ(files.open("three.txt").value().text, "ONE\ntwo\nTHREE\n");
    EXPECT_FALSE(files.has_conflict("three.txt"));
    EXPECT_TRUE(files.save("three.txt").ok());
    EXPECT_EQ(on_disk("three.txt"), "ONE\r\ntwo\r\nTHREE\r\n");
}

// A power cut may bring the old file back until the disk has the new one: so long the journal has
// the text, too. Nobody waits for that.
TEST_F(ProjectFilesTest, WhatIsSavedStaysInTheJournalUntilTheDiskHasIt) {
    std::counting_semaphore<> news{0};
    Files files(root);
    files.on_wake([&] { news.release(); });
    const std::string before = on_disk("note.txt");
    edit(files, "note.txt", {{0, 0, "typed "}});
    ASSERT_TRUE(files.save("note.txt").ok());
    EXPECT_EQ(on_disk("note.txt"), "typed " + before);
    EXPECT_FALSE(files.is_unsaved("note.txt"));
    {
        write("note.txt", before);  // the power was cut
        EXPECT_EQ(Files(root).open("note.txt").value().text, "typed " + before);
        write("note.txt", "typed " + before);
    }
    std::optional<Status> on_disk_now;
    files.when_on_disk([&](const Status& status) { on_disk_now = status; });
    for (Time now = 1s; !on_disk_now && news.try_acquire_for(20s); now += 1s) files.tick(now);
    ASSERT_TRUE(on_disk_now && on_disk_now->ok());
    EXPECT_TRUE(fs::is_empty(root / ".vagus/journal"));
    std::optional<Status> at_once;
    files.when_on_disk([&](const Status& status) { at_once = status; });
    EXPECT_TRUE(at_once && at_once->ok());
}

// Typed again, and taken back, while the disk is waited for.
TEST_F(ProjectFilesTest, WhatIsTypedAndTakenBackBehindASaveLeavesNoOtherTextInTheJournal) {
    Files files(root);
    edit(files, "note.txt", {{0, 5, "saved"}});
    ASSERT_TRUE(files.save("note.txt").ok());
    edit(files, "note.txt", {{5, 5, " more"}});
    edit(files, "note.txt", {{5, 10, ""}});
    const std::string text = files.open("note.txt").value().text;
    Files again(root);
    EXPECT_EQ(again.open("note.txt").value().text, text);
    EXPECT_FALSE(again.is_unsaved("note.txt"));
}

// As on a full disk: told once, tried again, nothing lost meanwhile.
TEST_F(ProjectFilesTest, AJournalThatCannotBeWrittenIsToldAndTriedAgain) {
    Files files(root);
    fs::create_directories(root / ".vagus");
    write(".vagus/journal", "in the way");
    edit(files, "note.txt", {{0, 5, "typed"}});
    EXPECT_THAT(files.take_trouble().value_or(""), HasSubstr("unsaved changes cannot be"));
    edit(files, "note.txt", {{5, 5, " on"}});
    files.tick(kJournalAgain);
    EXPECT_EQ(files.take_trouble(), std::nullopt);
    fs::remove(root / ".vagus/journal");
    files.tick(kJournalAgain * 2);
    EXPECT_EQ(Files(root).open("note.txt").value().text, "typed on\n");
}

// No file can grow meanwhile, as on a full disk.
struct FullDisk {
    FullDisk() : handler(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before);
        const rlimit none{0, before.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &none);
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, handler);
    }
    rlimit before{};
    void (*handler)(int);
};

// What was seen: renamed while the disk was full, then killed; what was typed was lost.
TEST_F(ProjectFilesTest, ARenamedTextKeepsItsOldEntryUntilItHasANewOne) {
    Files files(root);
    edit(files, "note.txt", {{0, 5, "typed"}});
    {
        const FullDisk full;
        EXPECT_TRUE(files.rename("note.txt", "other.txt").ok());
        EXPECT_EQ(Files(root).open("note.txt").value().text, "typed\n");  // were it killed now
    }
    files.tick(kJournalAgain);
    EXPECT_FALSE(Files(root).open("note.txt").ok());
    EXPECT_EQ(Files(root).open("other.txt").value().text, "typed\n");
}

}  // namespace
}  // namespace vagus::serve
