#include "base/line_sink.hpp"
#include "base/test_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include "base/file.hpp"

namespace vagus {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using When = LineSink::When;

class LineSinkTest : public testing::Test {
protected:
    LineSinkTest() { prepare_standard_files(); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string written() const { return read_file(path("f")).value(); }

    test::Folder folder_;
};

// As `ulimit -f`, for as long as it lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit less = {bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &less);
    }
    ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

private:
    rlimit before_ = {};
};

TEST_F(LineSinkTest, LinesAreInTheFileAtOnce) {
    LineSink sink = std::move(LineSink::open(path("f"), When::AtOnce).value());
    sink.write("a\n");
    EXPECT_EQ(written(), "a\n");
    sink.write("b\nc\n");
    EXPECT_EQ(written(), "a\nb\nc\n");
    EXPECT_TRUE(sink.flush().ok());
}

TEST_F(LineSinkTest, WaitingLinesAreWrittenWithinASecondOfTheTimeTold) {
    LineSink sink = std::move(LineSink::open(path("f"), When::WithinASecond).value());
    sink.write("a\n");
    sink.pass(10s);
    EXPECT_EQ(written(), "");
    sink.pass(10s + kLinesWaitFor - 1us);
    EXPECT_EQ(written(), "");
    sink.pass(10s + kLinesWaitFor);
    EXPECT_EQ(written(), "a\n");
    // The wait of the next line begins with that line.
    sink.pass(20s);
    sink.write("b\n");
    sink.pass(20s + 1us);
    sink.pass(20s + kLinesWaitFor);
    EXPECT_EQ(written(), "a\n");
    sink.pass(20s + kLinesWaitFor + 1us);
    EXPECT_EQ(written(), "a\nb\n");
}

TEST_F(LineSinkTest, NoMoreThanTheLimitWaits) {
    LineSink sink = std::move(LineSink::open(path("f"), When::WithinASecond).value());
    const std::string almost = std::string(kLinesWaitMax - 2, 'x') + "\n";
    sink.write(almost);
    EXPECT_EQ(written(), "");
    sink.write("\n");
    EXPECT_EQ(written(), almost + "\n");
}

TEST_F(LineSinkTest, WhatWaitsIsWrittenAtTheEnd) {
    {
        LineSink first = std::move(LineSink::open(path("f"), When::WithinASecond).value());
        first.write("a\n");
        const LineSink second = std::move(first);
    }
    EXPECT_EQ(written(), "a\n");
}

TEST_F(LineSinkTest, NowhereTakesEverything) {
    LineSink sink = std::move(LineSink::open("", When::AtOnce).value());
    EXPECT_FALSE(sink);
    sink.write("a\n");
    EXPECT_TRUE(sink.flush().ok());
}

TEST_F(LineSinkTest, AFileThatCannotBeOpenedIsNamedWithTheReason) {
    const auto error = [](const std::string& name) {
        return LineSink::open(name, When::AtOnce).error().what;
    };
    EXPECT_EQ(error(path("none/f")),
              path("none/f") + ": cannot be written: No such file or directory");
    EXPECT_EQ(error(folder_.string()), folder_.string() + ": cannot be written: Is a directory");
}

TEST_F(LineSinkTest, AFileThatBeginsOtherwiseIsNotReplaced) {
    const auto open = [this] { return LineSink::open(path("f"), When::AtOnce, "{\"t\":"); };
    std::ofstream(path("f")) << "{ \"format\": \"vagus-plan/1\" }\n";
    EXPECT_EQ(open().error().what,
              path("f") +
                  ": is there already, and is something else: what is written there begins with "
                  "{\"t\":; name another file");
    EXPECT_EQ(written(), "{ \"format\": \"vagus-plan/1\" }\n");
    for (const char* const older : {"", "{\"t\":0.1}\n", "{\"t"}) {
        std::ofstream(path("f")) << older;
        EXPECT_TRUE(open().ok()) << older;
        EXPECT_EQ(written(), "");
    }
}

// Two runs that were traced into one file wrote over each other's lines.
TEST_F(LineSinkTest, AFileHasOneWriter) {
    {
        LineSink first = std::move(LineSink::open(path("f"), When::AtOnce).value());
        first.write("one\n");
        EXPECT_EQ(LineSink::open(path("f"), When::AtOnce).error().what,
                  path("f") +
                      ": another program is writing it; name another file, or wait until that one "
                      "has ended");
        EXPECT_EQ(written(), "one\n");
    }
    EXPECT_TRUE(LineSink::open(path("f"), When::AtOnce).ok());
    EXPECT_EQ(written(), "");
    LineSink nowhere = std::move(LineSink::open("/dev/null", When::AtOnce).value());
    EXPECT_TRUE(LineSink::open("/dev/null", When::AtOnce).ok());
}

TEST_F(LineSinkTest, AFullDiskIsSaidOnceAndKept) {
    LineSink sink = std::move(LineSink::open("/dev/full", When::AtOnce).value());
    EXPECT_TRUE(sink.state().ok());
    sink.write("a\n");
    sink.write("b\n");
    ASSERT_FALSE(sink.flush().ok());
    EXPECT_EQ(sink.state().error().what, "/dev/full: cannot be written: No space left on device");
}

// Two lines of eleven bytes fit into 25; the three bytes of the third must not stay.
TEST_F(LineSinkTest, WhatStandsInAFullFileIsWholeLines) {
    LineSink sink = std::move(LineSink::open(path("f"), When::WithinASecond).value());
    const FileSizeLimit limit(25);
    sink.write("0123456789\nabcdefghij\nABCDEFGHIJ\n");
    ASSERT_FALSE(sink.flush().ok());
    EXPECT_EQ(sink.state().error().what, path("f") + ": cannot be written: File too large");
    EXPECT_EQ(written(), "0123456789\nabcdefghij\n");
}

TEST_F(LineSinkTest, APipeWhoseReaderLeftIsAFailure) {
    ASSERT_EQ(::mkfifo(path("p").c_str(), 0600), 0);
    const int reader = ::open(path("p").c_str(), O_RDONLY | O_NONBLOCK);
    LineSink sink = std::move(LineSink::open(path("p"), When::AtOnce).value());
    ::close(reader);
    sink.write("a\n");
    EXPECT_EQ(sink.state().error().what, path("p") + ": cannot be written: Broken pipe");
}

TEST_F(LineSinkTest, OneThatNeverWaitsSaysHowMuchAReaderMissed) {
    ASSERT_EQ(::mkfifo(path("p").c_str(), 0600), 0);
    const int reader = ::open(path("p").c_str(), O_RDONLY | O_NONBLOCK);
    LineSink sink = std::move(LineSink::open(path("p"), When::AtOnce).value());
    sink.never_wait();
    // More than a pipe holds, and what may wait for it twice.
    const std::string line = std::string(1023, 'x') + "\n";
    for (int i = 0; i < 2048; ++i) sink.write(line);
    EXPECT_TRUE(sink.state().ok());
    const Status written = sink.flush();
    ::close(reader);
    ASSERT_FALSE(written.ok());
    EXPECT_TRUE(written.error().what.starts_with(path("p") + ": nobody read it in time; "))
        << written.error().what;
}

TEST_F(LineSinkTest, AFileKeepsEveryLineAlsoWhereNothingWaits) {
    LineSink sink = std::move(LineSink::open(path("f"), When::AtOnce).value());
    sink.never_wait();
    sink.write("a\n");
    EXPECT_EQ(written(), "a\n");
    EXPECT_TRUE(sink.flush().ok());
}

}  // namespace
}  // namespace vagus
