#include "serve/studio/calm_log.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vagus::serve {
namespace {

struct CalmFixture {
    std::vector<std::string> lines;
    CalmLog log{[this](const std::string& line) { lines.push_back(line); }};
};

TEST(CalmLog, EqualLinesAreOneAndTheirNumber) {
    CalmFixture f;
    for (int i = 0; i < 1000; ++i) f.log.add("a wrong token", 1s);
    EXPECT_EQ(f.lines, std::vector<std::string>{"a wrong token"});
    f.log.tick(11s);
    ASSERT_EQ(f.lines.size(), 2u);
    EXPECT_EQ(f.lines[1], "a wrong token (999 more times)");
    f.log.add("another", 12s);
    EXPECT_EQ(f.lines.size(), 3u);
}

TEST(CalmLog, LinesOfASecondAreBounded) {
    CalmFixture f;
    for (size_t i = 0; i <= kLogLinesASecond; ++i) f.log.add(std::to_string(i), 1s);
    EXPECT_EQ(f.lines.size(), kLogLinesASecond);
    f.log.tick(2s);
    EXPECT_EQ(f.lines.back(), "1 lines were left out");
    f.log.add("next", 2s);
    EXPECT_EQ(f.lines.back(), "next");
}

TEST(CalmLog, LinesByTurnsAreBoundedToo) {
    CalmFixture f;
    for (int i = 0; i < 1000; ++i) f.log.add(i % 4 < 2 ? "one" : "other", 1s);
    EXPECT_EQ(f.lines.size(), kLogLinesASecond);
}

}  // namespace
}  // namespace vagus::serve
