// What a node with `_program` tells, and what follows from it when it comes back.
#include "debug/program_mark.hpp"

#include "debug/control.hpp"
#include "debug/fetch.hpp"
#include "debug/scripted_bus.hpp"

namespace vagus::debug {
namespace {

const std::vector<uint16_t> kWords = {0x0003, 0xffff, 0x0003, 0x1001, 0x4064, 0x0000};
constexpr const char* kAsk = "06 00 00 00 0b a0 01 00 22 00 02 00";  // two words at 34

class ProgramMark : public testing::Test {
protected:
    // A node that has `_program` behind its three other variables.
    void SetUp() override {
        bus.node_says(kPresent1);
        describe();
    }
    void describe(const char* last = "_program", uint16_t words = 2) {
        wire::Description header{};
        header.name = {"robot", 5};
        header.protocol_version = 5;
        header.bytecode_size = 100;
        header.stack_size = 32;
        header.variables_size = 100;
        header.variable_count = 4;
        bus.node_sends(1, header);
        bus.variable(1, "id", 1);
        bus.variable(1, "source", 1);
        bus.variable(1, "args", 32);
        bus.sent();
        bus.variable(1, last, words);
    }
    void tells(uint32_t mark) {
        wire::Variables message{};
        message.start = 34;
        message.values.count = 2;
        message.values.values[0] = static_cast<int16_t>(mark & 0xffff);
        message.values.values[1] = static_cast<int16_t>(mark >> 16);
        bus.node_sends(1, message);
    }
    void adopt() {
        aesl::Program program;
        program.bytecode = kWords;
        program.lines.resize(kWords.size());
        ASSERT_TRUE(bus.network.adopt(1, program).ok());
    }
    void come_back() {
        bus.network.link_lost();
        bus.node_says(kPresent1);
        describe();
    }
    std::optional<uint32_t> told() { return bus.network.node(1)->told_program; }
    ScriptedBus bus;
};

// zlib.crc32(struct.pack("<6H", …)).
TEST_F(ProgramMark, IsTheCrcOfTheWordsLowByteFirst) {
    EXPECT_EQ(mark_of(kWords), 0x45ae6190u);
    EXPECT_EQ(mark_of(std::vector<uint16_t>{1}), 0x58c223beu);
}

TEST_F(ProgramMark, IsZeroForNoneAndNeverForAProgram) {
    EXPECT_EQ(mark_of({}), 0u);
    EXPECT_EQ(mark_of(std::vector<uint16_t>{0, 7}), 0u);
    EXPECT_EQ(mark_of(std::vector<uint16_t>{1, 0, 0xb2e4, 0xf421}), 1u);  // its CRC is 0
}

TEST_F(ProgramMark, IsAskedBeforeTheStateWhenTheNodeIsDescribed) {
    EXPECT_EQ(bus.sent(), (Dumps{kAsk, kGetState}));
    EXPECT_EQ(told(), std::nullopt);
    tells(0x12345678);
    EXPECT_EQ(told(), 0x12345678u);
    ASSERT_EQ(bus.told<ProgramTold>().size(), 1u);
    EXPECT_EQ(bus.told<ProgramTold>()[0].mark, 0x12345678u);
    EXPECT_TRUE(bus.told<ProgramReplaced>().empty());
}

TEST_F(ProgramMark, IsAskedOnRequest) {
    tells(5);
    bus.forget();
    const RequestId request = bus.network.ask_program(1).value();
    EXPECT_EQ(bus.sent(), Dumps{kAsk});
    tells(6);
    EXPECT_EQ(told(), 6u);
    ASSERT_EQ(bus.told<RequestDone>().size(), 1u);
    EXPECT_EQ(bus.told<RequestDone>()[0].request, request);
    EXPECT_FALSE(bus.told<RequestDone>()[0].error);
}

TEST_F(ProgramMark, ThatNeverComesEndsTheRequest) {
    tells(5);
    bus.forget();
    (void)bus.network.ask_program(1).value();
    for (int i = 0; i < kFetchTriesMax; i++) {
        bus.node_says(kPresent1);  // it lives
        bus.pass(kFetchRetry);
    }
    ASSERT_EQ(bus.told<RequestDone>().size(), 1u);
    EXPECT_TRUE(bus.told<RequestDone>()[0].error);
}

// A request that waits for it would wait for ever.
TEST_F(ProgramMark, ThatNeverComesUnaskedIsSaid) {
    for (int i = 0; i < kFetchTriesMax; i++) {
        EXPECT_TRUE(bus.told<ProgramUntold>().empty());
        bus.node_says(kPresent1);  // it lives
        bus.pass(kFetchRetry);
    }
    EXPECT_EQ(bus.told<ProgramUntold>().size(), 1u);
}

TEST_F(ProgramMark, IsSaidToBeUntoldIfAnotherHostLoadsMeanwhile) {
    const char* const words = "06 00 00 00 01 a0 01 00 04 00 01 00";
    bus.node_says(words);
    EXPECT_EQ(bus.told<ProgramUntold>().size(), 1u);
    bus.node_says(words);  // nobody waits any more
    EXPECT_EQ(bus.told<ProgramUntold>().size(), 1u);
}

// Being paused as after power-up proves nothing, nor does being paused elsewhere.
TEST_F(ProgramMark, OfTheSameProgramKeepsItWhereverTheNodeStands) {
    adopt();
    come_back();
    EXPECT_EQ(told(), std::nullopt);
    tells(mark_of(kWords));
    bus.state(1, 0, 0);
    EXPECT_TRUE(bus.told<ProgramReplaced>().empty());
    EXPECT_TRUE(bus.network.node(1)->program.has_value());
}

TEST_F(ProgramMark, OfAnotherProgramReplacesItWhereverTheNodeStands) {
    for (const uint32_t other : {0u, 0xffffffffu, mark_of(kWords) ^ 1}) {
        adopt();
        bus.forget();
        come_back();
        tells(other);
        bus.state(1, 3, 3);
        EXPECT_EQ(bus.told<ProgramReplaced>().size(), 1u) << other;
        EXPECT_FALSE(bus.network.node(1)->program.has_value());
    }
}

TEST_F(ProgramMark, IsForgottenWithTheFirstWordOfAnotherProgram) {
    tells(5);
    aesl::Program program;
    program.bytecode = kWords;
    ASSERT_TRUE(bus.network.load(1, program).ok());
    EXPECT_EQ(told(), std::nullopt);
    tells(5);  // late, and nobody asked any more
    EXPECT_EQ(told(), std::nullopt);
}

TEST_F(ProgramMark, IsNotAskedOfANodeWithoutIt) {
    for (const auto& [name, words] : {std::pair{"_program", 1}, std::pair{"other", 2}}) {
        bus.network.link_lost();
        bus.node_says(kPresent1);
        describe(name, static_cast<uint16_t>(words));
        EXPECT_EQ(bus.network.ask_program(1).error().code, Code::NotFound) << name;
    }
}

// ---- after a load ----

constexpr const char* kShortUpload =
    "10 00 00 00 01 a0 01 00 00 00 03 00 ff ff 03 00 01 10 64 40 00 00";

class LoadedMark : public ProgramMark {
protected:
    void SetUp() override {
        ProgramMark::SetUp();
        bus.state(1, 0, 2);
        tells(0);
        bus.forget();
    }
    RequestId load(AfterLoad then = AfterLoad::Run) {
        aesl::Program program;
        program.bytecode = kWords;
        program.lines.resize(kWords.size());
        return bus.network.load(1, program, then).value();
    }
    std::optional<std::string> end_of(RequestId request) {
        for (const RequestDone& done : bus.told<RequestDone>()) {
            if (done.request == request) return done.error ? done.error->what : "";
        }
        return std::nullopt;
    }
};

TEST_F(LoadedMark, IsAskedForBeforeTheProgramRuns) {
    const RequestId request = load();
    EXPECT_EQ(bus.sent(), Dumps{kShortUpload});
    bus.state(1, 3, 3);
    EXPECT_EQ(bus.sent(), Dumps{kAsk});
    EXPECT_FALSE(bus.network.node(1)->program.has_value());
    tells(mark_of(kWords));
    EXPECT_EQ(bus.sent(), (Dumps{kClearAll, kRun}));
    bus.state(1, 3, 1);
    EXPECT_EQ(end_of(request), "");
}

TEST_F(LoadedMark, ThatIsAnotherMakesTheHostLoadAgain) {
    const RequestId request = load(AfterLoad::Stay);
    bus.state(1, 3, 3);
    bus.sent();
    tells(mark_of(kWords) ^ 1);
    EXPECT_EQ(bus.sent(), Dumps{kShortUpload});
    bus.state(1, 3, 3);
    EXPECT_EQ(bus.sent(), Dumps{kAsk});
    tells(mark_of(kWords));
    EXPECT_EQ(bus.sent(), Dumps{kClearAll});
    EXPECT_EQ(end_of(request), "");
    EXPECT_TRUE(bus.network.node(1)->program.has_value());
}

TEST_F(LoadedMark, ThatStaysAnotherEndsTheLoadAndNothingRuns) {
    const RequestId request = load();
    for (int i = 0; i < kLoadsMax; i++) {
        EXPECT_EQ(bus.sent(), Dumps{kShortUpload}) << i;
        bus.state(1, 3, 3);
        EXPECT_EQ(bus.sent(), Dumps{kAsk}) << i;
        EXPECT_EQ(end_of(request), std::nullopt) << i;
        tells(0x00001234);
    }
    EXPECT_EQ(bus.sent(), Dumps{});
    EXPECT_EQ(
        end_of(request),
        "node 1 \"robot\" does not have the program that was sent to it 3 times: expected the "
        "checksum 45ae6190, it tells 00001234. Its line loses or changes bytes, or another "
        "host loads it, too; the program was not run. Look at cable and baud rate, then load "
        "it again");
    EXPECT_FALSE(bus.network.node(1)->program.has_value());
}

TEST_F(LoadedMark, IsAskedForAgainWhenItWasLost) {
    load();
    bus.state(1, 3, 3);
    bus.sent();
    bus.pass(kAskAgain);
    EXPECT_EQ(bus.sent(), Dumps{kAsk});
    bus.node_says(kPresent1);  // it is there, but does not answer
    // Nobody waits for that for ever: it answered all pieces.
    bus.pass(kAnswerWithin - kAskAgain);
    EXPECT_EQ(bus.sent(), (Dumps{kClearAll, kRun}));
}

// A state that somebody else asked for does not end the load.
TEST_F(LoadedMark, IsWaitedForWhateverStateComes) {
    const RequestId request = load();
    bus.state(1, 3, 3);
    bus.sent();
    bus.state(1, 3, 1);
    EXPECT_EQ(end_of(request), std::nullopt);
    tells(mark_of(kWords));
    EXPECT_EQ(bus.sent(), (Dumps{kClearAll, kRun}));
}

}  // namespace
}  // namespace vagus::debug
