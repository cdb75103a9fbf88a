#include "serve/project/journal.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "base/file.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;

class JournalTest : public testing::Test {
protected:
    JournalTest() : journal(folder, sync, 1) {}

    std::map<std::string, Unsaved> read() { return Journal(folder, sync, 1).read(); }
    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& one : fs::directory_iterator(folder)) found.push_back(one.path());
        std::sort(found.begin(), found.end());
        return found;
    }

    // The thread of `sync` deletes files, too: it ends before the folder goes.
    test::Folder own_folder;
    const fs::path folder = own_folder / "journal";
    DiskSync sync;
    Journal journal;
};

TEST_F(JournalTest, EveryChangeIsThereAtOnce) {
    for (const std::string text : {"a", "abc\n", "xbc\n", ""}) {
        ASSERT_TRUE(journal.write("n.txt", {"base\n", text}).ok());
        const auto found = read();
        ASSERT_TRUE(found.contains("n.txt"));
        EXPECT_EQ(found.at("n.txt").text, text);
        EXPECT_EQ(found.at("n.txt").base, "base\n");
    }
    EXPECT_EQ(files().size(), 1u);
    journal.forget("n.txt");
    EXPECT_TRUE(read().empty());
}

TEST_F(JournalTest, ATextWithoutAFileHasNoBase) {
    ASSERT_TRUE(journal.write("n.txt", {std::nullopt, "new"}).ok());
    EXPECT_EQ(read().at("n.txt").base, std::nullopt);
}

// The computer lost its power: wherever the file ends, what comes before is a text that there was.
TEST_F(JournalTest, AFileThatIsCutOffHasTheTextBefore) {
    const std::vector<std::string> texts = {"one", "one two", "one 2"};
    for (const std::string& text : texts) {
        ASSERT_TRUE(journal.write("n.txt", {"", text}).ok());
    }
    const std::string whole = read_file(files()[0].string()).value();
    size_t known = 0;
    for (size_t size = 0; size <= whole.size(); ++size) {
        std::ofstream(files()[0], std::ios::binary) << whole.substr(0, size);
        const auto found = read();
        if (found.empty()) {
            EXPECT_EQ(known, 0u);
            continue;
        }
        const auto at = std::find(texts.begin(), texts.end(), found.at("n.txt").text);
        ASSERT_NE(at, texts.end()) << size;
        EXPECT_GE(static_cast<size_t>(at - texts.begin()), known);
        known = static_cast<size_t>(at - texts.begin());
    }
    EXPECT_EQ(known, texts.size() - 1);
}

TEST_F(JournalTest, WhatFollowsAFileThatWasCutOffIsNotLost) {
    ASSERT_TRUE(journal.write("n.txt", {"", "one"}).ok());
    std::ofstream(files()[0], std::ios::binary | std::ios::app) << "change 0 0 5 00";
    Journal again(folder, sync, 1);
    EXPECT_EQ(again.read().at("n.txt").text, "one");
    ASSERT_TRUE(again.write("n.txt", {"", "one two"}).ok());
    EXPECT_EQ(read().at("n.txt").text, "one two");
}

TEST_F(JournalTest, ALongFileIsBegunAgainAndTheNewerOneCounts) {
    std::mt19937 random(5);
    std::string text;
    for (int i = 0; i < 400; ++i) {
        text = std::string(1000, static_cast<char>('a' + random() % 26)) + std::to_string(i);
        ASSERT_TRUE(journal.write("n.txt", {"", text}).ok());
        ASSERT_LE(fs::file_size(files().back()), kJournalSlackBytes + 5 * text.size());
    }
    EXPECT_EQ(read().at("n.txt").text, text);
}

TEST_F(JournalTest, TwoStudiosInOneFolderDoNotMixTheirChanges) {
    Journal other(folder, sync, 1);
    ASSERT_TRUE(journal.write("n.txt", {"", "mine"}).ok());
    ASSERT_TRUE(other.write("n.txt", {"", "theirs"}).ok());
    ASSERT_TRUE(journal.write("n.txt", {"", "mine again"}).ok());
    ASSERT_TRUE(other.write("n.txt", {"", "theirs again"}).ok());
    const auto found = read();
    EXPECT_EQ(found.at("n.txt").text, "theirs again");
    std::ofstream(files()[0], std::ios::binary | std::ios::app) << "of a third";
    ASSERT_TRUE(journal.write("n.txt", {"", "mine at last"}).ok());
    EXPECT_EQ(read().at("n.txt").text, "mine at last");
}

TEST_F(JournalTest, AnEntryOfAnEarlierStudioIsRead) {
    fs::create_directories(folder);
    std::ofstream(folder / "00000000000000ab", std::ios::binary)
        << "vagus-journal/1 " << std::hex << hash_of("old\n") << std::dec << " 5 a b.txt\ntyped";
    Journal again(folder, sync, 1);
    const Unsaved found = again.read().at("a b.txt");
    EXPECT_EQ(found.text, "typed");
    EXPECT_EQ(found.base_hash, hash_of("old\n"));
    ASSERT_TRUE(again.write("a b.txt", {"old\n", "typed on"}).ok());
    EXPECT_EQ(read().at("a b.txt").text, "typed on");
    again.forget("a b.txt");
    EXPECT_TRUE(read().empty());
}

}  // namespace
}  // namespace vagus::serve
