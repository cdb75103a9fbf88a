// Recordings of real buses in memory: what is kept of frames, and how a plan hears them again.
#include <gtest/gtest.h>

#include <variant>

#include "mcap/reader.hpp"
#include "record/bus_recorder.hpp"
#include "record/past_bus.hpp"
#include "record/recorder.hpp"
#include "wire/messages.hpp"

namespace vagus::record {
namespace {

using namespace std::chrono_literals;

wire::Frame frame_of(uint16_t source, uint16_t type, const std::vector<int16_t>& words) {
    wire::Frame frame{.size = static_cast<uint16_t>(2 * words.size()),
                      .source = source,
                      .type = type,
                      .payload = {}};
    for (size_t i = 0; i < words.size(); ++i) {
        frame.payload[2 * i] = static_cast<uint8_t>(words[i] & 0xff);
        frame.payload[2 * i + 1] = static_cast<uint8_t>(words[i] >> 8 & 0xff);
    }
    return frame;
}

constexpr auto kVariables = static_cast<uint16_t>(wire::MessageType::Variables);

aesl::Project project() {
    aesl::Project project;
    project.common.events = {{"go", 1}, {"gone", 1}};
    return project;
}

debug::NodeView rover() {
    aesl::Target target;
    target.name = "rover";
    target.variables_size = 4;
    target.variables = {{"id", 1}, {"speed", 2}, {"acc", 1}};
    debug::NodeView node;
    node.id = 3;
    node.name = "rover";
    node.described = true;
    node.target = std::move(target);
    return node;
}

// What is recorded, as bytes.
class BusInMemory : public testing::Test {
protected:
    std::vector<std::string> messages(std::string_view topic) {
        EXPECT_TRUE(tape.end().ok());
        const auto reader = mcap::Reader::open(bytes, "bus.mcap");
        std::vector<std::string> found;
        mcap::Cursor cursor(reader.value());
        while (const auto message = cursor.next()) {
            const mcap::Channel* const channel = reader.value().channel(message->channel);
            if (channel->topic == topic) found.emplace_back(message->data);
        }
        return found;
    }

    std::unique_ptr<PastBus> past() {
        EXPECT_TRUE(tape.end().ok());
        auto opened = mcap::Reader::open(bytes, "bus.mcap");
        auto read = PastBus::read(opened.value(), project());
        EXPECT_TRUE(read.ok());
        return std::move(read.value());
    }

    void line(Time at, const std::string& text) { tape.put(trace, at, text); }
    void hears(Time at, uint32_t frame) { recorder.input_at(at, Heard{.frame = frame}); }

    std::string bytes;
    FileTape tape{[this](std::string_view more) {
                      bytes += more;
                      return Status::done();
                  },
                  Pace::NeverWaits};
    uint16_t trace = tape.declare({.name = std::string(kTraceTopic)});
    Recorder recorder{tape, "{}"};
    BusRecorder bus{tape};
};

TEST_F(BusInMemory, AVariableIsToldWhenAllItsWordsAreKnownAndWhenItChanges) {
    bus.begin(project().common);
    bus.described(0ms, rover());
    (void)bus.frame(1ms, {.frame = frame_of(3, kVariables, {0, 7, 1})});     // half of `speed`
    (void)bus.frame(2ms, {.frame = frame_of(3, kVariables, {2, 2, 5})});     // the rest
    (void)bus.frame(3ms, {.frame = frame_of(3, kVariables, {0, 7, 1, 2})});  // nothing new
    (void)bus.frame(4ms, {.frame = frame_of(3, kVariables, {3, -5})});
    (void)bus.frame(5ms, {.frame = frame_of(3, kVariables, {3, 1, 2, 3})});  // beyond its memory
    (void)bus.frame(6ms, {.frame = frame_of(9, kVariables, {0, 1})});        // of nobody
    (void)bus.frame(7ms, {.frame = frame_of(3, kVariables, {})});            // without a word
    EXPECT_EQ(messages("/node/rover/variables"),
              (std::vector<std::string>{R"({"t":0.001000,"all":false,"set":{"id":7}})",
                                        R"({"t":0.002000,"all":false,)"
                                        R"("set":{"speed":[1,2],"acc":5}})",
                                        R"({"t":0.004000,"all":false,"set":{"acc":-5}})",
                                        R"({"t":0.005000,"all":false,"set":{"acc":1}})"}));
}

TEST_F(BusInMemory, FramesAreReadAsTheyWereAndEventsKnowWhoSentThem) {
    bus.begin(project().common);
    const uint32_t go = bus.frame(1ms, {.frame = frame_of(0, 0, {4}), .cause = 0, .by = "ask"});
    const uint32_t gone = bus.frame(2ms, {.frame = frame_of(3, 1, {5})});
    (void)bus.frame(3ms, {.frame = frame_of(0, 9, {})});
    EXPECT_EQ(gone, go + 1);
    const auto events = past()->events();
    ASSERT_EQ(events.size(), 3u);
    EXPECT_EQ(events.at(go).event.by, "ask");
    EXPECT_EQ(events.at(gone).event.name, "gone");
    EXPECT_EQ(events.at(gone).event.arguments, std::vector<int16_t>{5});
    EXPECT_EQ(events.at(3).event.name, "9");
}

// Each event is one of the script that its node had then.
TEST_F(BusInMemory, ANodeThatIsLoadedAgainHasAnotherScriptFromThenOn) {
    const std::string files[] = {"a.aesl", "b.aesl"};
    for (size_t i = 0; i < 2; ++i) {
        const std::string text = "<network><node nodeId=\"3\" name=\"rover\">" +
                                 std::string("emit go ") + std::to_string(i) + "</node></network>";
        recorder.input_at(Time(1ms + i * 2ms), ScriptLoaded{3, files[i], text});
    }
    bus.described(0ms, rover());
    const auto was = past();
    EXPECT_EQ(was->script_of(3, 0ms).script, nullptr);  // the project has none
    EXPECT_EQ(was->script_of(3, 2ms).file, "a.aesl");
    ASSERT_NE(was->script_of(3, 3ms).script, nullptr);
    EXPECT_EQ(was->script_of(3, 3ms).script->source, "emit go 1");
    EXPECT_FALSE(was->script_of(3, 3ms).is_attached);
    EXPECT_EQ(was->script_of(4, 3ms).script, nullptr);
}

TEST(BusMessages, BytesThatAreNoFrameAreNone) {
    std::string whole;
    (void)format_frame(whole, {1, 0, frame_of(3, 1, {5})});
    ASSERT_TRUE(read_frame(whole));
    for (size_t size = 0; size < whole.size(); ++size) {
        EXPECT_FALSE(read_frame(std::string_view(whole).substr(0, size))) << size;
    }
    EXPECT_FALSE(read_frame(whole + "x"));
}

// What was heard before a decision comes before it, and with what was heard just before it.
TEST_F(BusInMemory, WhatWasHeardComesInTheOrderInWhichItWasDecidedOn) {
    bus.begin(project().common);
    for (int i = 0; i < 3; ++i) (void)bus.frame(1ms, {.frame = frame_of(3, 1, {5})});
    hears(100ms, 1);
    hears(101ms, 2);
    line(102ms, R"({"t":0.102000,"plan":"P","kind":"plan-start"})");
    hears(200ms, 3);
    const auto again = past();
    EXPECT_EQ(again->next(), Time(100ms));
    EXPECT_EQ(again->late(Time(90ms)), Time(100ms));  // a timer that was a little late
    EXPECT_EQ(again->late(Time(50ms)), Time(50ms));   // too much for that
    EXPECT_EQ(again->begin().size(), 2u);
    EXPECT_EQ(again->next(), Time(200ms));
    EXPECT_EQ(again->late(Time(190ms)), Time(190ms));  // no decision follows it
    EXPECT_EQ(again->begin().size(), 1u);
    EXPECT_EQ(again->next(), run::kNever);
}

TEST_F(BusInMemory, WhatThePlanSentComesBeforeWhatItHeardBehindThat) {
    bus.begin(project().common);
    (void)bus.frame(99ms, {.frame = frame_of(0, 0, {4}), .cause = 0, .by = "ask"});
    (void)bus.frame(100ms, {.frame = frame_of(3, 1, {5})});
    hears(100ms, 2);
    line(101ms, R"({"t":0.101000,"plan":"P","kind":"plan-start"})");
    const auto again = past();
    EXPECT_EQ(again->late(Time(95ms)), Time(95ms));
    again->emit(Time(95ms), {.name = "go", .arguments = {}});
    EXPECT_EQ(again->late(Time(95ms)), Time(100ms));
}

// Its run went on when it became too large: what is decided then again is no difference.
TEST_F(BusInMemory, BehindTheEndOfOneThatIsCutThereIsNothingToCompare) {
    recorder.input_at(5ms, RecordingEnds{"it has 512 MB"});
    const auto again = past();
    EXPECT_TRUE(again->is_cut());
    EXPECT_TRUE(again->take({6ms, "P", plan::PlanStarted{}}).empty());
    EXPECT_FALSE(again->parted());
}

TEST_F(BusInMemory, OneThatEndsWithItsRunIsWhole) {
    recorder.input_at(5ms, RecordingEnds{});
    EXPECT_FALSE(past()->is_cut());
}

TEST(BusMessages, AnEventIsReadAsItWasWritten) {
    const RecordedEvent event{.at = 2ms,
                              .frame = 7,
                              .node = 3,
                              .name = "far \"out\"",
                              .arguments = {0, -32768, 32767},
                              .by = "ask"};
    std::string room;
    const auto read = read_event(2ms, format_event(room, event));
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->frame, 7u);
    EXPECT_EQ(read->node, 3);
    EXPECT_EQ(read->name, "far \"out\"");
    EXPECT_EQ(read->arguments, (std::vector<int16_t>{0, -32768, 32767}));
    EXPECT_EQ(read->by, "ask");
}

TEST(BusMessages, WhatIsNoEventIsNotRead) {
    for (const char* const bad :
         {"", "{", "[]", "{}", R"({"frame":1})", R"({"frame":-1,"node":3})",
          R"({"frame":1,"node":65536})", R"({"frame":1,"node":1.5})",
          R"({"frame":1,"node":3,"args":[32768]})", R"({"frame":1,"node":3,"args":["1"]})"}) {
        EXPECT_FALSE(read_event(Time{}, bad).has_value()) << bad;
    }
}

TEST(BusMessages, ANodeThatWentSaysSo) {
    const auto left = read_node(R"({"t":1,"node":3,"name":"rover","state":"left"})");
    ASSERT_TRUE(left.has_value());
    EXPECT_EQ(left->node, 3);
    EXPECT_EQ(left->name, "rover");
    EXPECT_TRUE(left->left);
    EXPECT_FALSE(read_node(R"({"name":"rover"})").has_value());
}

}  // namespace
}  // namespace vagus::record
