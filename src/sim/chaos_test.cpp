// Faults as data: what a line does to frames, how they are read and written, drawn and told. What
// they do to nodes is in chaos_world_test.cpp.
#include "sim/chaos.hpp"

#include <gtest/gtest.h>

#include "sim/chaos_clock.hpp"
#include "sim/chaos_file.hpp"
#include "sim/chaos_line.hpp"
#include "sim/host_chaos.hpp"

namespace vagus::sim {
namespace {

using namespace std::chrono_literals;

wire::Frame numbered_frame(uint16_t number) {
    wire::Frame frame{};
    frame.type = number;
    return frame;
}

// The numbers of what comes through by `now`.
std::vector<int> taken(ChaosLine& line, Time now) {
    std::vector<int> numbers;
    wire::Frame frame;
    while (line.take(frame, now)) numbers.push_back(frame.type);
    return numbers;
}

void put(ChaosLine& line, const std::vector<int>& numbers, Time now) {
    for (const int number : numbers) line.put(numbered_frame(static_cast<uint16_t>(number)), now);
}

using Numbers = std::vector<int>;

TEST(ChaosLines, WithoutFaultsPassAllAtOnce) {
    ChaosLine line;
    EXPECT_TRUE(line.is_plain());
    put(line, {1, 2, 3}, 5ms);
    EXPECT_EQ(taken(line, 5ms), (Numbers{1, 2, 3}));
}

TEST(ChaosLines, LoseDoubleAndCut) {
    const ChaosFault lost{.kind = ChaosKind::Lost};
    const ChaosFault doubled{.kind = ChaosKind::Doubled};
    const ChaosFault cut{.kind = ChaosKind::Unplugged};
    ChaosLine line;
    line.begin(doubled, 1);
    put(line, {1, 2}, 0ms);
    EXPECT_EQ(taken(line, 0ms), (Numbers{1, 1, 2, 2}));
    line.begin(lost, 1);
    put(line, {3}, 1ms);
    EXPECT_EQ(taken(line, 1s), Numbers{});
    line.end(lost);
    line.end(doubled);
    line.begin(cut, 1);
    put(line, {4}, 2ms);
    line.end(cut);
    put(line, {5}, 3ms);
    EXPECT_EQ(taken(line, 1s), Numbers{5});
    EXPECT_TRUE(line.is_plain());
}

TEST(ChaosLines, DelayKeepsTheOrderAlsoWhenItEnds) {
    const ChaosFault late{.kind = ChaosKind::Delayed, .by = 0.2};
    ChaosLine line;
    line.begin(late, 1);
    put(line, {1}, 100ms);
    put(line, {2}, 150ms);
    line.end(late);
    put(line, {3}, 160ms);  // waits behind the second, until 350 ms
    EXPECT_EQ(taken(line, 299ms), Numbers{});
    EXPECT_EQ(taken(line, 300ms), Numbers{1});
    EXPECT_EQ(taken(line, 349ms), Numbers{});
    EXPECT_EQ(taken(line, 350ms), (Numbers{2, 3}));
}

TEST(ChaosLines, UnpluggingLosesWhatIsOnItsWay) {
    const ChaosFault late{.kind = ChaosKind::Delayed, .by = 0.2};
    const ChaosFault cut{.kind = ChaosKind::Unplugged};
    ChaosLine line;
    line.begin(late, 1);
    put(line, {1}, 0ms);
    line.begin(cut, 1);
    EXPECT_EQ(taken(line, 1s), Numbers{});
}

TEST(ChaosLines, HoldBackAtMostSoLong) {
    const uint64_t seed = 20261126;
    RecordProperty("seed", std::to_string(seed));
    const ChaosFault mixed{.kind = ChaosKind::Reordered, .chance = 0.5, .by = 0.05};
    ChaosLine line;
    line.begin(mixed, seed);
    Numbers sent;
    for (int i = 0; i < 100; ++i) sent.push_back(i);
    put(line, sent, 0ms);
    Numbers got = taken(line, 0ms);
    EXPECT_TRUE(std::ranges::is_sorted(got));  // those that are not held back
    const Numbers late = taken(line, 50ms);
    EXPECT_FALSE(std::ranges::is_sorted(late)) << "seed " << seed;
    got.insert(got.end(), late.begin(), late.end());
    std::ranges::sort(got);
    EXPECT_EQ(got, sent);
}

// 10,000 frames, 3,000 of which are lost: six standard deviations are 275.
TEST(ChaosLines, LoseTheShareThatWasAskedFor) {
    for (const uint64_t seed : {1u, 2u, 3u}) {
        const ChaosFault lost{.kind = ChaosKind::Lost, .chance = 0.3};
        ChaosLine line;
        line.begin(lost, seed);
        for (int i = 0; i < 10'000; ++i) line.put(numbered_frame(1), 0ms);
        EXPECT_NEAR(static_cast<double>(taken(line, 0ms).size()), 7000, 275) << "seed " << seed;
    }
}

TEST(ChaosLines, HaveRoomForSoManyFrames) {
    const ChaosFault late{.kind = ChaosKind::Slow, .by = 1};
    ChaosLine line;
    line.begin(late, 1);
    for (size_t i = 0; i <= kChaosWaitingMax; ++i) line.put(numbered_frame(1), 0ms);
    EXPECT_EQ(taken(line, 1s).size(), kChaosWaitingMax);
}

TEST(ChaosClocks, TellBeginningsAndEndsByTime) {
    const std::vector<ChaosFault> faults = {
        {.kind = ChaosKind::Lost, .from = 2s, .until = 3s},
        {.kind = ChaosKind::Hung, .from = 1s},
        {.kind = ChaosKind::Reset, .from = 2s},
        {.kind = ChaosKind::Dead, .from = 2s},  // never ends
    };
    ChaosClock clock(faults);
    std::vector<std::pair<int, Time>> told;  // begins: the number of the fault; ends: minus that
    const auto all_by = [&](Time now) {
        while (const auto edge = clock.next(now)) {
            const int number = static_cast<int>(edge->fault - faults.data()) + 1;
            told.emplace_back(edge->begins ? number : -number, edge->at);
        }
    };
    all_by(999ms);
    EXPECT_TRUE(told.empty());
    all_by(10s);
    const std::vector<std::pair<int, Time>> expected = {{2, 1s}, {-2, 1100ms}, {1, 2s},
                                                        {3, 2s}, {4, 2s},      {-1, 3s}};
    EXPECT_EQ(told, expected);
}

TEST(HostChaosLines, AreThoseOfTheNamedComputer) {
    const std::vector<ChaosFault> faults = {{.kind = ChaosKind::Lost, .where = "drive"},
                                            {.kind = ChaosKind::Lost, .where = "main", .from = 1s}};
    HostChaos chaos(faults, "main", 1);
    chaos.advance(999ms);
    EXPECT_TRUE(chaos.to_bus().is_plain());
    chaos.advance(1s);
    chaos.to_bus().put(numbered_frame(1), 1s);
    chaos.from_bus().put(numbered_frame(1), 1s);
    EXPECT_EQ(taken(chaos.to_bus(), 2s), Numbers{});
    EXPECT_EQ(taken(chaos.from_bus(), 2s), Numbers{});
    EXPECT_TRUE(HostChaos(faults, "r1/main", 1).empty());
}

// ---- files ----

std::string wrong(std::string_view text) {
    const auto chaos = read_chaos(text, "a.json");
    return chaos.ok() ? "" : chaos.error().what;
}

constexpr std::string_view kAll =
    R"([{ "kind": "lost", "link": "main", "from": 1, "until": 2.5, "chance": 0.25 }, )"
    R"({ "kind": "doubled", "link": "drive", "from": 1 }, )"
    R"({ "kind": "delayed", "link": "drive", "from": 1, "by": 0.2 }, )"
    R"({ "kind": "reordered", "link": "drive", "from": 1, "by": 0.05, "seed": 7 }, )"
    R"({ "kind": "reset", "node": "drive", "at": 3 }, )"
    R"({ "kind": "hung", "node": "carbot/drive", "at": 3.25 }, )"
    R"({ "kind": "unplugged", "node": "drive", "from": 0 }, )"
    R"({ "kind": "stuck", "node": "range", "sensor": "sonar.distance", "from": 4 }, )"
    R"({ "kind": "noisy", "node": "range", "sensor": "sonar.distance", "from": 4, "by": 30 }, )"
    R"({ "kind": "dead", "node": "range", "sensor": "sonar.distance", "from": 4 }, )"
    R"({ "kind": "slow", "from": 5, "until": 6, "by": 0.1 }])";

TEST(ChaosFiles, AreWrittenAsTheyAreRead) {
    const auto chaos = read_chaos(kAll, "a.json");
    ASSERT_TRUE(chaos.ok()) << chaos.error().what;
    EXPECT_EQ(chaos.value().faults.size(), chaos_kinds().size());
    EXPECT_EQ(format_chaos(chaos.value().faults), kAll);
    const auto inside = read_chaos("{ \"x\": 1, \"chaos\": " + std::string(kAll) + " }", "b.json");
    ASSERT_TRUE(inside.ok()) << inside.error().what;
    EXPECT_EQ(format_chaos(inside.value().faults), kAll);
}

TEST(ChaosFiles, SayWhatIsWrongAndWhere) {
    EXPECT_EQ(wrong("{}").substr(0, 48), "a.json:1:1: expected a list of faults, or an obj");
    EXPECT_EQ(wrong(R"([{"kind":"lots"}])").substr(0, 25), "a.json:1:10: \"kind\" of fa");
    EXPECT_NE(wrong(R"([{"kind":"lost","node":"drive","from":1}])").find("\"link\""),
              std::string::npos);
    EXPECT_NE(wrong(R"([{"kind":"reset","node":"drive","from":1}])").find("\"at\""),
              std::string::npos);
    EXPECT_EQ(wrong(R"([{"kind":"dead","node":"a","sensor":"b","from":3,"until":3}])"),
              "a.json:1:58: \"until\" of fault 1: expected a time behind \"from\", 3 s, found 3; "
              "leave \"until\" out if it lasts to the end");
    EXPECT_NE(wrong(R"([{"kind":"lost","link":"a","from":3,"chance":1.5}])").find("chance"),
              std::string::npos);
    EXPECT_NE(wrong(R"([{"kind":"slow","from":3}])").find("by"), std::string::npos);
    EXPECT_NE(wrong(R"([{"kind":"slow","from":3,"by":60.5}])").find("by"), std::string::npos);
    EXPECT_NE(wrong(R"([{"kind":"noisy","node":"a","sensor":"b","from":3,"by":32768}])").find("by"),
              std::string::npos);
    EXPECT_NE(wrong(R"([{"kind":"slow","from":1000001,"by":1}])").find("from"), std::string::npos);
}

TEST(ChaosFiles, HoldSoManyFaults) {
    const auto list = [](size_t count) {
        std::vector<ChaosFault> faults(count, {.kind = ChaosKind::Reset, .where = "a"});
        return format_chaos(faults);
    };
    EXPECT_EQ(wrong(list(kChaosFaultsMax)), "");
    EXPECT_EQ(wrong(list(kChaosFaultsMax + 1)),
              "a.json:1:1: \"chaos\": expected at most 1000 faults, found 1001; leave some out");
}

TEST(ChaosKinds, AreReadByTheirNames) {
    const auto kinds = parse_chaos_kinds("lost,slow");
    ASSERT_TRUE(kinds.ok());
    EXPECT_EQ(kinds.value(), (std::vector{ChaosKind::Lost, ChaosKind::Slow}));
    EXPECT_EQ(parse_chaos_kinds("lost,hnug").error().what,
              "there is no kind of fault \"hnug\"; did you mean hung?");
}

TEST(ChaosSentences, AreForPeople) {
    const auto faults = read_chaos(kAll, "a.json").value().faults;
    EXPECT_EQ(began_sentence(faults[0]), "the link of the main computer loses 25 % of its frames");
    EXPECT_EQ(ended_sentence(faults[0]), "the link of the main computer works again");
    EXPECT_EQ(began_sentence(faults[1]), "the link of drive doubles all of its frames");
    EXPECT_EQ(began_sentence(faults[2]), "the link of drive is 0.2 s late");
    EXPECT_EQ(began_sentence(faults[3]),
              "the link of drive holds back all of its frames, by up to 0.05 s");
    EXPECT_EQ(began_sentence(faults[5]), "carbot/drive hangs");
    EXPECT_EQ(ended_sentence(faults[5]), "the watchdog of carbot/drive resets it");
    EXPECT_EQ(ended_sentence(faults[6]), "drive is plugged in again");
    EXPECT_EQ(began_sentence(faults[8]), "sonar.distance of range is noisy, by 30");
    EXPECT_EQ(began_sentence(faults[10]), "the main computer is slow, by 0.1 s");
}

// ---- random sets ----

const std::vector<ChaosTarget> kTargets = {{"drive", {"wheel.front.speed"}},
                                           {"range", {"sonar.distance", "rotator.angle"}}};

TEST(ChaosDraws, AreTheSameForTheSameSeed) {
    const ChaosDraw draw{.count = 20};
    const std::string drawn = format_chaos(draw_chaos(kTargets, draw, 7));
    EXPECT_EQ(format_chaos(draw_chaos(kTargets, draw, 7)), drawn);
    EXPECT_NE(format_chaos(draw_chaos(kTargets, draw, 8)), drawn);
    EXPECT_EQ(format_chaos(draw_chaos(kTargets, {.count = 20, .seed = 7}, 8)), drawn);
}

TEST(ChaosDraws, AreWhatAFileMaySay) {
    for (uint64_t seed = 1; seed <= 200; ++seed) {
        const auto faults = draw_chaos(kTargets, {.count = 5, .within = 3s}, seed);
        ASSERT_EQ(faults.size(), 5u);
        const std::string text = format_chaos(faults);
        const auto again = read_chaos(text, "drawn");
        ASSERT_TRUE(again.ok()) << "seed " << seed << ": " << again.error().what;
        EXPECT_EQ(format_chaos(again.value().faults), text);
        for (const ChaosFault& fault : faults) EXPECT_LE(fault.from, 3s) << "seed " << seed;
    }
}

TEST(ChaosDraws, AreOfTheKindsThatWereNamed) {
    const ChaosDraw draw{.count = 50, .kinds = {ChaosKind::Hung, ChaosKind::Dead}};
    for (const ChaosFault& fault : draw_chaos(kTargets, draw, 1)) {
        EXPECT_TRUE(fault.kind == ChaosKind::Hung || fault.kind == ChaosKind::Dead);
    }
    EXPECT_TRUE(draw_chaos({{"a", {}}}, {.count = 5, .kinds = {ChaosKind::Dead}}, 1).empty());
    EXPECT_TRUE(draw_chaos({}, {.count = 5}, 1).empty());
}

TEST(ChaosSensors, AreNotWhatScriptsAndPeopleSet) {
    for (const char* const name : {"prox.horizontal", "sonar.distance", "acc", "touch.count",
                                   "motor.left.speed", "infrared.intensity", "prox"}) {
        EXPECT_TRUE(is_sensor(name)) << name;
    }
    for (const char* const name :
         {"_id", "id", "event.args", "motor.left.target", "button.center", "timer.period",
          "motion.state", "speed.left", "prox.comm.tx", "_program", "energy"}) {
        EXPECT_FALSE(is_sensor(name)) << name;
    }
}

}  // namespace
}  // namespace vagus::sim
