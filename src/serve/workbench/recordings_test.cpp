#include "serve/workbench/recordings.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/test_folder.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;

void make(const fs::path& path, uintmax_t bytes = 1) {
    std::ofstream(path) << "x";
    fs::resize_file(path, bytes);
}

size_t count(const fs::path& folder) {
    return static_cast<size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Recordings, TheNewestAreKept) {
    const test::Folder folder;
    Recordings recordings;
    recordings.enter(folder / "made");
    for (size_t i = 1; i <= kRecordingsKept + 3; ++i) {
        const auto path = recordings.next(true);
        ASSERT_TRUE(path.ok());
        EXPECT_EQ(fs::path(path.value()).filename(), "run-" + std::to_string(i) + ".mcap");
        make(path.value());
        EXPECT_LE(count(folder / "made"), kRecordingsKept + 1);
    }
    EXPECT_FALSE(fs::exists(folder / "made" / "run-2.mcap"));
    EXPECT_TRUE(fs::exists(folder / "made" / "run-3.mcap"));
}

// Files with holes: they have their size, and take no room.
TEST(Recordings, TheyHaveRoomTogetherButTheRunBeforeStays) {
    const test::Folder folder;
    make(folder / "run-4.mcap", kRecordingsBytesMax / 2);
    make(folder / "run-5.mcap", kRecordingsBytesMax / 2);
    Recordings recordings;
    recordings.enter(folder / ".");
    ASSERT_TRUE(recordings.next(true).ok());
    EXPECT_TRUE(fs::exists(folder / "run-4.mcap"));  // just as much as there may be
    make(folder / "run-6.mcap", kRecordingsBytesMax + 1);
    ASSERT_TRUE(recordings.next(true).ok());
    EXPECT_FALSE(fs::exists(folder / "run-4.mcap"));
    EXPECT_FALSE(fs::exists(folder / "run-5.mcap"));
    EXPECT_TRUE(fs::exists(folder / "run-6.mcap"));
}

TEST(Recordings, UntilTimePassesTheRunBeforeIsTheOneThatIsAsked) {
    const test::Folder folder;
    Recordings recordings;
    EXPECT_EQ(recordings.of_run(true), "");
    EXPECT_FALSE(recordings.next(true).ok());
    recordings.enter(folder / ".");
    const std::string first = recordings.next(true).value();
    make(first);
    EXPECT_EQ(recordings.of_run(true), first);
    const std::string second = recordings.next(true).value();
    EXPECT_EQ(recordings.of_run(false), first);
    EXPECT_EQ(recordings.of_run(true), second);
    // The second was a world in which no time passed: its file is about to go.
    make(second);
    const std::string third = recordings.next(false).value();
    EXPECT_EQ(recordings.of_run(false), first);
    EXPECT_EQ(recordings.of_run(true), third);
}

TEST(Recordings, FilesOfOthersStay) {
    const test::Folder folder;
    for (const char* name : {"run-x.mcap", "run-1.mcap.txt", "mine.mcap", "run-.mcap"}) {
        make(folder / name, kRecordingsBytesMax);
    }
    Recordings recordings;
    recordings.enter(folder / ".");
    EXPECT_EQ(fs::path(recordings.next(true).value()).filename(), "run-1.mcap");
    EXPECT_EQ(count(folder / "."), 4u);
}

TEST(Recordings, AnOldOneThatIsRunAgainStaysAndOthersGo) {
    const test::Folder folder;
    for (size_t i = 1; i <= kRecordingsKept + 1; ++i) {
        make(folder / ("run-" + std::to_string(i) + ".mcap"));
    }
    Recordings recordings;
    recordings.enter(folder / ".");
    ASSERT_TRUE(recordings.next(false, (folder / "." / "run-1.mcap").string()).ok());
    EXPECT_TRUE(fs::exists(folder / "run-1.mcap"));
    EXPECT_FALSE(fs::exists(folder / "run-2.mcap"));
    EXPECT_TRUE(fs::exists(folder / "run-3.mcap"));
}

TEST(Recordings, ThoseOfRunsBeforeAreListedTheNewestFirst) {
    const test::Folder folder;
    make(folder / "run-2.mcap", 20);
    make(folder / "run-10.mcap", 100);
    make(folder / "run-x.mcap");
    Recordings recordings;
    EXPECT_TRUE(recordings.kept().empty());
    recordings.enter(folder / ".");
    make(recordings.next(false).value());
    const auto kept = recordings.kept();
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_EQ(kept[0].number, 10u);
    EXPECT_EQ(kept[0].bytes, 100u);
    EXPECT_GT(kept[0].when_wall, 1.5e12);  // after 2017
    EXPECT_EQ(kept[1].number, 2u);
    // The run that was there has ended: its recording is one of them.
    recordings.over(true);
    EXPECT_EQ(recordings.of_run(true), "");
    EXPECT_EQ(recordings.of_run(false), recordings.kept().front().path);
    EXPECT_EQ(recordings.kept().front().number, 11u);
    recordings.enter(folder / "gone");
    EXPECT_TRUE(recordings.kept().empty());
}

}  // namespace
}  // namespace vagus::serve
