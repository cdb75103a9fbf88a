// Variables: reading in pieces, replies in chunks, writing, watching
// (wire spec, 1.3, 2.3 and 2.10).
#include "debug/scripted_bus.hpp"

namespace vagus::debug {
namespace {

class Variables : public testing::Test {
protected:
    void SetUp() override { bus.meet_robot(1); }
    void reply(uint16_t start, uint16_t count, int16_t first) {
        wire::Variables message{};
        message.start = start;
        message.values.count = count;
        for (uint16_t i = 0; i < count; i++)
            message.values.values[i] = static_cast<int16_t>(first + i);
        bus.node_sends(1, message);
    }
    VariableRange range(uint16_t address, uint16_t count) {
        return {.name = "v", .address = address, .first = 0, .count = count};
    }
    ScriptedBus bus;
};

// Dump 3.
TEST_F(Variables, AreReadByName) {
    const VariableRange source = bus.network.variable(1, "args[0:1]").value();
    const RequestId request = bus.network.get(1, source).value();
    EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 0b a0 01 00 02 00 02 00"});
    bus.node_says("06 00 01 00 05 90 02 00 05 00 00 00");
    ASSERT_EQ(bus.told<VariablesArrived>().size(), 1u);
    EXPECT_EQ(bus.told<VariablesArrived>()[0].values, (std::vector<int16_t>{5, 0}));
    EXPECT_EQ(bus.told<VariablesArrived>()[0].request, request);
    EXPECT_EQ(bus.told<RequestDone>().size(), 1u);
}

TEST_F(Variables, HaveRangesThatAreChecked) {
    const VariableRange part = bus.network.variable(1, "args[2:5]").value();
    EXPECT_EQ(part.address, 4);
    EXPECT_EQ(part.first, 2);
    EXPECT_EQ(part.count, 4);
    EXPECT_EQ(bus.network.variable(1, "args[31]").value().address, 33);
    EXPECT_EQ(bus.network.variable(1, "args[32]").error().what,
              "args has 32 words, numbered from 0: there is no \"args[32]\"");
    EXPECT_EQ(bus.network.variable(1, "args[5:2]").error().what,
              "\"args[5:2]\": after the name comes [INDEX] or [FIRST:LAST]");
    EXPECT_FALSE(bus.network.variable(1, "args[").ok());
    EXPECT_FALSE(bus.network.variable(1, "args[1]x").ok());
    EXPECT_EQ(bus.network.variable(1, "agrs").error().what,
              "node 1 \"robot\" has no variable \"agrs\"; did you mean args?");
    EXPECT_EQ(bus.network.variable(1, "speed").error().what,
              "node 1 \"robot\" has no variable \"speed\"; those of its script need its project");
}

TEST_F(Variables, LongRangesAreReadInPiecesOf257Words) {
    ASSERT_TRUE(bus.network.get(1, range(0, 600)).ok());
    EXPECT_EQ(bus.sent(), (Dumps{"06 00 00 00 0b a0 01 00 00 00 01 01",     // 0, 257
                                 "06 00 00 00 0b a0 01 00 01 01 01 01",     // 257, 257
                                 "06 00 00 00 0b a0 01 00 02 02 56 00"}));  // 514, 86
    reply(514, 86, 514);
    reply(0, 257, 0);
    EXPECT_TRUE(bus.told<VariablesArrived>().empty());
    reply(257, 257, 257);
    ASSERT_EQ(bus.told<VariablesArrived>().size(), 1u);
    for (int i = 0; i < 600; i++) {
        EXPECT_EQ(bus.told<VariablesArrived>()[0].values[static_cast<size_t>(i)], i);
    }
}

TEST_F(Variables, RepliesInChunksArePutTogetherAndOnlyLostOnesAskedForAgain) {
    ASSERT_TRUE(bus.network.get(1, range(10, 100)).ok());
    bus.forget();
    reply(10, 47, 0);
    reply(104, 6, 94);
    reply(8, 3, -2);  // for another host: overlaps
    bus.pass(milliseconds(1000));
    EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 0b a0 01 00 39 00 2f 00"});  // 57, 47
    reply(57, 47, 47);
    ASSERT_EQ(bus.told<VariablesArrived>().size(), 1u);
    EXPECT_EQ(bus.told<VariablesArrived>()[0].values[0], 0);
    EXPECT_EQ(bus.told<VariablesArrived>()[0].values[99], 99);
}

TEST_F(Variables, ANodeThatDoesNotAnswerIsAskedThreeTimes) {
    const RequestId request = bus.network.get(1, range(0, 1)).value();
    for (int second = 1; second <= 3; second++) {
        EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 0b a0 01 00 00 00 01 00"});
        EXPECT_TRUE(bus.told<RequestDone>().empty());
        bus.network.list_nodes();
        bus.node_says("02 00 01 00 0c 90 05 00");
        bus.pass(milliseconds(1000));
    }
    ASSERT_EQ(bus.told<RequestDone>().size(), 1u);
    EXPECT_EQ(bus.told<RequestDone>()[0].request, request);
    EXPECT_EQ(bus.told<RequestDone>()[0].error->code, Code::Timeout);
}

TEST_F(Variables, AreWrittenInPiecesOf256WordsAndConfirmed) {
    const std::vector<int16_t> two = {0x1234, -1};
    ASSERT_TRUE(bus.network.set(1, range(100, 2), two).ok());
    EXPECT_EQ(bus.sent(), (Dumps{"08 00 00 00 0c a0 01 00 64 00 34 12 ff ff",
                                 "06 00 00 00 0b a0 01 00 64 00 02 00"}));
    EXPECT_TRUE(bus.told<RequestDone>().empty());
    reply(100, 2, 0);
    EXPECT_EQ(bus.told<RequestDone>().size(), 1u);
    const std::vector<int16_t> many(300);
    ASSERT_TRUE(bus.network.set(1, range(100, 300), many).ok());
    const Dumps sent = bus.sent();
    ASSERT_EQ(sent.size(), 4u);
    EXPECT_TRUE(sent[0].starts_with("04 02 00 00 0c a0 01 00 64 00 "));  // 4 + 512 bytes at 100
    EXPECT_TRUE(sent[1].starts_with("5c 00 00 00 0c a0 01 00 64 01 "));  // 4 + 88 at 356
    EXPECT_FALSE(bus.network.set(1, range(100, 1), two).ok());
    EXPECT_FALSE(bus.network.set(1, range(100, 1), {}).ok());
}

TEST_F(Variables, WatchedOnesArePolledAndToldWhenTheyDiffer) {
    const VariableRange source = bus.network.variable(1, "source").value();
    const std::string ask = "06 00 00 00 0b a0 01 00 01 00 01 00";
    ASSERT_TRUE(bus.network.watch(1, source, milliseconds(100)).ok());
    EXPECT_EQ(bus.sent(), Dumps{ask});
    bus.pass(milliseconds(100));
    EXPECT_EQ(bus.sent(), Dumps{});  // the last question is not answered yet
    reply(1, 1, 42);
    ASSERT_EQ(bus.told<VariableChanged>().size(), 1u);
    EXPECT_EQ(bus.told<VariableChanged>()[0].values, std::vector<int16_t>{42});
    bus.pass(milliseconds(99));
    EXPECT_EQ(bus.sent(), Dumps{});
    bus.pass(milliseconds(1));
    EXPECT_EQ(bus.sent(), Dumps{ask});
    reply(1, 1, 42);
    EXPECT_EQ(bus.told<VariableChanged>().size(), 1u);
    bus.network.unwatch(1, "source");
    bus.pass(milliseconds(500));
    EXPECT_EQ(bus.sent(), Dumps{});
}

TEST_F(Variables, AWatchGoesOnAfterLostRepliesAndAbsence) {
    ASSERT_TRUE(bus.network.watch(1, bus.network.variable(1, "source").value()).ok());
    for (int second = 0; second < 3; second++) {
        bus.network.list_nodes();
        bus.node_says("02 00 01 00 0c 90 05 00");
        bus.pass(milliseconds(1000));
    }
    EXPECT_EQ(bus.sent().size(), 4u);  // three in vain, then a new question
    reply(1, 1, 7);
    EXPECT_EQ(bus.told<VariableChanged>().size(), 1u);
    bus.pass(kSilenceMax);
    bus.node_says("02 00 01 00 0c 90 05 00");
    bus.describe_robot(1);
    bus.forget();
    bus.pass(milliseconds(100));
    EXPECT_EQ(bus.sent(), Dumps{"06 00 00 00 0b a0 01 00 01 00 01 00"});
}

TEST_F(Variables, RequestsAndWatchesAreBounded) {
    for (size_t i = 0; i < kRequestsMax; i++) EXPECT_TRUE(bus.network.get(1, range(0, 1)).ok());
    EXPECT_EQ(bus.network.get(1, range(0, 1)).error().code, Code::Limit);
    for (size_t i = 0; i < kWatchesMax; i++) EXPECT_TRUE(bus.network.watch(1, range(0, 1)).ok());
    EXPECT_EQ(bus.network.watch(1, range(0, 1)).error().code, Code::Limit);
}

}  // namespace
}  // namespace vagus::debug
