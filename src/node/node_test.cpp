#include "node/node.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "node/test_node.hpp"
#include "wire/messages.hpp"
#include "wire/reports.hpp"

namespace vagus::node {
namespace {

using testing::ElementsAre;

template <typename Message>
Message decoded(const wire::Frame& frame) {
    Message message{};
    EXPECT_EQ(wire::decode_message(frame, message), wire::Error::None) << hex(frame);
    return message;
}

std::string text_of(const wire::Text& text) {
    return {text.bytes, text.size};
}

// The worked examples of section 2.10, as they were captured.

TEST(Node, AnswersListNodesWithItsProtocolVersion) {
    TestNode test;
    EXPECT_EQ(test.ask("02 00 00 00 11 a0 05 00"), "02 00 01 00 0c 90 05 00");
}

TEST(Node, AnswersListNodesWithoutVersionWord) {
    TestNode test;
    EXPECT_EQ(test.ask("00 00 00 00 11 a0"), "02 00 01 00 0c 90 05 00");
}

TEST(Node, RunsAnUploadedProgramAndReceivesAnEvent) {
    TestNode test;
    EXPECT_EQ(test.ask("28 00 00 00 01 a0 01 00 00 00 05 00 ff ff 05 00 00 00 0d 00 "
                       "02 10 03 10 02 80 64 40 04 b0 64 00 02 00 00 00 "
                       "65 30 01 10 02 80 65 40 00 00"),
              "04 00 01 00 0a 90 05 00 03 00");
    EXPECT_EQ(test.ask("02 00 00 00 03 a0 01 00"), "04 00 01 00 0a 90 05 00 01 00");
    EXPECT_GT(run(test.node, 1000), 0);
    EXPECT_EQ(test.take(), "04 00 01 00 04 00 05 00 00 00");

    EXPECT_EQ(test.ask("08 00 00 00 0c a0 01 00 64 00 34 12 ff ff"), "");
    EXPECT_EQ(test.ask("04 00 2a 00 00 00 07 00 f8 ff"), "");
    EXPECT_EQ(test.ask("06 00 00 00 0b a0 01 00 00 00 06 00"),
              "0e 00 01 00 05 90 00 00 00 00 2a 00 07 00 f8 ff 00 00 00 00");
}

TEST(Node, NewestEventKillsTheRunningOne) {
    TestNode test;
    test.ask("14 00 00 00 01 a0 01 00 00 00 05 00 ff ff 05 00 00 00 05 00 00 90");  // init: jump 0
    test.ask("02 00 00 00 03 a0 01 00");
    run(test.node, 1000);
    EXPECT_EQ(test.ask("00 00 03 00 00 00"), "02 00 01 00 08 90 05 00");
}

TEST(Node, TellsTheTextOfANativesFault) {
    // init: 4 -> -4 at 100; sqrt(100, 100), length 1.
    TestNode test;
    test.ask("16 00 00 00 01 a0 01 00 00 00 03 00 ff ff 03 00 01 10 64 10 64 10 13 c0 00 00");
    test.variables[100] = -4;
    test.ask("02 00 00 00 03 a0 01 00");
    run(test.node, 1000);
    EXPECT_EQ(test.take(),
              "19 00 01 00 09 90 06 00 16 4e 65 67 61 74 69 76 65 20 69 6e 70 75 74 20 74 6f 20 73 "
              "71 72 74");
}

TEST(Node, DescribesItselfInTheOrderOfTheHeaderCounts) {
    TestNode test;
    test.ask("04 00 00 00 10 a0 01 00 05 00");
    ASSERT_EQ(test.sent.size(), 0u);  // ask() took them
    receive(test.node, frame_of("04 00 00 00 10 a0 01 00 05 00"));
    ASSERT_EQ(test.sent.size(), 1u + 3 + 2 + 30);
    EXPECT_EQ(hex(test.sent[0]),
              "13 00 01 00 00 90 04 6e 6f 64 65 05 00 00 02 40 00 24 04 03 00 02 00 1e 00");
    EXPECT_EQ(hex(test.sent[1]), "05 00 01 00 01 90 01 00 02 69 64");
    const auto event = decoded<wire::LocalEventDescription>(test.sent[4]);
    EXPECT_EQ(text_of(event.name), "timer");
    EXPECT_EQ(text_of(event.doc), "tick of the clock");
    const auto rot2 = decoded<wire::NativeFunctionDescription>(test.sent[6 + 18]);
    EXPECT_EQ(text_of(rot2.name), "math.rot2");
    ASSERT_EQ(rot2.parameter_count, 3);
    EXPECT_EQ(rot2.parameters[0].size, 2);
    EXPECT_EQ(text_of(rot2.parameters[2].name), "a");
}

TEST(Node, BroadcastGetDescriptionIsAnsweredToOldHostsOnly) {
    TestNode test;
    EXPECT_EQ(test.ask("02 00 00 00 00 a0 05 00"), "");
    EXPECT_EQ(test.ask("00 00 00 00 00 a0"), "");     // D11
    EXPECT_EQ(test.ask("01 00 00 00 00 a0 04"), "");  // D11: half a word
    receive(test.node, frame_of("02 00 00 00 00 a0 04 00"));
    EXPECT_EQ(test.sent.size(), 1u + 3 + 2 + 30);
}

TEST(Node, FragmentsAreTheHeaderAllOrOneItem) {
    TestNode test;
    EXPECT_EQ(test.ask("06 00 00 00 15 a0 01 00 09 00 ff ff"),
              "13 00 01 00 00 90 04 6e 6f 64 65 05 00 00 02 40 00 24 04 03 00 02 00 1e 00");
    EXPECT_EQ(test.ask("06 00 00 00 15 a0 01 00 09 00 01 00"),
              "09 00 01 00 01 90 01 00 06 73 6f 75 72 63 65");
    EXPECT_EQ(test.ask("06 00 00 00 15 a0 01 00 09 00 23 00"), "");       // 35: one too far
    EXPECT_EQ(test.ask("06 00 00 00 15 a0 01 00 09 00 fd ff"), "");       // -3
    EXPECT_EQ(test.ask("04 00 00 00 15 a0 01 00 09 00"), "");             // no fragment word
    receive(test.node, frame_of("06 00 00 00 15 a0 01 00 09 00 22 00"));  // 34: the last one
    ASSERT_EQ(test.sent.size(), 1u);
    EXPECT_EQ(text_of(decoded<wire::NativeFunctionDescription>(test.sent[0]).name),
              "deque.pop_back");
    test.sent.clear();
    receive(test.node, frame_of("06 00 00 00 15 a0 01 00 09 00 fe ff"));
    EXPECT_EQ(test.sent.size(), 1u + 3 + 2 + 30);
}

// D22.
TEST(Node, VariablesAreSplitBehind257Words) {
    TestNode test;
    for (size_t i = 0; i < test.variables.size(); ++i) test.variables[i] = static_cast<int16_t>(i);
    const auto asked = [&](const std::string& words) {
        receive(test.node, frame_of("06 00 00 00 0b a0 01 00 " + words));
        std::vector<std::vector<int>> pieces;  // start, size, first, last
        for (const wire::Frame& frame : test.sent) {
            const auto message = decoded<wire::Variables>(frame);
            const uint16_t last = static_cast<uint16_t>(message.values.count - 1);
            pieces.push_back({message.start, message.values.count, message.values.values[0],
                              message.values.values[last]});
        }
        test.sent.clear();
        return pieces;
    };
    using Piece = std::vector<int>;
    EXPECT_THAT(asked("0a 00 01 01"), ElementsAre(Piece{10, 257, 10, 266}));
    EXPECT_THAT(asked("0a 00 02 01"),
                ElementsAre(Piece{10, 257, 10, 266}, Piece{267, 1, 267, 267}));
    EXPECT_THAT(asked("f4 01 ff ff"),
                ElementsAre(Piece{500, 257, 500, 756}, Piece{757, 257, 757, 1013},
                            Piece{1014, 46, 1014, 1059}));
}

// For a line that takes only so much at once.
TEST(Node, AnswersInPiecesWhereItIsAskedTo) {
    TestNode test;
    const uint16_t words[] = {1, 5};
    begin_receive(test.node, 0, 0xa010, words, 2);
    EXPECT_EQ(test.sent.size(), 1u);
    for (size_t pieces = 2; pieces <= 1 + 3 + 2 + 30; ++pieces) {
        ASSERT_TRUE(is_answering(test.node));
        answer(test.node);
        ASSERT_EQ(test.sent.size(), pieces);
    }
    EXPECT_FALSE(is_answering(test.node));
    const uint16_t variables[] = {1, 0, 258};
    begin_receive(test.node, 0, 0xa00b, variables, 3);
    ASSERT_TRUE(is_answering(test.node));
    answer(test.node);
    EXPECT_FALSE(is_answering(test.node));
    EXPECT_EQ(decoded<wire::Variables>(test.sent.back()).start, 257);
}

TEST(Node, IgnoresCommandsForOthersRepliesAndTheUnknown) {
    TestNode test;
    EXPECT_EQ(test.ask("04 00 00 00 10 a0 02 00 05 00"), "");  // another node's description
    EXPECT_EQ(test.ask("02 00 00 00 07 a0 02 00"), "");        // another node's state
    EXPECT_EQ(test.ask("00 00 00 00 07 a0"), "");              // no destination
    EXPECT_EQ(test.ask("01 00 00 00 07 a0 01"), "");           // half a destination
    EXPECT_EQ(test.ask("02 00 00 00 12 a0 01 00"), "");        // GetDeviceInfo
    EXPECT_EQ(test.ask("02 00 02 00 0c 90 01 00"), "");        // another node's reply
    EXPECT_EQ(test.ask("02 00 00 00 00 80 01 00"), "");        // boot loader
    EXPECT_EQ(test.ask("02 00 00 00 fe ff 01 00"), "");
}

TEST(Node, PassesNoticesToItsBoard) {
    TestNode test;
    test.ask("02 00 00 00 0d a0 01 00");
    test.ask("02 00 00 00 0e a0 01 00");
    test.ask("02 00 00 00 0f a0 01 00");
    EXPECT_THAT(test.notices,
                ElementsAre(vm::Notice::WriteBytecode, vm::Notice::Reboot, vm::Notice::Sleep));
}

TEST(Node, BreakpointsGoWithTheHost) {
    TestNode test;
    test.ask("04 00 00 00 08 a0 01 00 05 00");
    ASSERT_EQ(test.node.vm.breakpoint_count, 1);
    host_left(test.node);
    EXPECT_EQ(test.node.vm.breakpoint_count, 0);
}

TEST(Node, ReportLeavesTheScriptRunning) {
    TestNode test;
    report(test.node, "Flashing OK");
    EXPECT_EQ(test.take(), "0e 00 01 00 09 90 00 00 0b 46 6c 61 73 68 69 6e 67 20 4f 4b");
    EXPECT_EQ(test.node.vm.flags, 0);
}

// Local events (section 3.6).

Description with_source(LocalEventSource source) {
    Description description = kTestDescription;
    description.local_event_source = source;
    return description;
}

TEST(Node, RobotsLeaveTheirIdAsSourceOfLocalEvents) {
    const Description description = with_source(LocalEventSource::OwnId);
    TestNode test(description, 7);
    local_event(test.node, 0);  // there is no handler: the source is written all the same
    EXPECT_EQ(test.variables[1], 7);
}

TEST(Node, OtherNodesKeepTheSource) {
    TestNode test;
    test.variables[1] = 42;
    local_event(test.node, 0);
    EXPECT_EQ(test.variables[1], 42);
}

TEST(Node, PausedInsideAnEventNoLocalEventLeavesATrace) {
    const Description description = with_source(LocalEventSource::OwnId);
    TestNode test(description, 7);
    // init: stop; local event 0 (0xfffe): stop. SetBytecode pauses inside init.
    test.ask("12 00 00 00 01 a0 07 00 00 00 05 00 fe ff 06 00 ff ff 05 00 00 00 00 00");
    local_event(test.node, 0);
    EXPECT_EQ(test.take(), "");
    EXPECT_EQ(test.variables[1], 0);
}

TEST(Node, LocalEventRunsItsHandler) {
    TestNode test;
    // local event 1 (0xfffd) @3: push 9, store 100, stop
    test.ask("10 00 00 00 01 a0 01 00 00 00 03 00 fd ff 03 00 09 10 64 40 00 00");
    test.ask("02 00 00 00 03 a0 01 00");
    local_event(test.node, 0);
    EXPECT_EQ(run(test.node, 1000), 0);
    local_event(test.node, 1);
    EXPECT_EQ(run(test.node, 1000), 3);
    EXPECT_EQ(test.variables[100], 9);
}

TEST(Node, StartProgramRunsInitInRunningMode) {
    TestNode test;
    const uint16_t program[] = {3, 0xffff, 3, 0x1009, 0x4064, 0};
    std::copy(std::begin(program), std::end(program), test.bytecode.begin());
    start_program(test.node);
    EXPECT_EQ(run(test.node, 1000), 3);
    EXPECT_EQ(test.variables[100], 9);
    EXPECT_EQ(test.take(), "04 00 01 00 0a 90 03 00 03 00\n04 00 01 00 0a 90 03 00 01 00");
}

TEST(Node, StartProgramForgetsWhatWhensRemembered) {
    TestNode test;
    // init: push 1, push 0, when 1 != 0 (seen before the program was saved): 9 -> 100
    const uint16_t program[] = {3, 0xffff, 3, 0x1001, 0x1000, 0xa30b, 4, 0x1009, 0x4064, 0};
    std::copy(std::begin(program), std::end(program), test.bytecode.begin());
    start_program(test.node);
    run(test.node, 1000);
    EXPECT_EQ(test.variables[100], 9);
}

TEST(Node, NativeThatDoesNotExistIsAFault) {
    TestNode test;
    test.ask("0e 00 00 00 01 a0 01 00 00 00 03 00 ff ff 03 00 1e c0 00 00");  // native 30
    test.ask("02 00 00 00 03 a0 01 00");
    run(test.node, 1000);
    ASSERT_EQ(test.sent.size(), 1u);
    EXPECT_EQ(text_of(decoded<wire::NodeSpecificError>(test.sent[0]).text),
              "Native function does not exist");
    EXPECT_EQ(test.node.vm.flags, wire::kFlagStep);
}

// Texts (D16).

Description named(const char* name) {
    Description description = kTestDescription;
    description.name = name;
    return description;
}

std::string name_sent(const std::string& name) {
    const Description description = named(name.c_str());
    TestNode test(description);
    receive(test.node, frame_of("06 00 00 00 15 a0 01 00 09 00 ff ff"));
    return text_of(decoded<wire::Description>(test.sent.at(0)).name);
}

TEST(Node, NameOf255BytesIsSentWhole) {
    EXPECT_EQ(name_sent(std::string(255, 'n')), std::string(255, 'n'));
}

TEST(Node, NameOf256BytesIsCut) {
    EXPECT_EQ(name_sent(std::string(256, 'n')), std::string(255, 'n'));
}

TEST(Node, TextIsCutAtTheBorderOfACharacter) {
    EXPECT_EQ(name_sent(std::string(254, 'n') + "é"), std::string(254, 'n'));
    EXPECT_EQ(name_sent(std::string(253, 'n') + "é"), std::string(253, 'n') + "é");
    EXPECT_EQ(name_sent(std::string(252, 'n') + "🤖"), std::string(252, 'n'));
    EXPECT_EQ(name_sent("\x80\x80"), "\x80\x80");  // not UTF-8, but short enough: as it is
}

void nothing(Node&) {}

wire::NativeFunctionDescription described(TestNode& test, const Native& native) {
    Description description = kTestDescription;
    description.natives[0] = {&native, 1};
    test.node.description = &description;
    // Item 5: behind three variables and two events.
    receive(test.node, frame_of("06 00 00 00 15 a0 01 00 09 00 05 00"));
    test.node.description = &kTestDescription;
    return decoded<wire::NativeFunctionDescription>(test.sent.at(0));
}

TEST(Node, NativeWithLongTextsFitsOneFrame) {
    const std::string longest(255, 'p');
    const std::vector<Parameter> parameters(wire::kParametersMax, {1, longest.c_str()});
    const Native native = {longest.c_str(), longest.c_str(), parameters.data(),
                           wire::kParametersMax, nothing};
    TestNode test;
    const auto message = described(test, native);
    EXPECT_EQ(message.parameter_count, wire::kParametersMax);
    EXPECT_EQ(text_of(message.name), std::string(7, 'p'));
    EXPECT_EQ(text_of(message.parameters[31].name), std::string(7, 'p'));
}

TEST(Node, MoreParametersThanTheLimitAreNotTold) {
    const std::vector<Parameter> parameters(wire::kParametersMax + 1, {1, "p"});
    const Native native = {"f", "", parameters.data(), wire::kParametersMax + 1, nothing};
    TestNode test;
    EXPECT_EQ(described(test, native).parameter_count, wire::kParametersMax);
}

// ---- Which program it is (section 3.11) ----

class ProgramOfANode : public testing::Test {
protected:
    static Description description() {
        Description description = kTestDescription;
        description.variable_count = 4;
        description.variables = kVariables;
        description.program_at = 34;
        return description;
    }
    // SetBytecode, as a host sends it.
    void load(uint16_t start, const std::vector<uint16_t>& words) {
        wire::Frame frame{};
        frame.type = 0xa001;
        wire::add_argument(frame, 1);
        wire::add_argument(frame, static_cast<int16_t>(start));
        for (const uint16_t word : words) wire::add_argument(frame, static_cast<int16_t>(word));
        receive(test.node, frame);
        test.take();
    }
    std::string told() {
        return test.ask("06 00 00 00 0b a0 01 00 22 00 02 00").substr(24);  // behind the address
    }
    static constexpr Variable kVariables[] = {
        {1, "id"}, {1, "source"}, {32, "args"}, {2, "_program"}};
    const Description description_ = description();
    TestNode test{description_};
};

// Checksums by zlib's crc32.
TEST_F(ProgramOfANode, IsTheChecksumOfItsWordsLowWordFirst) {
    EXPECT_EQ(told(), "00 00 00 00");
    load(0, {3, 0xffff, 3, 0});
    EXPECT_EQ(told(), "24 1b b8 d7");
    load(0, {1});
    EXPECT_EQ(told(), "be 23 c2 58");
    load(0, {0});
    EXPECT_EQ(told(), "00 00 00 00");
}

TEST_F(ProgramOfANode, ComesInPieces) {
    load(0, {3, 0xffff});
    load(2, {3, 0});
    EXPECT_EQ(told(), "24 1b b8 d7");
}

TEST_F(ProgramOfANode, IsNeverToldAsNone) {
    load(0, {1, 0, 0xb2e4, 0xf421});  // its CRC is 0
    EXPECT_EQ(told(), "01 00 00 00");
}

TEST_F(ProgramOfANode, IsUnknownIfAPieceIsMissingOrComesTwice) {
    load(0, {3, 0xffff});
    load(3, {0});
    EXPECT_EQ(told(), "ff ff ff ff");
    load(4, {0});
    EXPECT_EQ(told(), "ff ff ff ff");
    load(0, {3, 0xffff});
    load(2, {3, 0});
    load(2, {3, 0});
    EXPECT_EQ(told(), "ff ff ff ff");
    load(0, {1});
    EXPECT_EQ(told(), "be 23 c2 58");
}

TEST_F(ProgramOfANode, OnlyWordsThatAreKeptCount) {
    load(0, {1});
    load(600, {7});  // behind the bytecode
    EXPECT_EQ(told(), "be 23 c2 58");
}

TEST_F(ProgramOfANode, IsNotWhatSomebodyWroteThere) {
    load(0, {1});
    test.ask("08 00 00 00 0c a0 01 00 22 00 07 00 07 00");
    EXPECT_EQ(told(), "be 23 c2 58");
}

// A board does the sum in steps: nothing of the program may run meanwhile.
TEST_F(ProgramOfANode, IsCountedBeforeTheNextCommand) {
    begin_receive(test.node, 0, 0xa001, std::vector<uint16_t>{1, 0, 3, 0xffff, 3, 0}.data(), 6);
    EXPECT_TRUE(is_counting(test.node));
    EXPECT_TRUE(is_answering(test.node));
    test.take();
    while (is_answering(test.node)) answer(test.node);
    EXPECT_EQ(test.take(), "");
    EXPECT_EQ(told(), "24 1b b8 d7");
}

TEST_F(ProgramOfANode, ThatLacksTheVariableIsNotWrittenAnywhere) {
    TestNode without;
    without.ask("08 00 00 00 01 a0 01 00 00 00 01 00 02 00");
    for (const int16_t word : without.variables) ASSERT_EQ(word, 0);
}

// The list of the specification, section 4.2, word for word.
TEST(Node, StandardNativesHaveTheNamesAndOrderOfTheSpecification) {
    const std::vector<std::string> names = {
        "math.copy",   "math.fill",        "math.addscalar",  "math.add",        "math.sub",
        "math.mul",    "math.div",         "math.min",        "math.max",        "math.clamp",
        "math.dot",    "math.stat",        "math.argbounds",  "math.sort",       "math.muldiv",
        "math.atan2",  "math.sin",         "math.cos",        "math.rot2",       "math.sqrt",
        "math.rand",   "deque.size",       "deque.get",       "deque.set",       "deque.insert",
        "deque.erase", "deque.push_front", "deque.push_back", "deque.pop_front", "deque.pop_back"};
    ASSERT_EQ(names.size(), kStandardNativeCount);
    for (size_t i = 0; i < names.size(); ++i) EXPECT_EQ(kStandardNatives[i].name, names[i]);
}

}  // namespace
}  // namespace vagus::node
