#include "base/nearest.hpp"

#include <gtest/gtest.h>

namespace vagus {
namespace {

const std::vector<std::string> kVerbs = {"compile", "exec", "switch", "node", "net", "sim"};

TEST(Nearest, OneChangeIsForgivenInShortWords) {
    EXPECT_EQ(nearest("exce", kVerbs), "exec");  // two neighbours swapped
    EXPECT_EQ(nearest("noe", kVerbs),
              "node");  // one letter missing; "net" would need one too, later in the list
    EXPECT_EQ(nearest("siim", kVerbs), "sim");  // one letter too many
}

TEST(Nearest, ABeginningCountsAsOneChange) {
    EXPECT_EQ(nearest("comp", kVerbs), "compile");
}

TEST(Nearest, NoGuessIsBetterThanAWrongOne) {
    EXPECT_EQ(nearest("frobnicate", kVerbs), "");
    EXPECT_EQ(nearest("", kVerbs), "");
}

TEST(Nearest, ASentenceSaysWhatThereIs) {
    const std::vector<std::string> known = {"say", "wait"};
    EXPECT_EQ(known_instead("sey", known), "did you mean say?");
    EXPECT_EQ(known_instead("count", known), "there are: say, wait");
    EXPECT_EQ(known_instead("count", {}), "there is none");
    EXPECT_EQ(known_instead("count", std::vector<std::string>(15, "on")),
              "there are: on, on, on, on, on, on, on, on, on, on, on, on and 3 more");
}

TEST(Nearest, WordsBeyondTheLimitAreNotCompared) {
    EXPECT_EQ(nearest(std::string(64, 'a'), std::vector{std::string(64, 'a')}),
              std::string(64, 'a'));
    EXPECT_EQ(nearest(std::string(65, 'a'), std::vector{std::string(65, 'a')}), "");
}

}  // namespace
}  // namespace vagus
