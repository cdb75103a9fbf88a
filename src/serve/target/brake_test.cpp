// A live robot brakes as a whole; direct driving is a lease.
#include <gmock/gmock.h>

#include "serve/studio/answer_text.hpp"
#include "serve/target/test_target.hpp"

namespace vagus::serve {
namespace {

using Type = wire::MessageType;

struct BrakeTest : TargetTest {
    static constexpr const char* kBumperScript = "robot.aesl#2";

    void break_at_bumper(const std::string& condition, int ignore = 0) {
        answer = ask(
            "break.set",
            {{"doc", kBumperScript}, {"line", 3}, {"condition", condition}, {"ignore", ignore}});
        pass(300ms);
    }
    void expect_braked() {
        EXPECT_FALSE(runs(kDrive));
        EXPECT_EQ(node_document(kDrive)["why"], "robot");
        EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
        // Behind the pause, for the script would write over it.
        const auto types = sent_to(kDrive);
        const auto pause = std::find(types.begin(), types.end(), Type::Pause);
        EXPECT_NE(std::find(pause, types.end(), Type::SetVariables), types.end());
    }
    void expect_at_rest() {
        EXPECT_FALSE(runs(kDrive));
        EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
    }
    void bumper_faults() {
        wire::DivisionByZero fault{};
        fault.pc = 5;
        wire::Frame frame;
        ASSERT_EQ(wire::encode_message(fault, kBumper, frame), wire::Error::None);
        bus.others_say(frame);
        pass(100ms);
    }
    void begin(const char* command, const Json& in) {
        const double until = static_cast<double>(now.count()) / 1000 + 3000;
        const Json message = {{"id", 1000}, {"do", command}, {"in", in}, {"until", until}};
        desk.hear(ClientText{{1}, message.dump()}, now);
    }
    void rest() {
        report.reset();
        target.make_safe([this](const StopReport& it) { report = it; });
    }
    Json answer;
};

TEST_F(BrakeTest, ABreakpointOfASensorStopsTheWheelsAndRunLetsExactlyThemGo) {
    run();
    break_at_bumper("");
    EXPECT_EQ(node_document(kBumper)["why"], "breakpoint");
    expect_braked();
    EXPECT_FALSE(answer.contains("note"));
    ask("break.clear", Json::object());
    ask("node.run", {{"node", kBumper}});
    pass(200ms);
    EXPECT_TRUE(runs(kBumper));
    EXPECT_TRUE(runs(kDrive));
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 100);  // of its script, which runs again
}

TEST_F(BrakeTest, ANodeThatAPersonPausedIsNotLetGoWithTheOthers) {
    run();
    ask("node.pause", {{"node", kDrive}});
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
    break_at_bumper("");
    ask("break.clear", Json::object());
    ask("node.run", {{"node", kBumper}});
    pass(200ms);
    EXPECT_TRUE(runs(kBumper));
    EXPECT_FALSE(runs(kDrive));
}

// Whether it counts is known only here, and until then there is no reflex.
TEST_F(BrakeTest, AHitThatDoesNotCountBrakesTooAndIsSaid) {
    run();
    break_at_bumper("n < 0");
    EXPECT_THAT(answer.value("note", ""), testing::HasSubstr("brakes at every hit"));
    EXPECT_GE(count_sent(kDrive, Type::Pause), 1u);
    EXPECT_GE(count_sent(kDrive, Type::SetVariables), 1u);
    ask("break.clear", Json::object());
    pass(300ms);
    EXPECT_TRUE(runs(kBumper));
    EXPECT_TRUE(runs(kDrive));
}

TEST_F(BrakeTest, SoDoesOneOfThoseThatAreLetPass) {
    run();
    break_at_bumper("", 1000);
    EXPECT_TRUE(answer.contains("note"));
    EXPECT_GE(count_sent(kDrive, Type::Pause), 1u);
}

TEST_F(BrakeTest, PauseStopAndResetOfANodeStopTheWheels) {
    for (const char* command : {"node.pause", "node.stop", "node.reset"}) {
        if (target.connected()) target.disconnect();
        run();
        ask(command, {{"node", kBumper}});
        pass(100ms);
        SCOPED_TRACE(command);
        expect_braked();
    }
}

// A fleet's operator gives an order and is gone.
TEST_F(BrakeTest, WhatDrivesIsNotWrittenForSomebodyWithoutAPage) {
    run();
    std::string why = "no answer";
    const auto write = [&](int16_t value) {
        target.write("drive", "wheel.target", {value},
                     [&](const std::string& told) { why = told; });
        pass(100ms);
        return why;
    };
    bus.sent.clear();
    EXPECT_THAT(write(50), testing::HasSubstr("wheel.target drives the robot"));
    EXPECT_EQ(count_sent(kDrive, Type::SetVariables), 0u);
    EXPECT_EQ(write(0), "");
}

TEST_F(BrakeTest, AFaultOfANodeStopsTheWheels) {
    run();
    bumper_faults();
    expect_braked();
    EXPECT_TRUE(target.is_at_fault());
    stop();
    pass(200ms);
    EXPECT_FALSE(target.is_at_fault());  // the next run has none yet
    EXPECT_THAT(target.problems(), testing::SizeIs(1));
}

TEST_F(BrakeTest, OneThatIsLoadedWhileAnotherFaultsIsNotLetRun) {
    run();
    bus.mute(kDrive);
    begin("node.load", {{"node", kDrive}});
    pass(100ms);
    bumper_faults();
    bus.mute(kDrive, false);
    pass(2s);
    EXPECT_EQ(count_sent(kDrive, Type::SetBytecode), 1u);
    EXPECT_EQ(count_sent(kDrive, Type::Run), 0u);
    expect_at_rest();
    ask("node.run", {{"node", kBumper}});
    pass(200ms);
    EXPECT_TRUE(runs(kDrive));
}

TEST_F(BrakeTest, WhatMovesIsLetRunWhenTheLastOneIsLoaded) {
    connect();
    bus.mute(kBumper);
    target.load_changed(true, [](auto) {});
    pass(500ms);
    EXPECT_GE(count_sent(kDrive, Type::SetBytecode), 1u);
    expect_at_rest();
    bus.mute(kBumper, false);
    pass(2s);
    EXPECT_TRUE(runs(kBumper));
    EXPECT_TRUE(runs(kDrive));
}

// It ran for so long that its load was answered.
TEST_F(BrakeTest, OneThatFaultsInItsFirstLinesKeepsTheWheelsAtRest) {
    connect();
    bus.mute(kDrive);
    target.load_changed(true, [](auto) {});
    pass(500ms);
    EXPECT_TRUE(runs(kBumper));
    bumper_faults();
    bus.mute(kDrive, false);
    pass(2s);
    EXPECT_GE(count_sent(kDrive, Type::SetBytecode), 1u);
    expect_at_rest();
}

TEST_F(BrakeTest, TheLossOfANodeStopsTheWheelsUntilRun) {
    run();
    bus.mute(kBumper);
    pass(5s);
    expect_braked();
    bus.mute(kBumper, false);
    pass(3s);
    EXPECT_FALSE(runs(kDrive));
    target.run_all([](auto) {});
    pass(300ms);
    EXPECT_TRUE(runs(kDrive));
    EXPECT_TRUE(runs(kBumper));
}

// As `vagus net pause` does it from elsewhere.
TEST_F(BrakeTest, APauseThatAnotherProgramSendsStopsTheWheels) {
    run();
    wire::Pause pause{};
    pause.dest = kBumper;
    wire::Frame frame;
    ASSERT_EQ(wire::encode_message(pause, wire::kHostId, frame), wire::Error::None);
    bus.others_say(frame);
    pass(100ms);
    expect_braked();
}

TEST_F(BrakeTest, WhatAStepWritesDoesNotDrive) {
    run();
    break_at_bumper("");
    for (int i = 0; i < 5; ++i) {
        ask("node.step", {{"node", kDrive}});
        pass(50ms);
        EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0) << i;
    }
}

TEST_F(BrakeTest, WhatAStepWritesBehindStopDoesNotDriveEither) {
    run();
    stop();
    pass(200ms);
    for (int i = 0; i < 5; ++i) {
        ask("node.step", {{"node", kDrive}});
        pass(50ms);
        EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0) << i;
    }
}

// A robot that drives by itself, or was driven from elsewhere, when the page opens.
TEST_F(BrakeTest, StopOfANodeAsTheFirstCommandStopsTheWheels) {
    for (const uint16_t node : {kDrive, kBumper}) {
        if (target.connected()) target.disconnect();
        connect();
        bus.word(kDrive, "wheel.target") = 100;
        ask("node.stop", {{"node", node}});
        pass(100ms);
        EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0) << node;
    }
}

TEST_F(BrakeTest, WhoOnlyLooksDoesNotInterfere) {
    connect();
    bus.sent.clear();
    bus.mute(kBumper);
    pass(5s);
    EXPECT_EQ(count_sent(kDrive, Type::Pause), 0u);
    EXPECT_EQ(count_sent(kDrive, Type::SetVariables), 0u);
}

TEST_F(BrakeTest, AWorldWhoseClockStopsTooIsLeftAsItIs) {
    run("simulator");
    ask("node.pause", {{"node", kBumper}});
    pass(100ms);
    EXPECT_TRUE(runs(kDrive));
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 100);
}

// ---- a plan waits for nodes that somebody debugs ----

using Nodes = std::vector<uint16_t>;

TEST_F(BrakeTest, NodesAreHeldWhileSomebodyDebugsOne) {
    run();
    EXPECT_EQ(target.held_nodes(), Nodes{});
    break_at_bumper("");
    EXPECT_EQ(target.held_nodes(), (Nodes{kDrive, kBumper}));
    ask("node.step", {{"node", kBumper}});
    pass(100ms);
    EXPECT_EQ(target.held_nodes(), (Nodes{kDrive, kBumper}));
    ask("break.clear", Json::object());
    ask("node.run", {{"node", kBumper}});
    pass(200ms);
    EXPECT_EQ(target.held_nodes(), Nodes{});
}

TEST_F(BrakeTest, PauseAndResetHoldNodesAndStopDoesNot) {
    for (const char* command : {"node.pause", "node.reset", "node.stop"}) {
        if (target.connected()) target.disconnect();
        run();
        ask(command, {{"node", kBumper}});
        pass(100ms);
        const bool stops = command == std::string("node.stop");
        EXPECT_EQ(target.held_nodes(), stops ? Nodes{} : (Nodes{kDrive, kBumper})) << command;
        target.stop_all([](const auto&) {});
        pass(100ms);
        EXPECT_EQ(target.held_nodes(), Nodes{}) << command;
    }
}

TEST_F(BrakeTest, WhatAnotherProgramResetsIsNotHeld) {
    run();
    wire::Reset reset{};
    reset.dest = kBumper;
    wire::Frame frame;
    ASSERT_EQ(wire::encode_message(reset, wire::kHostId, frame), wire::Error::None);
    bus.others_say(frame);
    pass(100ms);
    EXPECT_FALSE(runs(kBumper));
    expect_braked();
    EXPECT_EQ(target.held_nodes(), Nodes{});
}

// ---- scripts that run on behind a plan ----

// A handler that was under way when the plan ended writes over what made the node safe.
TEST_F(BrakeTest, WhatAHandlerUnderWayWritesBehindThePlanIsTakenBack) {
    connect();
    target.make_safe();
    pass(30ms);
    bus.word(kDrive, "wheel.target") = 70;
    pass(400ms);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
}

TEST_F(BrakeTest, AScriptThatDrivesByItselfLaterDoesSo) {
    connect();
    target.make_safe();
    pass(kRestWithin + 20ms);
    bus.word(kDrive, "wheel.target") = 70;
    pass(3s);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 70);
}

TEST_F(BrakeTest, WhatBeginsNextIsNotTakenBack) {
    connect();
    target.make_safe();
    pass(30ms);
    target.will_move();
    bus.word(kDrive, "wheel.target") = 70;
    pass(1s);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 70);
}

TEST_F(BrakeTest, BehindAPlanItIsToldWhichNodesAreAtRest) {
    connect();
    bus.word(kDrive, "wheel.target") = 70;
    rest();
    pass(kRestWithin);
    EXPECT_EQ(state_of(kDrive), StopNode::State::Stopped);
    EXPECT_EQ(report->nodes.size(), 1u);  // bumper only senses
    EXPECT_FALSE(node_document(kDrive).contains("stop"));
}

TEST_F(BrakeTest, OneThatIsSilentBehindAPlanIsAskedOnUntilItAnswers) {
    connect();
    bus.word(kDrive, "wheel.target") = 70;
    bus.mute(kDrive);
    rest();
    pass(kRestWithin);
    EXPECT_EQ(state_of(kDrive), StopNode::State::Silent);
    EXPECT_EQ(node_document(kDrive)["stop"], "silent");
    const size_t before = count_sent(kDrive, Type::SetVariables);
    pass(2s);
    EXPECT_GT(count_sent(kDrive, Type::SetVariables), before);
    bus.mute(kDrive, false);
    pass(3s);
    ASSERT_EQ(target.stop_report().nodes.size(), 1u);
    EXPECT_EQ(target.stop_report().nodes.front().state, StopNode::State::Stopped);
}

TEST_F(BrakeTest, OneWhoseScriptDrivesBehindAPlanIsToldAndLetDrive) {
    run();
    rest();
    pass(kRestWithin + 20ms);
    EXPECT_EQ(state_of(kDrive), StopNode::State::Moving);
    const size_t before = count_sent(kDrive, Type::SetVariables);
    pass(3s);
    EXPECT_EQ(count_sent(kDrive, Type::SetVariables), before);
}

// ---- direct driving ----

TEST_F(BrakeTest, WhoDrivesByHandAndLosesTheConnectionDrivesNoMore) {
    connect();
    ask("variable.set",
        {{"node", kDrive}, {"name", "wheel.target"}, {"first", 0}, {"values", {70}}});
    pass(5s);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 70);
    close_page();
    pass(50ms);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
}

TEST_F(BrakeTest, ByWhateverNameTheVariableWasSet) {
    connect();
    ask("variable.set",
        {{"node", kDrive}, {"name", "wheel.target[0]"}, {"first", 0}, {"values", {70}}});
    pass(50ms);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 70);
    close_page();
    pass(50ms);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
}

// Its process was stopped, or its Wi-Fi is cut: the connection stays for minutes.
TEST_F(BrakeTest, SoDoesOneThatIsConnectedAndDoesNotAnswer) {
    connect();
    ask("variable.set",
        {{"node", kDrive}, {"name", "wheel.target"}, {"first", 0}, {"values", {70}}});
    desk.tick(now);
    for (int missed = 1; missed <= 3; ++missed) {
        pass(limit_ms("ping_ms"));
        desk.tick(now);
        EXPECT_EQ(bus.word(kDrive, "wheel.target"), 70) << missed;
    }
    pass(limit_ms("ping_ms"));
    desk.tick(now);
    pass(50ms);
    EXPECT_EQ(bus.word(kDrive, "wheel.target"), 0);
}

TEST_F(BrakeTest, OtherVariablesDriveNothing) {
    connect();
    ask("variable.set", {{"node", kDrive}, {"name", "args"}, {"first", 0}, {"values", {7}}});
    bus.sent.clear();
    close_page();
    pass(50ms);
    EXPECT_EQ(count_sent(kDrive, Type::SetVariables), 0u);
}

}  // namespace
}  // namespace vagus::serve
