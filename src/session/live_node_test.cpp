#include "session/live_node.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "session/standard_target.hpp"
#include "wire/messages.hpp"

namespace vagus::session {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr uint16_t kPeriod = 35;   // address of timer.period: 1 + 1 + 32 + 1
constexpr uint16_t kCounter = 38;  // the script's, behind _program

TEST(NodeTimer, NeverRunsOutWithoutAPeriod) {
    NodeTimer timer;
    EXPECT_FALSE(timer.elapsed(1h));
    timer.set_period(-5, 0ms);  // D18
    EXPECT_FALSE(timer.elapsed(1h));
    EXPECT_EQ(timer.next(), Time::max());
}

TEST(NodeTimer, RunsOutEveryPeriod) {
    NodeTimer timer;
    timer.set_period(10, 5ms);
    EXPECT_FALSE(timer.elapsed(14ms));
    EXPECT_TRUE(timer.elapsed(15ms));
    EXPECT_FALSE(timer.elapsed(15ms));
    EXPECT_TRUE(timer.elapsed(26ms));
    EXPECT_EQ(timer.next(), 35ms);  // no drift
}

TEST(NodeTimer, MissedPeriodsAreOneEvent) {
    NodeTimer timer;
    timer.set_period(10, 0ms);
    EXPECT_TRUE(timer.elapsed(95ms));
    EXPECT_FALSE(timer.elapsed(96ms));
    EXPECT_EQ(timer.next(), 105ms);
}

TEST(NodeTimer, NewPeriodCountsFromNowTheSameOneDoesNot) {
    NodeTimer timer;
    timer.set_period(10, 0ms);
    timer.set_period(10, 9ms);
    EXPECT_EQ(timer.next(), 10ms);
    timer.set_period(20, 9ms);
    EXPECT_EQ(timer.next(), 29ms);
    timer.set_period(0, 9ms);
    EXPECT_EQ(timer.next(), Time::max());
}

wire::Frame command(uint16_t type, std::vector<uint16_t> words) {
    wire::Frame frame{.size = 0, .source = 0, .type = type, .payload = {}};
    for (const uint16_t word : words) {
        frame.payload[frame.size++] = static_cast<uint8_t>(word & 0xff);
        frame.payload[frame.size++] = static_cast<uint8_t>(word >> 8);
    }
    return frame;
}

constexpr uint16_t kSetBytecode = 0xa001;
constexpr uint16_t kRun = 0xa003;
constexpr uint16_t kGetState = 0xa007;
constexpr uint16_t kSave = 0xa00d;
constexpr uint16_t kProgram = 36;  // address of _program, behind timer.period

class Live : public testing::Test {
protected:
    std::unique_ptr<LiveNode> node(const std::string& flash = {}) {
        LiveNodeOptions options{.id = 3, .flash = flash};
        options.transmit = [this](const wire::Frame& frame) { sent_.push_back(frame); };
        auto made = LiveNode::make(standard_target("dummynode-2"), std::move(options));
        EXPECT_TRUE(made.ok()) << made.error().what;
        return std::move(made.value());
    }
    static void upload(LiveNode& live, std::vector<uint16_t> program) {
        program.insert(program.begin(), {3, 0});  // dest, start
        live.receive(command(kSetBytecode, program));
        live.receive(command(kRun, {3}));
    }
    // The text of the last message.
    std::string last_text() const {
        wire::NodeSpecificError error{};
        EXPECT_EQ(wire::decode_message(sent_.back(), error), wire::Error::None);
        return {error.text.bytes, error.text.size};
    }

    test::Folder folder_;
    std::vector<wire::Frame> sent_;
};

// timer @5: counter = counter + 1; stop. init @10: timer.period = 10; stop.
const std::vector<uint16_t> kCounting = {5,      0xfffe, 5, 0xffff, 10,     0x3026, 0x1001,
                                         0x8002, 0x4026, 0, 0x100a, 0x4023, 0};

TEST_F(Live, KnowsItsId) {
    EXPECT_EQ(node()->node().variables()[0], 3);
}

TEST_F(Live, TimerRunsItsHandler) {
    const auto live = node();
    EXPECT_EQ(live->step(0ms), Time::max());
    upload(*live, kCounting);
    EXPECT_EQ(live->step(100ms), 110ms);
    EXPECT_EQ(live->step(110ms), 120ms);
    EXPECT_EQ(live->step(125ms), 130ms);
    EXPECT_EQ(live->node().variables()[kCounter], 2);
    live->node().variables()[kPeriod] = -1;
    EXPECT_EQ(live->step(130ms), Time::max());
    EXPECT_EQ(live->node().variables()[kCounter], 2);
}

TEST_F(Live, EndlessScriptRunsAThousandInstructionsAMillisecond) {
    const auto live = node();
    // init @3: counter = counter + 1; jump back: five instructions a turn
    upload(*live, {3, 0xffff, 3, 0x3026, 0x1001, 0x8002, 0x4026, 0x9ffc});
    const int16_t before = live->node().variables()[kCounter];
    EXPECT_EQ(live->step(50ms), 51ms);
    EXPECT_EQ(live->node().variables()[kCounter], before + 200);
}

TEST_F(Live, PausedScriptWaitsForItsHost) {
    const auto live = node();
    std::vector<uint16_t> words = {3, 0, 3, 0xffff, 3, 0x9000};
    live->receive(command(kSetBytecode, words));  // paused inside init
    EXPECT_EQ(live->step(50ms), Time::max());
}

TEST_F(Live, SavedProgramRunsAgainAfterARestartWithoutAHost) {
    const std::string flash = (folder_ / "three.abo").string();
    {
        const auto live = node(flash);
        upload(*live, kCounting);
        live->receive(command(kSave, {3}));
        EXPECT_EQ(last_text(), "Flashing OK");
    }
    const auto again = node(flash);
    EXPECT_EQ(again->step(0ms), 10ms);
    again->step(10ms);
    EXPECT_EQ(again->node().variables()[kCounter], 1);
}

// Also with zeros at its end, and with a `when` that remembers in its words.
TEST_F(Live, ASavedProgramIsTheSameProgramAfterARestart) {
    const std::string flash = (folder_ / "three.abo").string();
    const auto told = [](LiveNode& live) {
        live.receive(command(kGetState, {3}));
        const auto words = live.node().variables().subspan(kProgram, 2);
        return std::vector<int16_t>(words.begin(), words.end());
    };
    const auto first = node(flash);
    EXPECT_THAT(told(*first), ElementsAre(0, 0));
    // init: when 1 == 1 do end
    upload(*first, {3, 0xffff, 3, 0x1001, 0x1001, 0xa10a, 2, 0, 0});
    first->step(0ms);
    first->receive(command(kSave, {3}));
    EXPECT_EQ(last_text(), "Flashing OK");
    const auto mark = told(*first);
    EXPECT_NE(mark, (std::vector<int16_t>{0, 0}));
    EXPECT_EQ(told(*node(flash)), mark);
}

TEST_F(Live, ADamagedFlashFileCostsTheProgramNotTheNode) {
    const std::string flash = (folder_ / "three.abo").string();
    {
        const auto live = node(flash);
        upload(*live, kCounting);
        live->receive(command(kSave, {3}));
    }
    std::filesystem::resize_file(flash, 20);
    const auto again = node(flash);
    EXPECT_THAT(again->flash_trouble(), HasSubstr("three.abo"));
    EXPECT_THAT(again->flash_trouble(), HasSubstr("starts without a program"));
    EXPECT_EQ(again->step(0ms), Time::max());
    upload(*again, kCounting);
    again->receive(command(kSave, {3}));
    EXPECT_EQ(last_text(), "Flashing OK");
    EXPECT_EQ(node(flash)->flash_trouble(), "");
}

TEST_F(Live, SavingLeavesNothingBesideTheFlashFile) {
    const std::string flash = (folder_ / "three.abo").string();
    const auto live = node(flash);
    upload(*live, kCounting);
    for (int i = 0; i < 3; i++) live->receive(command(kSave, {3}));
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        EXPECT_EQ(entry.path(), flash);
        files++;
    }
    EXPECT_EQ(files, 1u);
}

TEST_F(Live, WithoutAFlashFileItSaysThatNothingIsKept) {
    const auto live = node();
    live->receive(command(kSave, {3}));
    EXPECT_THAT(last_text(), HasSubstr("without --flash"));
}

TEST_F(Live, AFlashFileThatCannotBeWrittenIsReported) {
    const std::string flash = (folder_ / "gone" / "three.abo").string();
    const auto live = node(flash);
    live->receive(command(kSave, {3}));
    EXPECT_THAT(last_text(), testing::StartsWith("Flashing failed: "));
}

TEST(StandardTarget, IsTheDummyNodeOfTheSpecification) {
    const aesl::Target target = standard_target("dummynode-0");
    uint16_t described = 0;
    for (const auto& variable : target.variables)
        described = static_cast<uint16_t>(described + variable.size);
    EXPECT_EQ(described, 36);
    EXPECT_EQ(target.natives.size(), 30u);
    EXPECT_EQ(target.natives[22].name, "deque.get");
    EXPECT_EQ(target.natives[22].parameters[1].size, -2);
}

}  // namespace
}  // namespace vagus::session
