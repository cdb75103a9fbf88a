#include "cli/screen/keys.hpp"

#include <gmock/gmock.h>

namespace vagus::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Keys, EachKeyOfTheHelpIsUnderstood) {
    std::string rest;
    EXPECT_THAT(keys_of(" qr+-\tbt", rest),
                ElementsAre(Key::Pause, Key::Quit, Key::Restart, Key::Faster, Key::Slower,
                            Key::NextRobot, Key::Centre, Key::Tap));
    EXPECT_EQ(rest, "");
}

TEST(Keys, ArrowsComeInTwoForms) {
    std::string rest;
    EXPECT_THAT(keys_of("\x1b[A\x1b[B\x1bOC\x1bOD\x1b[Z", rest),
                ElementsAre(Key::Forward, Key::Backward, Key::Right, Key::Left, Key::LastRobot));
}

// F5 and Alt-b end in characters that would be keys by themselves.
TEST(Keys, SequencesOfOtherKeysAreDropped) {
    std::string rest;
    EXPECT_THAT(keys_of("\x1b[15~\x1b"
                        "b"
                        "\x1b[1;5t"
                        "t",
                        rest),
                ElementsAre(Key::Tap));
}

// A terminal may say what its background is when nobody waits for it any more. Alt-] is no answer.
TEST(Keys, LateAnswersOfTheTerminalAreDropped) {
    std::string rest;
    EXPECT_THAT(keys_of("\x1b]11;rgb:ffff/ffff/ffff\x1b\\\x1b[?62;22ct", rest),
                ElementsAre(Key::Tap));
    EXPECT_THAT(keys_of("\x1b]11;rgb:ffff/ffff/ffff\x07t", rest), ElementsAre(Key::Tap));
    EXPECT_THAT(keys_of("\x1b]t", rest), ElementsAre(Key::Tap));
}

TEST(Keys, PagesScrollAndOtherCharactersAreKeysToo) {
    std::string rest;
    EXPECT_THAT(keys_of("\x1b[5~\x1b[6~x\r", rest),
                ElementsAre(Key::Earlier, Key::Later, Key::Other, Key::Other));
}

TEST(Keys, ASequenceMayComeInTwoReads) {
    std::string rest;
    EXPECT_THAT(keys_of("t\x1b[", rest), ElementsAre(Key::Tap));
    EXPECT_THAT(keys_of("Zt", rest), ElementsAre(Key::LastRobot, Key::Tap));
}

TEST(Keys, ASequenceWithoutEndIsForgotten) {
    std::string rest;
    EXPECT_THAT(keys_of("\x1b[" + std::string(kSequenceMax - 2, '1'), rest), IsEmpty());
    EXPECT_EQ(rest.size(), kSequenceMax);
    EXPECT_THAT(keys_of("1", rest), IsEmpty());
    EXPECT_EQ(rest, "");
    EXPECT_THAT(keys_of("t", rest), ElementsAre(Key::Tap));
}

}  // namespace
}  // namespace vagus::cli
