#include "base/shell_word.hpp"

#include <gtest/gtest.h>

namespace vagus {
namespace {

TEST(ShellWord, APathIsQuotedWhereAShellWouldTakeItApart) {
    EXPECT_EQ(shell_word("test-results/Wall.seed-1.mcap"), "test-results/Wall.seed-1.mcap");
    EXPECT_EQ(shell_word("my tests/a.mcap"), "'my tests/a.mcap'");
    EXPECT_EQ(shell_word("b $HOME"), "'b $HOME'");
    EXPECT_EQ(shell_word("Anna's"), "'Anna'\\''s'");
    EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace vagus
