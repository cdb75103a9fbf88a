// A node whose handler does not end, on a robot that somebody far away looks at.
#include <gmock/gmock.h>

#include "serve/target/test_target.hpp"

namespace vagus::serve {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Type = wire::MessageType;

constexpr size_t kOwnVariable = 36;  // the first of the script of bumper
constexpr Duration kFound = (kEndlessLooks + 5) * kHandlerLookEvery;

struct EndlessTest : TargetTest {
    // Both nodes get these lines for their tick, and run.
    void run_with(const std::string& bumper) {
        std::ofstream(root_ / "robot.aesl")
            << "<!DOCTYPE aesl-source>\n<network>\n<event size=\"0\" name=\"go\"/>\n"
               "<node nodeId=\"1\" name=\"drive\">onevent tick\n  wheel.target = 100\n</node>\n"
               "<node nodeId=\"2\" name=\"bumper\">var n\n"
            << bumper << "</node>\n</network>\n";
        scripts.reread();
        connect();
        target.load_changed(true, [](auto failed) { EXPECT_TRUE(failed.empty()); });
        pass(500ms);
        target.look_for_endless_loops(true);
    }
};

// The loop is in what runs at the start, and no event has a handler: the node tells nothing.
TEST_F(EndlessTest, ALoopThatNoEventEndsIsAFaultAtItsLine) {
    run_with("while n == 0 do\n  n = 0\nend\n");
    EXPECT_THAT(target.problems(), IsEmpty());
    pass(kFound);
    EXPECT_THAT(target.problems(),
                ElementsAre(testing::MatchesRegex(
                    "bumper at line [234]: what it does at an event does not end; .*")));
    stop();
    pass(200ms);
    EXPECT_EQ(state_of(kBumper), StopNode::State::Stopped);
}

TEST_F(EndlessTest, AHandlerThatEndsIsNone) {
    run_with("onevent tick\n  n = 0\n  while n < 60 do\n    n = n + 1\n  end\n");
    pass(2 * kFound);
    EXPECT_THAT(target.problems(), IsEmpty());
}

TEST_F(EndlessTest, ALoopThatEndsAfterAllIsNoFaultAnyMore) {
    run_with("var m\nwhile n == 0 do\n  m = 0\nend\n");
    pass(kFound);
    ASSERT_EQ(target.problems().size(), 1u);
    bus.node(kBumper).variables()[kOwnVariable] = 1;
    pass(2 * kHandlerLookEvery);
    EXPECT_THAT(target.problems(), IsEmpty());
}

// Nobody asks for it: there is no more traffic than before.
TEST_F(EndlessTest, ARobotAloneIsNotAsked) {
    run_with("var m\nwhile n == 0 do\n  m = 0\nend\n");
    target.look_for_endless_loops(false);
    bus.sent.clear();
    pass(kFound);
    EXPECT_EQ(count_sent(kBumper, Type::GetExecutionState), 0u);
    EXPECT_THAT(target.problems(), IsEmpty());
}

}  // namespace
}  // namespace vagus::serve
