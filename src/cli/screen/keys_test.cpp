#include "cli/screen/keys.hpp"

#include <gmock/gmock.h>

namespace vagus::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Keys, EachKeyOfTheHelpIsUnderstood) {
    std::string rest;
    EXPECT_THAT(keys_of(" qr+-\tbt", rest),
                ElementsAre(Key::Pause, Key::Quit, Key::Reset, Key::Faster, Key::Slower,
                            Key::NextRobot, Key::Button, Key::Tap));
    EXPECT_EQ(rest, "");
}

// The letters inside of an arrow key's sequence are no keys.
TEST(Keys, SequencesOfOtherKeysAreDropped) {
    std::string rest;
    EXPECT_THAT(keys_of("\x1b[A\x1bOP\x1b[15~\x1b"
                        "b"
                        "t",
                        rest),
                ElementsAre(Key::Tap));
    EXPECT_THAT(keys_of("\x1b[Z", rest), ElementsAre(Key::LastRobot));
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
