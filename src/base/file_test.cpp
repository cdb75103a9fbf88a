#include "base/file.hpp"
#include "base/lost_pages.hpp"
#include "base/test_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

namespace vagus {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, gone at its end.
class FileTest : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    test::Folder folder_;
};

TEST_F(FileTest, ReadsWhatWasWritten) {
    const std::string content("a\0b\r\n", 5);
    ASSERT_TRUE(write_file(path("x"), content).ok());
    EXPECT_EQ(read_file(path("x")).value(), content);
}

TEST_F(FileTest, AFileThatGrowsIsReadAsItIsMapped) {
    {
        auto file = GrowingFile::create(path("x"));
        ASSERT_TRUE(file.ok());
        EXPECT_TRUE(file.value().append("one ").ok());
        EXPECT_TRUE(file.value().append("two").ok());
    }
    EXPECT_EQ(MappedFile::open(path("x")).value().bytes(), "one two");
    ASSERT_TRUE(GrowingFile::create(path("x")).ok());
    EXPECT_EQ(MappedFile::open(path("x")).value().bytes(), "");
    EXPECT_EQ(MappedFile::open(path("no")).error().code, Code::NotFound);
    EXPECT_EQ(MappedFile::open(folder_.string()).error().what,
              folder_.string() + ": cannot be read: expected a file");
    EXPECT_FALSE(GrowingFile::create(path("no/x")).ok());
}

// The second would mix its bytes into those of the first, and neither could be read again.
TEST_F(FileTest, AFileThatGrowsHasOneWriter) {
    {
        auto first = GrowingFile::create(path("x"));
        ASSERT_TRUE(first.ok());
        EXPECT_TRUE(first.value().append("one").ok());
        const auto second = GrowingFile::create(path("x"));
        ASSERT_FALSE(second.ok());
        EXPECT_EQ(second.error().what,
                  path("x") +
                      ": another program is writing it; name another file, or wait until "
                      "that one has ended");
        EXPECT_EQ(read_file(path("x")).value(), "one");
    }
    EXPECT_TRUE(GrowingFile::create(path("x")).ok());
}

// A recording into a pipe was cut off where the pipe was full, or held up its run.
TEST_F(FileTest, AFileThatGrowsIsAFile) {
    EXPECT_EQ(GrowingFile::create("-").error().what,
              "-: expected the name of a file, found that of standard output; name a file of its "
              "own (./- for one of this name)");
    ASSERT_EQ(::mkfifo(path("p").c_str(), 0600), 0);
    const int reader = ::open(path("p").c_str(), O_RDONLY | O_NONBLOCK);
    EXPECT_EQ(GrowingFile::create(path("p")).error().what,
              path("p") + ": expected the name of a file, found a pipe; name a file of its own");
    ::close(reader);
    EXPECT_TRUE(GrowingFile::create("/dev/null").ok());
}

TEST_F(FileTest, WhatIsCutOffAMappedFileReadsAsZeros) {
    constexpr size_t kBytes = 3u << 20;  // more than the system reads ahead
    ASSERT_TRUE(write_file(path("x"), std::string(kBytes, 'x')).ok());
    const auto file = MappedFile::open(path("x"));
    ASSERT_TRUE(file.ok());
    fs::resize_file(path("x"), 10);
    const std::string_view bytes = file.value().bytes();
    EXPECT_EQ(bytes.size(), kBytes);
    EXPECT_EQ(bytes.substr(0, 10), "xxxxxxxxxx");
    EXPECT_EQ(bytes[kBytes - 1], '\0');
    EXPECT_EQ(bytes[kBytes / 2], '\0');
}

TEST_F(FileTest, MoreMappedFilesThanAreGuardedAreRead) {
    ASSERT_TRUE(write_file(path("x"), "some").ok());
    std::vector<Result<MappedFile>> files;
    for (size_t i = 0; i <= kGuardedMax; ++i) {
        files.push_back(MappedFile::open(path("x")));
        EXPECT_EQ(files.back().value().bytes(), "some");
    }
}

TEST_F(FileTest, WhatIsReadIsKept) {
    ASSERT_TRUE(write_file(path("x"), "1").ok());
    ASSERT_TRUE(write_file(path("y"), "2").ok());
    (void)read_file(path("y"));
    const FilesRead files;
    (void)read_file(path("x"));
    ASSERT_TRUE(write_file(path("x"), "3").ok());
    (void)read_file(path("x"));
    (void)read_file(path("no"));
    EXPECT_EQ(files.all(), (std::map<std::string, std::string>{{path("x"), "1"}}));
}

TEST_F(FileTest, FilesInsteadAreReadAsTheyWere) {
    ASSERT_TRUE(write_file(path("x"), "now").ok());
    {
        FilesInstead then;
        then.put(path("x"), "then");
        then.put(path("gone"), "was there");
        const FilesRead files;
        EXPECT_EQ(read_file(path("a/../x")).value(), "then");
        EXPECT_EQ(read_file(path("gone")).value(), "was there");
        EXPECT_EQ(files.all().at(path("gone")), "was there");
        EXPECT_FALSE(read_file(path("y")).ok());
    }
    EXPECT_EQ(read_file(path("x")).value(), "now");
    EXPECT_FALSE(read_file(path("gone")).ok());
}

TEST_F(FileTest, APipeThatIsNamedIsRefusedWithoutWaiting) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    const Result<std::string> read = read_file(path("pipe"));
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().what, path("pipe") +
                                     ": cannot be read: it is a pipe; name a file, or - "
                                     "for standard input");
}

TEST_F(FileTest, APipeThatWasHandedOverIsRead) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ASSERT_EQ(::write(ends[1], "text", 4), 4);
    ::close(ends[1]);
    EXPECT_EQ(read_file("/dev/fd/" + std::to_string(ends[0])).value(), "text");
    ::close(ends[0]);
}

TEST_F(FileTest, ReplacesTheFileAndLeavesNothingBeside) {
    ASSERT_TRUE(write_file(path("x"), "long old content").ok());
    ASSERT_TRUE(write_file(path("x"), "new").ok());
    EXPECT_EQ(read_file(path("x")).value(), "new");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(FileTest, LeavesNothingBesideTheFile) {
    ASSERT_TRUE(write_file(path("x"), "old").ok());
    ASSERT_TRUE(write_file(path("x"), "new").ok());
    EXPECT_EQ(read_file(path("x")).value(), "new");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(FileTest, KeepsTheRightsOfTheFile) {
    ASSERT_TRUE(write_file(path("x"), "#!/bin/sh").ok());
    fs::permissions(path("x"), fs::perms(0750));
    ASSERT_TRUE(write_file(path("x"), "#!/bin/bash").ok());
    EXPECT_EQ(fs::status(path("x")).permissions(), fs::perms(0750));
}

TEST_F(FileTest, WritesThroughASymbolicLink) {
    ASSERT_TRUE(write_file(path("real"), "old").ok());
    fs::create_symlink("real", path("link"));
    ASSERT_TRUE(write_file(path("link"), "new").ok());
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(read_file(path("real")).value(), "new");
}

// `-o /dev/null` by an administrator once left a file where the device had been.
TEST_F(FileTest, WritesIntoAPipeAndDoesNotReplaceIt) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const int reader = ::open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_TRUE(write_file(path("pipe"), "words").ok());
    char read[8] = {};
    EXPECT_EQ(::read(reader, read, sizeof read), 5);
    EXPECT_STREQ(read, "words");
    ::close(reader);
    EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(FileTest, AppendsBehindTheEndOfAFileThatIsMadeIfNeedBe) {
    ASSERT_TRUE(append_file(path("log"), "one\n").ok());
    ASSERT_TRUE(append_file(path("log"), "two\n").ok());
    ASSERT_TRUE(sync_file(path("log")).ok());
    EXPECT_EQ(read_file(path("log")).value(), "one\ntwo\n");
    EXPECT_FALSE(append_file(path("no/such/folder"), "x").ok());
    EXPECT_TRUE(sync_file(path("gone by now")).ok());
}

// A full disk, as far as a limit of the process is one: half a record would hide the next.
TEST_F(FileTest, WhatIsAppendedHalfIsTakenBack) {
    ASSERT_TRUE(append_file(path("log"), "one\n").ok());
    struct rlimit before = {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto ignored = ::signal(SIGXFSZ, SIG_IGN);
    const struct rlimit small = {6, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Status appended = append_file(path("log"), "two\n");
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    ::signal(SIGXFSZ, ignored);
    EXPECT_FALSE(appended.ok());
    EXPECT_EQ(read_file(path("log")).value(), "one\n");
}

TEST_F(FileTest, NamesTheFileAndTheReason) {
    const auto missing = read_file(path("nothing.aesl"));
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().code, Code::NotFound);
    EXPECT_EQ(missing.error().what,
              path("nothing.aesl") + ": cannot be read: No such file or directory");
    EXPECT_FALSE(read_file(folder_.string()).ok()) << "a folder is no file";
    EXPECT_FALSE(write_file(path("no/such/folder"), "x").ok());
}

TEST_F(FileTest, RefusesOneByteAboveTheLimit) {
    // A file with a hole: long, yet it takes no room.
    ASSERT_TRUE(write_file(path("big"), "x").ok());
    fs::resize_file(path("big"), kFileBytesMax + 1);
    const auto read = read_file(path("big"));
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().code, Code::Limit);
}

}  // namespace
}  // namespace vagus
