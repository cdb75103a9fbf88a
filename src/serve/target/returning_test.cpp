// Nodes that were away: what they run is asked, not guessed.
#include <gmock/gmock.h>

#include "serve/target/test_target.hpp"

namespace vagus::serve {
namespace {

using Type = wire::MessageType;

// A cable was pulled and put back; meanwhile the node was started again, and is where the
// program before it was.
TEST_F(TargetTest, ANodeThatWasStartedAgainGetsItsScriptAndStaysPaused) {
    run();
    bus.state = Connection::Lost;
    pass(100ms);
    EXPECT_EQ(node_document(kDrive)["state"], "gone");
    EXPECT_EQ(node_document(kDrive)["program"], "unknown");
    bus.switch_on(kDrive);
    const std::vector<uint16_t> other = {5, 0xffff, 4, 0, 0, 0, 0};
    ASSERT_TRUE(bus.node(kDrive).load(other).ok());
    bus.sent.clear();
    bus.state = Connection::Connected;
    pass(2s);
    EXPECT_EQ(node_document(kDrive)["program"], "current");
    EXPECT_FALSE(runs(kDrive));
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
    EXPECT_GE(count_sent(kDrive, Type::SetBytecode), 1u);
    EXPECT_EQ(count_sent(kDrive, Type::Stop) > 0, true);
    target.run_all([](auto) {});
    pass(300ms);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 100);
}

// One that cannot tell what it runs, although it is what it was.
TEST_F(TargetTest, InDoubtANodeGetsItsScriptAgain) {
    run();
    bus.mute(kDrive);
    pass(4s);
    bus.mute(kDrive, false);
    bus.sent.clear();
    pass(2s);
    EXPECT_GE(count_sent(kDrive, Type::SetBytecode), 1u);
    EXPECT_EQ(node_document(kDrive)["program"], "current");
    EXPECT_FALSE(runs(kDrive));
}

// In a simulation its process was slow, and nothing else has happened.
TEST_F(TargetTest, ANodeOfASimulationKeepsItsScript) {
    run("simulator");
    bus.mute(kDrive);
    pass(4s);
    bus.mute(kDrive, false);
    bus.sent.clear();
    pass(2s);
    EXPECT_EQ(count_sent(kDrive, Type::SetBytecode), 0u);
    EXPECT_TRUE(runs(kDrive));
}

}  // namespace
}  // namespace vagus::serve
