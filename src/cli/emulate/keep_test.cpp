#include "cli/emulate/keep.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "base/file.hpp"
#include "base/test_folder.hpp"

namespace vagus::cli {
namespace {

TEST(WordFinder, FindsAWordInOnePiece) {
    WordFinder finder("OK");
    EXPECT_EQ(finder.before_the_end("so OK now"), 4u);  // "so O"
    EXPECT_EQ(finder.before_the_end(" now"), 4u);
}

TEST(WordFinder, FindsAWordThatComesByteByByte) {
    WordFinder finder("Flashing OK");
    for (const char* byte : {"F", "l", "a", "s", "h", "i", "n", "g", " ", "O"}) {
        EXPECT_EQ(finder.before_the_end(byte), 1u) << byte;
    }
    EXPECT_EQ(finder.before_the_end("K"), 0u);
}

TEST(WordFinder, FindsAWordBehindItsOwnBeginning) {
    WordFinder finder("aab");
    EXPECT_EQ(finder.before_the_end("a"), 1u);
    EXPECT_EQ(finder.before_the_end("aab"), 2u);
}

TEST(WordFinder, FindsAWordTwice) {
    WordFinder finder("OK");
    EXPECT_EQ(finder.before_the_end("OKOK"), 1u);
    EXPECT_EQ(finder.before_the_end("OK"), 1u);
}

TEST(KeptBytes, AFileOfAnotherSizeIsRefusedWithItsPlace) {
    const test::Folder folder;
    const KeptMemory memory{.at = 0, .bytes = 4, .file = folder / "board.flash"};
    EXPECT_EQ(kept_bytes(memory).value(), "");
    ASSERT_TRUE(write_file(memory.file, "12345").ok());
    EXPECT_EQ(kept_bytes(memory).error().what,
              memory.file +
                  ": expected the 4 bytes that the board keeps, found 5; delete the file to begin "
                  "with a board that has saved nothing");
}

// Confirms each packet that ends, and answers the next one: "$OK#9a" is the packet OK.
void answer(int line, const std::string& answers) {
    char byte = 0;
    while (::read(line, &byte, 1) == 1) {
        if (byte != '#') continue;
        ASSERT_EQ(::write(line, answers.data(), answers.size()),
                  static_cast<ssize_t>(answers.size()));
    }
}

TEST(BoardMonitor, ReadsMemoryAsHex) {
    int line[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, line), 0);
    std::thread qemu([far = line[1]] { answer(far, "+$00ff41#5b"); });
    {
        BoardMonitor monitor(line[0]);
        EXPECT_EQ(monitor.read(0x100, 3).value(), std::string("\0\xff\x41", 3));
        // Two bytes were asked for: three are no answer to that.
        EXPECT_FALSE(monitor.read(0x100, 2).ok());
    }
    qemu.join();
    ::close(line[1]);
}

TEST(BoardMonitor, SaysThatQemuHasEnded) {
    int line[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, line), 0);
    BoardMonitor monitor(line[0]);
    ::shutdown(line[1], SHUT_WR);
    EXPECT_EQ(monitor.pause().error().what,
              "QEMU cannot be asked for the memory of the board: it has ended");
    ::close(line[1]);
}

}  // namespace
}  // namespace vagus::cli
