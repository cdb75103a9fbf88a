// Programs on a node: loading, running, stepping, breakpoints, faults.
// Dumps of the wire spec, 2.10.
#include "debug/scripted_bus.hpp"

namespace vagus::debug {
namespace {

// Dump 6: line 1 is `x = 1` (pc 3, 4), line 2 is `y = 2` (pc 5, 6, and the final STOP at 7).
aesl::Program two_lines() {
    aesl::Program program;
    program.bytecode = {0x0003, 0xffff, 0x0003, 0x1001, 0x4064, 0x1002, 0x4065, 0x0000};
    program.lines = {0, 0, 0, 1, 1, 2, 2, 2};
    program.variables = {
        {"id", 0, 1}, {"source", 1, 1}, {"args", 2, 32}, {"x", 100, 1}, {"y", 101, 1}};
    return program;
}

constexpr const char* kUpload =
    "14 00 00 00 01 a0 01 00 00 00 03 00 ff ff 03 00 01 10 64 40 02 10 65 40 00 00";
constexpr const char* kStop = "02 00 00 00 06 a0 01 00";
constexpr const char* kStep = "02 00 00 00 05 a0 01 00";
constexpr const char* kClear5 = "04 00 00 00 09 a0 01 00 05 00";
constexpr const char* kSet5 = "04 00 00 00 08 a0 01 00 05 00";
constexpr const char* kSet5Done = "04 00 01 00 0b 90 05 00 01 00";

std::optional<std::string> error_of(ScriptedBus& bus, RequestId request) {
    for (const RequestDone& done : bus.told<RequestDone>()) {
        if (done.request == request) return done.error ? done.error->what : "";
    }
    return std::nullopt;
}

class Program : public testing::Test {
protected:
    void SetUp() override { bus.meet_robot(1); }
    void load() {
        const RequestId request = bus.network.load(1, two_lines()).value();
        bus.state(1, 3, 3);
        bus.state(1, 3, 1);
        EXPECT_EQ(error_of(bus, request), "");
        bus.forget();
    }
    void break_at_line_2(std::string_view condition = "") {
        const RequestId request = bus.network.set_breakpoint(1, 2, condition).value();
        bus.node_says(kSet5Done);
        EXPECT_EQ(error_of(bus, request), "");
        bus.forget();
    }
    ScriptedBus bus;
};

TEST_F(Program, IsLoadedThenRun) {
    const RequestId request = bus.network.load(1, two_lines()).value();
    EXPECT_EQ(bus.sent(), Dumps{kUpload});
    bus.node_says("04 00 01 00 0a 90 03 00 03 00");
    EXPECT_EQ(bus.sent(), (Dumps{kClearAll, kRun}));
    EXPECT_EQ(error_of(bus, request), std::nullopt);
    bus.node_says("04 00 01 00 0a 90 03 00 01 00");
    EXPECT_EQ(error_of(bus, request), "");
    EXPECT_EQ(bus.network.node(1)->state, ProgramState::Running);
}

// What SetBytecode leaves is paused before the first line: a script that drives in its first lines
// would drive until a Stop behind Run came.
TEST_F(Program, ThatIsToStayIsLoadedAndNotRun) {
    const RequestId request = bus.network.load(1, two_lines(), AfterLoad::Stay).value();
    EXPECT_EQ(bus.sent(), Dumps{kUpload});
    bus.node_says("04 00 01 00 0a 90 03 00 03 00");
    EXPECT_EQ(bus.sent(), Dumps{kClearAll});
    EXPECT_EQ(error_of(bus, request), "");
    EXPECT_EQ(bus.network.node(1)->state, ProgramState::Paused);
    EXPECT_EQ(bus.told<StateChanged>().size(), 1u);
    ASSERT_TRUE(bus.network.run(1).ok());
    EXPECT_TRUE(bus.network.node(1)->program.has_value());
}

// What was seen: the answer to a Stop that was sent just before was taken for that of the load, and
// the next Stop dropped the program on its way.
TEST_F(Program, IsNotLoadedByTheAnswerToAnEarlierStop) {
    const RequestId load = bus.network.load(1, two_lines(), AfterLoad::Stay).value();
    bus.state(1, 0, 2);  // stopped, and nothing waits to run
    EXPECT_FALSE(bus.network.node(1)->program.has_value());
    (void)bus.network.stop_now(1);
    EXPECT_NE(error_of(bus, load).value_or("").find("stopped before"), std::string::npos);
    EXPECT_FALSE(bus.network.node(1)->program.has_value());
}

// A switch drops the words that wait behind a Stop, and without code before the first handler the
// answer to that Stop looks like theirs.
TEST_F(Program, ThatAnotherHostStopsWhileItIsLoadedIsNotLoaded) {
    aesl::Program program = two_lines();
    program.bytecode = {0x0001, 0x0000};  // no handlers
    program.lines = {0, 0};
    const RequestId load = bus.network.load(1, program).value();
    bus.forget();
    bus.node_says(kStop);
    bus.state(1, 0, 2);
    EXPECT_EQ(bus.sent(), Dumps{});
    const auto loads = bus.told<RequestDone>();
    ASSERT_EQ(loads.size(), 1u);
    EXPECT_EQ(loads[0].request, load);
    EXPECT_EQ(loads[0].error->what,
              "node 1 \"robot\" was stopped by another program while its script was loaded: load "
              "it again");
    EXPECT_FALSE(bus.network.node(1)->program.has_value());
}

TEST_F(Program, OneThatIsBeingLoadedCanBeKeptFromRunning) {
    const RequestId load = bus.network.load(1, two_lines()).value();
    EXPECT_TRUE(bus.network.stay_after_load(1));
    bus.forget();
    bus.state(1, 3, 3);
    EXPECT_EQ(bus.sent(), Dumps{kClearAll});
    EXPECT_EQ(error_of(bus, load), "");
    EXPECT_FALSE(bus.network.stay_after_load(1));
    EXPECT_FALSE(bus.network.stay_after_load(2));  // nobody
}

TEST_F(Program, OneThatWasToldToRunCountsAsLoaded) {
    const RequestId load = bus.network.load(1, two_lines()).value();
    bus.state(1, 3, 3);
    EXPECT_FALSE(bus.network.stay_after_load(1));
    EXPECT_EQ(error_of(bus, load), "");
    EXPECT_TRUE(bus.network.node(1)->program.has_value());
}

TEST_F(Program, LargerThanAFragmentGoesInPiecesOf256Words) {
    aesl::Program program;
    program.bytecode.assign(600, 0);
    program.lines.assign(600, 1);
    ASSERT_TRUE(bus.network.load(1, program).ok());
    const Dumps sent = bus.sent();
    ASSERT_EQ(sent.size(), 3u);
    EXPECT_TRUE(sent[0].starts_with("04 02 00 00 01 a0 01 00 00 00 "));  // 4 + 512 bytes
    EXPECT_TRUE(sent[1].starts_with("04 02 00 00 01 a0 01 00 00 01 "));
    EXPECT_TRUE(sent[2].starts_with("b4 00 00 00 01 a0 01 00 00 02 "));  // 4 + 176
    bus.state(1, 0, 2);
    bus.state(1, 0, 2);
    EXPECT_EQ(bus.sent(), Dumps{});
    bus.state(1, 0, 2);
    EXPECT_EQ(bus.sent(), (Dumps{kClearAll, kRun}));
}

TEST_F(Program, AtMostEightFragmentsGoAheadOfTheirAnswers) {
    aesl::Program program;
    program.bytecode.assign(9 * 256, 0);
    program.lines.assign(9 * 256, 1);
    ASSERT_TRUE(bus.network.load(1, program).ok());
    EXPECT_EQ(bus.sent().size(), 8u);
    bus.state(1, 9, 7);  // a breakpoint of what ran before: no answer to a fragment
    EXPECT_EQ(bus.sent().size(), 0u);
    bus.state(1, 0, 2);
    EXPECT_EQ(bus.sent().size(), 1u);
}

TEST_F(Program, ThatDoesNotFitOrIsEmptyIsRefused) {
    aesl::Program program;
    EXPECT_EQ(bus.network.load(1, program).error().code, Code::BadInput);
    program.bytecode.assign(3000, 0);
    EXPECT_TRUE(bus.network.load(1, program).ok());
    program.bytecode.assign(3001, 0);
    EXPECT_EQ(bus.network.load(1, program).error().what,
              "the program has 3001 words, but node 1 \"robot\" has room for 3000: shorten the "
              "script");
}

TEST_F(Program, LoadFailsWithoutAnswerAndWhenTheNodeLeaves) {
    const RequestId silent = bus.network.load(1, two_lines()).value();
    bus.pass(milliseconds(2000));
    bus.node_says("02 00 01 00 0c 90 05 00");
    bus.pass(milliseconds(999));
    EXPECT_EQ(error_of(bus, silent), std::nullopt);
    bus.pass(milliseconds(1));
    EXPECT_EQ(error_of(bus, silent),
              "node 1 \"robot\" did not answer the request to load the program within 3 s");
    const RequestId left = bus.network.load(1, two_lines()).value();
    const RequestId waiting = bus.network.run(1).value();
    bus.node_says("00 00 01 00 04 90");
    EXPECT_EQ(error_of(bus, left), "node 1 \"robot\" has left the network");
    EXPECT_EQ(error_of(bus, waiting), "node 1 \"robot\" has left the network");
}

TEST_F(Program, RequestsWaitInLineAndAreBounded) {
    const RequestId first = bus.network.pause(1).value();
    const RequestId second = bus.network.stop(1).value();
    EXPECT_EQ(bus.sent(), Dumps{"02 00 00 00 04 a0 01 00"});
    bus.state(1, 0, 2);
    EXPECT_EQ(error_of(bus, first), "");
    EXPECT_EQ(error_of(bus, second), std::nullopt);
    EXPECT_EQ(bus.sent(), Dumps{"02 00 00 00 06 a0 01 00"});
    for (size_t i = 1; i < kRequestsMax; i++) EXPECT_TRUE(bus.network.query(1).ok());
    EXPECT_EQ(bus.network.query(1).error().code, Code::Limit);
}

TEST_F(Program, ResetWaitsForTheInitEvent) {
    const RequestId reset = bus.network.reset(1).value();
    EXPECT_EQ(bus.sent(), Dumps{"02 00 00 00 02 a0 01 00"});
    bus.state(1, 3, 3);
    EXPECT_EQ(error_of(bus, reset), "");
    EXPECT_EQ(bus.network.node(1)->state, ProgramState::Paused);
}

// Dump 4. No state message follows: the host must infer (D20).
TEST_F(Program, AFaultStopsItAndHasALine) {
    load();
    bus.node_says("02 00 01 00 07 90 05 00");
    ASSERT_EQ(bus.told<Fault>().size(), 1u);
    EXPECT_EQ(bus.told<Fault>()[0].kind, FaultKind::DivisionByZero);
    EXPECT_EQ(bus.told<Fault>()[0].at, (CodePlace{5, 2}));
    ASSERT_EQ(bus.told<StateChanged>().size(), 1u);
    EXPECT_EQ(bus.told<StateChanged>()[0].state, ProgramState::Stopped);
}

// Dumps 5, 8 and 7.
TEST_F(Program, FaultsAreToldInWords) {
    load();
    bus.node_says("06 00 01 00 06 90 04 00 03 00 05 00");
    bus.node_says("02 00 01 00 06 90 07 00");
    bus.node_says(
        "19 00 01 00 09 90 06 00 16 4e 65 67 61 74 69 76 65 20 69 6e 70 75 74 20 74 6f 20 "
        "73 71 72 74");
    const std::vector<Fault> faults = bus.told<Fault>();
    ASSERT_EQ(faults.size(), 3u);
    EXPECT_EQ(faults[0].text, "array access out of bounds: index 5 in an array of 3");
    EXPECT_EQ(faults[1].text, "array access out of bounds");
    EXPECT_EQ(faults[2].text, "Negative input to sqrt");
    EXPECT_EQ(faults[2].kind, FaultKind::NodeSpecific);
}

TEST_F(Program, AKilledEventDoesNotStopIt) {
    load();
    bus.node_says("02 00 01 00 08 90 05 00");
    ASSERT_EQ(bus.told<Fault>().size(), 1u);
    EXPECT_EQ(bus.told<Fault>()[0].kind, FaultKind::Killed);
    EXPECT_EQ(bus.network.node(1)->state, ProgramState::Running);
}

// Dump 6: to go on, one step, then run.
TEST_F(Program, StopsAtABreakpointAndGoesOn) {
    load();
    const RequestId request = bus.network.set_breakpoint(1, 2, "").value();
    EXPECT_EQ(bus.sent(), (Dumps{kClear5, kSet5}));
    EXPECT_EQ(error_of(bus, request), std::nullopt);
    bus.node_says(kSet5Done);
    EXPECT_EQ(error_of(bus, request), "");
    bus.node_says("04 00 01 00 0a 90 05 00 07 00");
    ASSERT_EQ(bus.told<BreakpointHit>().size(), 1u);
    EXPECT_EQ(bus.told<BreakpointHit>()[0].at, (CodePlace{5, 2}));
    EXPECT_EQ(bus.told<BreakpointHit>()[0].hits, 1u);
    const RequestId run = bus.network.run(1).value();
    EXPECT_EQ(bus.sent(), (Dumps{kStep, kGetState}));
    bus.node_says("04 00 01 00 0a 90 06 00 07 00");
    EXPECT_EQ(bus.sent(), Dumps{kRun});
    bus.node_says("04 00 01 00 0a 90 06 00 07 00");
    EXPECT_EQ(error_of(bus, run), std::nullopt);
    bus.node_says("04 00 01 00 0a 90 06 00 05 00");
    EXPECT_EQ(error_of(bus, run), "");
    EXPECT_EQ(bus.told<BreakpointHit>().size(), 1u);
}

TEST_F(Program, ARunThatFaultsInItsFirstStepDoesNotGoOn) {
    load();
    break_at_line_2();
    bus.state(1, 5, 7);
    const RequestId run = bus.network.run(1).value();
    bus.forget();
    bus.node_says("02 00 01 00 07 90 05 00");
    bus.state(1, 6, 2);
    EXPECT_EQ(bus.sent(), Dumps{});
    EXPECT_EQ(error_of(bus, run), "node 1 \"robot\" stopped again at once: division by zero");
}

TEST_F(Program, AfterAResetABreakpointOnTheFirstLineIsNotPassedOver) {
    load();
    ASSERT_TRUE(bus.network.reset(1).ok());
    bus.state(1, 3, 3);
    bus.forget();
    ASSERT_TRUE(bus.network.run(1).ok());
    EXPECT_EQ(bus.sent(), Dumps{kRun});
}

TEST_F(Program, AFalseConditionLetsItGoOnSilently) {
    load();
    break_at_line_2("x > 3");
    bus.state(1, 5, 7);
    EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 0b a0 01 00 64 00 01 00"});
    bus.node_says("04 00 01 00 05 90 64 00 03 00");
    EXPECT_EQ(bus.sent(), (Dumps{kStep, kGetState}));
    bus.state(1, 6, 7);
    EXPECT_EQ(bus.sent(), Dumps{kRun});
    bus.state(1, 6, 7);
    bus.state(1, 6, 5);
    EXPECT_EQ(bus.sent(), Dumps{});
    // What has to brake at every hit is told of it; nothing else is reported.
    EXPECT_EQ(bus.told<BreakpointReached>().size(), 1u);
    EXPECT_EQ(bus.told<BreakpointPassed>().size(), 1u);
    EXPECT_EQ(bus.events.size(), 2u);
    EXPECT_EQ(bus.network.node(1)->breakpoints[0].hits, 0u);

    bus.state(1, 5, 7);
    bus.node_says("04 00 01 00 05 90 64 00 04 00");
    ASSERT_EQ(bus.told<BreakpointHit>().size(), 1u);
    EXPECT_EQ(bus.told<StateChanged>().back().state, ProgramState::Paused);
}

TEST_F(Program, ConditionsAreCheckedWhenTheyAreSetAndFailAloud) {
    load();
    EXPECT_EQ(bus.network.set_breakpoint(1, 2, "z > 3").error().code, Code::BadInput);
    break_at_line_2("100 / x > 3");
    bus.state(1, 5, 7);
    bus.node_says("04 00 01 00 05 90 64 00 00 00");
    ASSERT_EQ(bus.told<ConditionFailed>().size(), 1u);
    EXPECT_EQ(bus.told<ConditionFailed>()[0].why, "the expression divides by zero");
    EXPECT_EQ(bus.network.node(1)->state, ProgramState::Paused);
}

TEST_F(Program, WhoPausesDuringAConditionKeepsItPaused) {
    load();
    break_at_line_2("x > 3");
    bus.state(1, 5, 7);
    ASSERT_TRUE(bus.network.pause(1).ok());
    bus.forget();
    bus.node_says("04 00 01 00 05 90 64 00 00 00");
    EXPECT_EQ(bus.sent(), Dumps{});
    bus.state(1, 5, 7);
    EXPECT_EQ(bus.told<StateChanged>().size(), 1u);
}

// RUNNING is left only by a breakpoint (3.2).
TEST_F(Program, AStateSaysWhetherABreakpointPausedIt) {
    load();
    bus.forget();
    bus.state(1, 5, 7);
    bus.state(1, 3, 3);
    const auto told = bus.told<StateChanged>();
    ASSERT_EQ(told.size(), 2u);
    EXPECT_EQ(told[0].state, ProgramState::Paused);
    EXPECT_TRUE(told[0].at_breakpoint);
    EXPECT_EQ(told[1].state, ProgramState::Paused);
    EXPECT_FALSE(told[1].at_breakpoint);
}

TEST_F(Program, ALineWithoutCodeTakesNoBreakpoint) {
    EXPECT_EQ(bus.network.set_breakpoint(1, 2, "").error().code, Code::NotFound);  // no program
    aesl::Program program = two_lines();
    program.lines = {0, 0, 0, 2, 2, 5, 5, 5};
    ASSERT_TRUE(bus.network.adopt(1, program).ok());
    EXPECT_EQ(bus.network.set_breakpoint(1, 3, "").error().what,
              "line 3 has no code, so it cannot take a breakpoint; the next line with code is 5");
    EXPECT_EQ(bus.network.set_breakpoint(1, 6, "").error().what,
              "line 6 has no code, so it cannot take a breakpoint");
}

TEST_F(Program, TheBreakpointTableHasSixteenPlaces) {
    aesl::Program program = two_lines();
    for (int line = 1; line <= 17; line++) {
        program.bytecode.push_back(0);
        program.lines.push_back(static_cast<uint16_t>(line + 2));
    }
    ASSERT_TRUE(bus.network.adopt(1, program).ok());
    for (int line = 3; line <= 18; line++) {
        EXPECT_TRUE(bus.network.set_breakpoint(1, line, "").ok());
        bus.node_sends(1, [&program, line] {
            wire::BreakpointSetResult result{};
            result.pc = static_cast<uint16_t>(8 + line - 3);
            result.success = 1;
            return result;
        }());
    }
    EXPECT_EQ(bus.network.set_breakpoint(1, 19, "").error().code, Code::Limit);
    EXPECT_TRUE(bus.network.set_breakpoint(1, 18, "id == 1").ok());  // one that is there: changed
}

TEST_F(Program, ANodeWithAFullTableRefuses) {
    load();
    const RequestId request = bus.network.set_breakpoint(1, 2, "").value();
    bus.node_says("04 00 01 00 0b 90 05 00 00 00");
    EXPECT_EQ(error_of(bus, request),
              "node 1 \"robot\" refused the breakpoint: its table is full; remove those of other "
              "programs first");
    EXPECT_TRUE(bus.network.node(1)->breakpoints.empty());
}

TEST_F(Program, BreakpointsAreSetAnewAfterALoad) {
    load();
    break_at_line_2();
    aesl::Program longer = two_lines();
    longer.bytecode.insert(longer.bytecode.begin() + 5, 0x7000);
    longer.lines.insert(longer.lines.begin() + 5, 1);
    ASSERT_TRUE(bus.network.load(1, longer).ok());
    bus.forget();
    bus.state(1, 3, 3);
    EXPECT_EQ(bus.sent(), (Dumps{kClearAll, "04 00 00 00 09 a0 01 00 06 00",
                                 "04 00 00 00 08 a0 01 00 06 00", kRun}));
}

TEST_F(Program, BreakpointsAreSetAnewAfterAnAbsence) {
    load();
    break_at_line_2();
    bus.pass(kSilenceMax);
    EXPECT_FALSE(bus.network.node(1)->breakpoints[0].on_node);
    bus.node_says("02 00 01 00 0c 90 05 00");
    bus.forget();
    bus.describe_robot(1);
    EXPECT_EQ(bus.sent(), (Dumps{kClearAll, kClear5, kSet5, kGetState}));
}

TEST_F(Program, BreakpointsSurviveAGoodbyeUntilTheProgramIsLoadedAgain) {
    load();
    break_at_line_2("x > 3");
    bus.node_says("00 00 01 00 04 90");
    bus.meet_robot(1);
    ASSERT_EQ(bus.network.node(1)->breakpoints.size(), 1u);
    EXPECT_EQ(bus.network.node(1)->breakpoints[0].condition, "x > 3");
    ASSERT_TRUE(bus.network.load(1, two_lines()).ok());
    bus.state(1, 3, 3);
    EXPECT_EQ(bus.sent(), (Dumps{kUpload, kClearAll, kClear5, kSet5, kRun}));
}

TEST_F(Program, ANodeThatComesBackFreshHasLostItsProgram) {
    load();
    bus.pass(kSilenceMax);
    bus.node_says("02 00 01 00 0c 90 05 00");
    bus.describe_robot(1);
    bus.state(1, 0, 0);
    EXPECT_EQ(bus.told<ProgramReplaced>().size(), 1u);
    EXPECT_FALSE(bus.network.node(1)->program.has_value());
}

TEST_F(Program, ANodeIsAskedAnewWhatIsLeftWhenItsLinkWasLost) {
    load();
    bus.network.link_lost();
    ASSERT_EQ(bus.told<NodeDisconnected>().size(), 1u);
    bus.node_says("02 00 01 00 0c 90 05 00");
    EXPECT_EQ(bus.told<NodeReconnected>().size(), 1u);
    bus.describe_robot(1);
    bus.state(1, 0, 0);
    EXPECT_EQ(bus.told<ProgramReplaced>().size(), 1u);
}

// Nobody else would ever say that it is over.
TEST_F(Program, StopForANodeThatIsAwayIsSentAndAnsweredInTime) {
    load();
    bus.network.link_lost();
    bus.forget();
    const RequestId request = bus.network.stop_now(1).value();
    EXPECT_EQ(bus.sent(), Dumps{kStop});
    EXPECT_LE(bus.network.next_tick(), bus.now + kAnswerWithin);
    EXPECT_EQ(error_of(bus, request), std::nullopt);
    bus.pass(kAnswerWithin);
    EXPECT_EQ(error_of(bus, request),
              "node 1 \"robot\" did not answer the request to stop within 3 s");
}

TEST_F(Program, WhatAnotherHostLoadsIsNoticed) {
    load();
    bus.node_says(kUpload);  // the same words: our own, come back
    EXPECT_TRUE(bus.told<ProgramReplaced>().empty());
    bus.node_says("06 00 00 00 01 a0 01 00 04 00 01 00");
    EXPECT_EQ(bus.told<ProgramReplaced>().size(), 1u);
    EXPECT_FALSE(bus.network.node(1)->program.has_value());
}

TEST_F(Program, StepsToTheNextLine) {
    load();
    bus.state(1, 3, 3);
    const RequestId request = bus.network.step(1).value();
    bus.forget();
    bus.state(1, 3, 3);
    EXPECT_EQ(bus.sent(), Dumps{kStep});
    bus.state(1, 4, 3);  // still line 1
    EXPECT_EQ(bus.sent(), Dumps{kStep});
    EXPECT_TRUE(bus.events.empty());
    bus.state(1, 5, 3);
    EXPECT_EQ(bus.sent(), Dumps{});
    EXPECT_EQ(error_of(bus, request), "");
    ASSERT_EQ(bus.told<StateChanged>().size(), 1u);
    EXPECT_EQ(bus.told<StateChanged>()[0].at, (CodePlace{5, 2}));
}

TEST_F(Program, AStepEndsWithItsEvent) {
    load();
    ASSERT_TRUE(bus.network.step(1).ok());
    bus.state(1, 5, 3);
    bus.state(1, 6, 3);
    bus.state(1, 7, 3);
    bus.forget();
    bus.state(1, 7, 2);
    ASSERT_EQ(bus.told<RequestDone>().size(), 1u);
    EXPECT_EQ(bus.told<RequestDone>()[0].note, "the event has ended");
    EXPECT_EQ(bus.told<StateChanged>()[0].state, ProgramState::Stopped);
}

TEST_F(Program, AStepNeedsAPausedEvent) {
    load();
    const RequestId running = bus.network.step(1).value();
    bus.state(1, 4, 1);
    EXPECT_EQ(error_of(bus, running), "node 1 \"robot\" is running: pause it before a step");
    const RequestId idle = bus.network.step(1).value();
    bus.state(1, 7, 2);
    EXPECT_EQ(
        error_of(bus, idle),
        "node 1 \"robot\" is paused, but not in an event: a step needs one; send it an event, "
        "or reset it");
}

TEST_F(Program, AStepOnALineThatLoopsIsGivenUp) {
    load();
    const RequestId request = bus.network.step(1).value();
    bus.state(1, 5, 3);
    for (uint32_t i = 1; i < kLineStepsMax; i++) bus.state(1, 5, 3);
    EXPECT_EQ(error_of(bus, request), std::nullopt);
    bus.state(1, 5, 3);
    EXPECT_EQ(
        error_of(bus, request),
        "node 1 \"robot\" is still on line 2 after 10000 instructions: it seems to loop there");
}

TEST_F(Program, WithoutAProgramAStepIsOneInstruction) {
    ASSERT_TRUE(bus.network.step(1).ok());
    bus.state(1, 5, 3);
    bus.state(1, 6, 3);
    EXPECT_EQ(bus.told<RequestDone>().size(), 1u);
}

TEST_F(Program, IsSavedWithOrWithoutAnAnswer) {
    const RequestId silent = bus.network.save(1).value();
    EXPECT_EQ(bus.sent(), (Dumps{"02 00 00 00 0d a0 01 00", kGetState}));
    bus.state(1, 3, 0);
    EXPECT_EQ(error_of(bus, silent), "");
    bus.forget();
    ASSERT_TRUE(bus.network.save(1).ok());
    bus.node_says("0e 00 01 00 09 90 00 00 0b 46 6c 61 73 68 69 6e 67 20 4f 4b");  // "Flashing OK"
    bus.state(1, 3, 0);
    ASSERT_EQ(bus.told<RequestDone>().size(), 1u);
    EXPECT_EQ(bus.told<RequestDone>()[0].note, "the node says: Flashing OK");
    EXPECT_TRUE(bus.told<Fault>().empty());
    const RequestId failed = bus.network.save(1).value();
    bus.node_says("0f 00 01 00 09 90 00 00 0c 46 6c 61 73 68 69 6e 67 20 62 61 64");
    EXPECT_EQ(error_of(bus, failed), "node 1 \"robot\" did not save its program: Flashing bad");
    EXPECT_TRUE(bus.told<Fault>().empty());
}

}  // namespace
}  // namespace vagus::debug
