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
    EXPECT_EQ(count_sent(kDrive, Type::Run), 0u);  // not for a moment
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

// One that can tell, and says all else: nobody may wait for that for ever.
struct DoubtTest : TargetTest {
    // It was away, is back, and does not tell what it runs.
    void leave_in_doubt() {
        run();
        bus.mute(kBumper);
        pass(4s);
        bus.mute(kBumper, false);
        bus.tells_nothing(kBumper);
        pass(1500ms);
        ASSERT_EQ(node_document(kBumper)["program"], "unknown");
        bus.sent.clear();
    }
};

TEST_F(DoubtTest, ANodeThatNeverTellsGetsItsScriptAgain) {
    leave_in_doubt();
    pass(5s);
    EXPECT_GE(count_sent(kBumper, Type::SetBytecode), 1u);
    EXPECT_EQ(node_document(kBumper)["program"], "current");
    EXPECT_EQ(count_sent(kBumper, Type::Run), 0u);
}

TEST_F(DoubtTest, ANodeThatAnotherHostLoadsBeforeItTellsGetsItsScriptAgain) {
    leave_in_doubt();
    wire::SetBytecode words{};
    words.dest = kBumper;
    words.words.count = 1;
    words.words.values[0] = 0;
    wire::Frame frame;
    ASSERT_EQ(wire::encode_message(words, wire::kHostId, frame), wire::Error::None);
    bus.others_say(frame);
    pass(500ms);
    EXPECT_GE(count_sent(kBumper, Type::SetBytecode), 1u);
    EXPECT_EQ(node_document(kBumper)["program"], "current");
}

TEST_F(DoubtTest, RunLoadsWhatNobodyKnows) {
    leave_in_doubt();
    target.load_changed(true, [](auto failed) { EXPECT_TRUE(failed.empty()); });
    pass(debug::kAnswerWithin + 500ms);  // for the checksum, then it is taken as it is
    EXPECT_GE(count_sent(kBumper, Type::SetBytecode), 1u);
    EXPECT_EQ(node_document(kBumper)["program"], "current");
    EXPECT_TRUE(runs(kBumper));
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
