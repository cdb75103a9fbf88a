// Expected values are worked out by hand from what is told.
#include "serve/history/history.hpp"

#include <gtest/gtest.h>

#include <array>

#include "base/base64.hpp"
#include "plan/file.hpp"
#include "serve/follow/sights.hpp"
#include "serve/json.hpp"

namespace vagus::serve {
namespace {

constexpr const char* kPlan = R"({"format":"vagus-plan/1","name":"Walk",
  "configuration":{"steps":{"type":"int","initial":3}},
  "start":{"actor":"go","supervisors":{"guard":{"template":"OnEvent","in":{"event":"'x'"},
    "events":{"Received":"stop"}}}},
  "actors":{
    "go":{"template":"Wait","in":{"seconds":"1"},"states":{"Done":"stop"},
      "supervisors":{"near":{"template":"OnEvent","in":{"event":"'y'"},
        "events":{"Received":"stop"}}}},
    "stop":{"template":"Wait","in":{"seconds":"1"},"states":{"Done":"@terminate"}}}})";

PlanPast::Plans walk() {
    const plan::PlanFile read = plan::parse_plan(kPlan, "Walk.plan.json");
    EXPECT_TRUE(read.readable);
    return outlines_of({read.plan});
}

std::string one(double t, uint16_t node, uint16_t address, int16_t value) {
    RecordWriter writer;
    writer.begin(t);
    writer.words(node, address, {&value, 1});
    return writer.take();
}

TEST(Record, AnInstantThatSaysNothingIsLeftOut) {
    RecordWriter writer;
    writer.begin(1);
    EXPECT_EQ(writer.take(), "");
    writer.begin(2);
    writer.pose(7, 1, 2, 3);
    // Size 4, time 8, kind 1, key 4, three floats 12.
    EXPECT_EQ(writer.take().size(), 29u);
}

TEST(Record, WhatWasCutIsNoRecordAndNothingOfItIsKept) {
    const std::string whole = one(1, 2, 3, 4);
    for (size_t size = 1; size < whole.size(); ++size) {
        Tape tape;
        EXPECT_FALSE(tape.record(whole.substr(0, size))) << size;
        EXPECT_TRUE(tape.empty());
    }
    Tape tape;
    EXPECT_FALSE(tape.record(whole + "x"));
    EXPECT_TRUE(tape.empty());
}

TEST(Tape, AWordHoldsUntilItsNextValueAndIsUnknownBefore) {
    Tape tape;
    ASSERT_TRUE(tape.record(one(1, 5, 10, 100)));
    ASSERT_TRUE(tape.record(one(2, 5, 10, 200)));
    EXPECT_EQ(tape.at(0.999).word(5, 10), std::nullopt);
    EXPECT_EQ(tape.at(1).word(5, 10), 100);
    EXPECT_EQ(tape.at(1.999).word(5, 10), 100);
    EXPECT_EQ(tape.at(2).word(5, 10), 200);
    EXPECT_EQ(tape.at(2).word(5, 11), std::nullopt);
    EXPECT_EQ(tape.at(2).word(6, 10), std::nullopt);
}

TEST(Tape, WhatNobodyWatchesAnyMoreIsNotKnown) {
    History history;
    history.begin({.kind = "bus"});
    const std::array<int16_t, 2> values = {1, 2};
    history.words(1, 5, 10, values);
    history.forget(2, 5, 11, 1);
    const Json found = history.at({.t = 3, .ranges = {{5, 10, 2}}});
    EXPECT_EQ(found["t"], 2);  // nothing is known of later
    EXPECT_EQ(found["values"][0]["words"], Json({1, nullptr}));
}

TEST(Tape, AColumnHasTheLowestAndTheHighestValueOfItsTime) {
    Tape tape;
    // 0 to 4 s in four columns. 7 from 0.5 on; -3 for a moment at 1.5; then 9; the end is at 3.
    for (const auto& [t, value] :
         std::vector<std::pair<double, int16_t>>{{0.5, 7}, {1.5, -3}, {1.6, 9}, {3.0, 9}}) {
        ASSERT_TRUE(tape.record(one(t, 1, 0, value)));
    }
    const auto columns = tape.columns(1, 0, {0, 4, 4});
    ASSERT_EQ(columns.size(), 4u);
    EXPECT_EQ(columns[0].low, 7);
    EXPECT_EQ(columns[0].high, 7);
    EXPECT_EQ(columns[1].low, -3);
    EXPECT_EQ(columns[1].high, 9);
    EXPECT_EQ(columns[2].low, 9);
    EXPECT_EQ(columns[2].high, 9);
    EXPECT_EQ(columns[3].low, 9);
    // A window that begins after the last change shows what holds.
    EXPECT_EQ(tape.columns(1, 0, {2, 3, 1})[0].low, 9);
}

TEST(Tape, WhatIsOlderThanTenMinutesIsThinnedToFiveInstantsASecond) {
    Tape tape;
    // A value every 10 ms, at 5 ms, 15 ms, …, that says its hundredths of a second; 615 s.
    for (int i = 0; i <= 61'500; ++i) {
        ASSERT_TRUE(tape.record(one(i / 100.0 + 0.005, 1, 0, static_cast<int16_t>(i % 30'000))));
    }
    // The blocks that ended before 15 s: the first, 0 to 10 s.
    EXPECT_EQ(tape.fine_from(), 10.005);
    EXPECT_EQ(tape.from(), 0.005);
    // Until a step has ended, what is told is the end of the one before: 4.9 s lies in the step
    // from 4.8 s, and the one before ended at 4.795 s.
    EXPECT_EQ(tape.at(4.9).word(1, 0), 479);
    EXPECT_EQ(tape.at(12.34).word(1, 0), 1233);  // of 12.335 s
}

TEST(Tape, WhatIsOlderThanAnHourIsGone) {
    Tape tape;
    for (int t = 0; t <= 3620; t += 5) ASSERT_TRUE(tape.record(one(t, 1, 0, 1)));
    // Blocks of 10 s hold the seconds 0 and 5, 10 and 15, …; 3620 - 3600 = 20: those that ended
    // at 5 and 15 are gone.
    EXPECT_EQ(tape.from(), 20);
    EXPECT_EQ(tape.at(19).word(1, 0), std::nullopt);
    EXPECT_EQ(tape.at(20).word(1, 0), 1);
}

// All 4096 words change each time: 8 KiB an instant.
void flood(Tape& tape, int instants, double step) {
    for (int i = 0; i < instants; ++i) {
        const std::vector<int16_t> words(4096, static_cast<int16_t>(i));
        RecordWriter writer;
        writer.begin((i + 0.5) * step);
        writer.words(1, 0, words);
        ASSERT_TRUE(tape.record(writer.take()));
        ASSERT_LE(tape.bytes(), kTapeBytes);
    }
}

TEST(Tape, AFloodIsThinnedOutBeforeAnythingIsDropped) {
    Tape tape;
    flood(tape, 10'000, 0.02);  // 80 MiB in 200 s
    EXPECT_EQ(tape.from(), 0.01);
    EXPECT_GT(tape.fine_from(), 10);
    EXPECT_EQ(tape.at(200).word(1, 17), 9999);
    // The step before 5.2 s ended with the instant of 5.19 s, that of number 259.
    EXPECT_EQ(tape.at(5.21).word(1, 17), 259);
}

TEST(Tape, WhatCannotBeThinnedIsDroppedFromItsOldEnd) {
    Tape tape;
    flood(tape, 10'000, 0.25);  // 80 MiB, each instant a step of its own
    EXPECT_GT(tape.from(), 0);
    EXPECT_EQ(tape.at(2500).word(1, 4095), 9999);
    EXPECT_EQ(tape.at(tape.from() - 0.01).word(1, 0), std::nullopt);
}

std::string stand(double t, uint32_t robot, float x, float y) {
    RecordWriter writer;
    writer.begin(t);
    writer.pose(kRobotKey | robot, x, y, 0);
    return writer.take();
}

TEST(Tape, AWayHasAPlaceForEachCentimetreSinceItsBegin) {
    Tape tape;
    // Two blocks: the second begins 15 s later.
    ASSERT_TRUE(tape.record(stand(1, 0, 1, 1)));
    ASSERT_TRUE(tape.record(stand(2, 0, 1.004F, 1)));
    ASSERT_TRUE(tape.record(stand(3, 0, 1.02F, 1)));
    ASSERT_TRUE(tape.record(stand(3, 1, 5, 5)));
    ASSERT_TRUE(tape.record(stand(18, 0, 1.02F, 1.5F)));
    const auto ways = tape.ways(0, 20);
    ASSERT_EQ(ways.size(), 2u);
    EXPECT_EQ(ways.at(0),
              (std::deque<Tape::WayPoint>{{1, 1, 1}, {3, 1.02F, 1}, {18, 1.02F, 1.5F}}));
    EXPECT_EQ(ways.at(1), (std::deque<Tape::WayPoint>{{3, 5, 5}}));
    // From the middle: where it stood then, and what came after.
    EXPECT_EQ(tape.ways(2.5, 10).at(0),
              (std::deque<Tape::WayPoint>{{2.5, 1.004F, 1}, {3, 1.02F, 1}}));
}

TEST(Tape, OfALongWayTheNewestPlacesAreKept) {
    Tape tape;
    for (size_t i = 0; i <= kWayPointsMax; ++i) {
        const auto k = static_cast<float>(i);
        ASSERT_TRUE(tape.record(stand(0.1 * k, 0, 0.02F * k, 0)));
    }
    const auto way = tape.ways(0, 1e6).at(0);
    EXPECT_EQ(way.size(), kWayPointsMax);
    EXPECT_FLOAT_EQ(way.front().x, 0.02F);
    EXPECT_FLOAT_EQ(way.back().x, 0.02F * kWayPointsMax);
}

TEST(History, WaysAreToldInTenthsOfAMillimetre) {
    History history;
    history.begin({.kind = "simulated"});
    ASSERT_TRUE(history.record(stand(1.00049, 0, 0.123456F, 2)));
    EXPECT_EQ(history.ways(0, 2)["ways"], Json({{0, 1.0, 0.1235, 2.0}}));
}

TEST(EventPast, TheOldestGoFirstAndAreCounted) {
    EventPast past;
    for (size_t i = 0; i <= kPastEvents; ++i) {
        past.add({.t = static_cast<double>(i) * 0.001, .kind = "event", .name = "e"});
    }
    EXPECT_EQ(past.count(), kPastEvents);
    EXPECT_EQ(past.dropped(), 1u);
    EXPECT_LE(past.bytes(), kPastEventBytes);
    const Json last = past.until(0.0025, 10);
    // The first one, of 0 s, is gone: 1 ms and 2 ms are left.
    ASSERT_EQ(last.size(), 2u);
    EXPECT_EQ(last[0]["number"], 1);
    EXPECT_EQ(last[1]["t"], 0.002);
}

TEST(EventPast, DenseEventsAreARunAndFewAreMarks) {
    EventPast past;
    // 100 s on 100 pixels: a pixel is a second. Three at 10, 12, 14 are closer than 6 pixels.
    for (const double t : {10.0, 12.0, 14.0, 50.0, 80.0, 80.5}) {
        past.add({.t = t, .kind = "event", .source = "drive", .name = t > 80 ? "b" : "a"});
    }
    size_t left_out = 0;
    const auto lanes = past.lanes({0, 100, 100}, left_out);
    ASSERT_EQ(lanes.size(), 1u);
    EXPECT_EQ(left_out, 0u);
    EXPECT_EQ(lanes[0]["name"], "drive");
    EXPECT_EQ(lanes[0]["bars"],
              Json::array({{{"from", 10.0}, {"to", 14.0}, {"name", "a"}, {"count", 3}}}));
    EXPECT_EQ(lanes[0]["marks"],
              Json::array({{{"t", 50.0}, {"name", "a"}}, {{"t", 80.0}, {"count", 2}}}));
}

// ---- what sensors and cameras saw ----

std::string looks(double t, uint16_t robot, size_t count, char byte) {
    RecordWriter writer;
    writer.begin(t);
    writer.looks(robot, std::string(count * kLookBytes, byte));
    return writer.take();
}

TEST(Tape, LooksAndLampsOfAnInstantAreThePayloadOfTheTopic) {
    Tape tape;
    RecordWriter writer;
    writer.begin(1);
    writer.looks(1, std::string(2 * kLookBytes, 'b'));
    writer.lamps(0, std::string(kLampBytes, 'x'));
    ASSERT_TRUE(tape.record(writer.take()));
    ASSERT_TRUE(tape.record(looks(2, 0, 1, 'a')));
    ASSERT_TRUE(tape.record(looks(3, 1, 1, 'c')));
    const std::string none(4, '\0');
    EXPECT_EQ(tape.at(0.5).rays(), none);
    // Two looks and a lamp; then those of robot 0 come before those of robot 1.
    EXPECT_EQ(tape.at(1).rays(), std::string("\2\0\1\0", 4) + std::string(2 * kLookBytes, 'b') +
                                     std::string(kLampBytes, 'x'));
    EXPECT_EQ(tape.at(2.5).rays(), std::string("\3\0\1\0", 4) + std::string(kLookBytes, 'a') +
                                       std::string(2 * kLookBytes, 'b') +
                                       std::string(kLampBytes, 'x'));
    EXPECT_EQ(tape.at(3).rays(), std::string("\2\0\1\0", 4) + std::string(kLookBytes, 'a') +
                                     std::string(kLookBytes, 'c') + std::string(kLampBytes, 'x'));
    tape.cut(1.5);
    EXPECT_EQ(tape.at(3).rays(), tape.at(1).rays());
}

// One more than have room is left out; what is thinned out keeps its looks.
TEST(Tape, LooksAreKeptOfSoManyRobotsAndThroughThinning) {
    Tape tape;
    for (size_t robot = 0; robot <= kSightRobotsMax; ++robot) {
        ASSERT_TRUE(tape.record(looks(1, static_cast<uint16_t>(robot), 1, 'a')));
    }
    EXPECT_EQ(tape.at(1).rays().size(), 4 + kSightRobotsMax * kLookBytes);
    ASSERT_TRUE(tape.record(looks(1.5, 0, 1, 'z')));
    const std::string then = tape.at(2).rays();
    ASSERT_TRUE(tape.record(one(2 + kTapeFineSeconds + 2 * kTapeBlockSeconds, 1, 7, 3)));
    ASSERT_GT(tape.fine_from(), 2);
    EXPECT_EQ(tape.at(2).rays(), then);
}

TEST(PicturePast, ThePictureOfAnInstantIsTheLastOneAndNotAnOldOne) {
    PicturePast past;
    past.add({.t = 1, .robot = "a", .bytes = "1"});
    past.add({.t = 2, .robot = "b", .bytes = "2"});
    past.add({.t = 3, .robot = "a", .bytes = "3"});
    const auto seen = [&past](double t, const std::string& robot) {
        const KeptPicture* const found = past.at(t, robot);
        return found == nullptr ? std::string() : found->bytes;
    };
    EXPECT_EQ(seen(0.9, "a"), "");
    EXPECT_EQ(seen(1, "a"), "1");
    EXPECT_EQ(seen(2.9, "a"), "1");
    EXPECT_EQ(seen(2.9, "b"), "2");
    EXPECT_EQ(seen(3 + kPictureHolds, "a"), "3");
    EXPECT_EQ(seen(3.01 + kPictureHolds, "a"), "");
    EXPECT_EQ(seen(3, "c"), "");
    past.cut(2.5);
    EXPECT_EQ(seen(3, "a"), "1");
    EXPECT_EQ(past.bytes(), 2u);
}

TEST(PicturePast, WhatIsTooMuchIsThinnedOutFromTheOldEnd) {
    PicturePast past;
    const size_t fit = 8;
    const std::string picture(kPastPictureBytes / fit, 'x');
    for (size_t i = 0; i < fit; ++i) {
        past.add({.t = static_cast<double>(i), .robot = "a", .bytes = picture});
    }
    EXPECT_EQ(past.count(), fit);
    past.add({.t = 8, .robot = "a", .bytes = picture});
    // Of 0 to 8 the older half are 0 to 4, of which 0, 2 and 4 go.
    EXPECT_EQ(past.count(), 6u);
    EXPECT_EQ(past.bytes(), 6 * picture.size());
    EXPECT_EQ(past.at(0.5, "a"), nullptr);
    EXPECT_EQ(past.at(2.5, "a")->t, 1);
    EXPECT_EQ(past.at(4.5, "a")->t, 3);
    EXPECT_EQ(past.at(8.5, "a")->t, 8);
    past.add({.t = 1.5 + kPastPictureSeconds, .robot = "a", .bytes = "x"});
    EXPECT_EQ(past.at(2.5, "a"), nullptr);
    EXPECT_EQ(past.at(3.5, "a")->t, 3);
}

TEST(History, AnInstantHasWhatWasAskedForOfSensorsAndCameras) {
    History history;
    history.begin({.kind = "simulated"});
    ASSERT_TRUE(history.record(looks(1, 0, 1, 'a')));
    history.picture({.t = 1, .robot = "carbot", .bytes = "abc"});
    const Json plain = history.at({.t = 1});
    EXPECT_FALSE(plain.contains("rays"));
    EXPECT_FALSE(plain.contains("picture"));
    const Json found = history.at({.t = 1, .rays = true, .picture = "carbot"});
    EXPECT_EQ(from_base64(found["rays"].get<std::string>()),
              std::string("\1\0\0\0", 4) + std::string(kLookBytes, 'a'));
    EXPECT_EQ(found["picture"], "YWJj");
    EXPECT_EQ(found["picture_t"], 1.0);
    EXPECT_FALSE(history.at({.t = 1, .picture = "other"}).contains("picture"));
    history.continue_from(0.5, 2);
    EXPECT_FALSE(history.at({.t = 1, .picture = "carbot"}).contains("picture"));
}

TEST(EventPast, ANodeStandsWhereItSaidLast) {
    EventPast past;
    past.add({.t = 1, .kind = "state", .node = 3, .name = "running"});
    past.add({.t = 2, .kind = "state", .node = 3, .name = "paused", .line = 12});
    EXPECT_EQ(past.nodes_at(0.5), Json::array());
    EXPECT_EQ(past.nodes_at(1.5), Json::array({{{"node", 3}, {"state", "running"}}}));
    EXPECT_EQ(past.nodes_at(2), Json::array({{{"node", 3}, {"state", "paused"}, {"line", 12}}}));
}

// go from 0 to 1.5, when guard raises Received; it has stopped at 1.7, and stop runs to 2.7.
std::string line(const std::string& t, const std::string& rest) {
    return R"({"t":)" + t + R"(00000,"plan":"Walk","kind":)" + rest + "}";
}

const std::vector<std::string>& trace() {
    static const std::vector<std::string> lines = {
        line("0.0", R"("plan-start")"),
        line("0.0", R"("write","variable":"steps","value":3,"by":"initial")"),
        line("0.0", R"("actor-start","actor":"go","activation":1,"in":{"seconds":1.0})"),
        line("1.5", R"("event","supervisor":"guard","event":"Received","target":"stop",)"
                    R"("global":true,"activation":1)"),
        line("1.5", R"("write","variable":"steps","value":4,"by":"guard")"),
        line("1.7", R"("interrupted","actor":"go","activation":1,"ran":true,"stop_us":200000)"),
        line("1.7", R"("actor-start","actor":"stop","activation":2,"in":{})"),
        line("2.7", R"("actor-end","actor":"stop","activation":2,"state":"Done",)"
                    R"("target":"@terminate")"),
        line("2.7", R"("plan-end","result":"OK")"),
    };
    return lines;
}

History walked() {
    History history;
    history.begin({.kind = "trace", .name = "walk.trace.jsonl", .plans = walk()});
    for (const std::string& one : trace()) EXPECT_TRUE(history.trace(one)) << one;
    return history;
}

const Json& lane_of(const Json& lanes, const std::string& kind, const std::string& name) {
    for (const Json& lane : lanes["lanes"]) {
        if (lane["kind"] == kind && lane["name"] == name) return lane;
    }
    static const Json none = Json::object();
    return none;
}

TEST(History, ThePlanIsWhatItWasAtThatInstant) {
    const History history = walked();
    const Json first = history.at({.t = 1.499})["plan"];
    EXPECT_EQ(first["state"], "running");
    EXPECT_EQ(first["levels"][0]["actor"], "go");
    EXPECT_EQ(first["levels"][0]["variables"][0]["value"], 3);
    // At the instant itself what happened then has happened.
    const Json then = history.at({.t = 1.5})["plan"];
    EXPECT_EQ(then["levels"][0]["actor"], "go");
    EXPECT_EQ(then["levels"][0]["variables"][0]["value"], 4);
    const Json later = history.at({.t = 2})["plan"];
    EXPECT_EQ(later["levels"][0]["actor"], "stop");
    EXPECT_EQ(later["levels"][0]["since"], 1.7);
    const Json over = history.at({.t = 2.7})["plan"];
    EXPECT_EQ(over["state"], "ended");
    EXPECT_EQ(over["result"], "OK");
}

TEST(History, StepsLeadToWhatEndedAnActivation) {
    const History history = walked();
    EXPECT_EQ(history.at({.t = 0})["next"], 1.5);
    EXPECT_FALSE(history.at({.t = 0}).contains("before"));
    EXPECT_EQ(history.at({.t = 1.5})["next"], 2.7);
    EXPECT_FALSE(history.at({.t = 1.5}).contains("before"));
    EXPECT_EQ(history.at({.t = 2.7})["before"], 1.5);
}

TEST(History, LanesShowWhoWorkedAndWhoWatched) {
    const Json lanes = walked().lanes({0, 3, 300, {}});
    EXPECT_EQ(lane_of(lanes, "actors", "")["bars"],
              Json::array({{{"from", 0.0}, {"to", 1.7}, {"name", "go"}, {"end", "interrupted"}},
                           {{"from", 1.7}, {"to", 2.7}, {"name", "stop"}, {"end", "Done"}}}));
    // near watches with go, until the event; guard has raised it and rests.
    EXPECT_EQ(lane_of(lanes, "supervisor", "near")["bars"],
              Json::array({{{"from", 0.0}, {"to", 1.5}}}));
    const Json& guard = lane_of(lanes, "supervisor", "guard");
    EXPECT_EQ(guard["bars"], Json::array({{{"from", 0.0}, {"to", 1.5}}}));
    EXPECT_EQ(guard["marks"], Json::array({{{"t", 1.5}, {"name", "Received"}, {"to", "stop"}}}));
    // On two pixels both actors are wider than one; on one they are a second and a half each.
    EXPECT_EQ(walked().lanes({0, 300, 2, {}})["lanes"][0]["bars"],
              Json::array({{{"from", 0.0}, {"to", 2.7}, {"end", "Done"}, {"count", 2}}}));
}

// guard has not raised anything: it watches until the plan ends, and no longer.
TEST(History, NobodyWatchesAPlanThatHasEnded) {
    History history;
    history.begin({.kind = "trace", .name = "walk.trace.jsonl", .plans = walk()});
    for (const size_t one : {0, 2}) history.trace(trace()[one]);
    history.trace(line("2.0", R"("interrupted","actor":"go","activation":1,"ran":true)"));
    history.trace(line("2.0", R"("plan-end","result":"Interrupted")"));
    history.trace(line("9.0", R"("write","variable":"steps","value":4,"by":"hand")"));
    const Json lanes = history.lanes({0, 9, 900, {}});
    EXPECT_EQ(lane_of(lanes, "supervisor", "guard")["bars"],
              Json::array({{{"from", 0.0}, {"to", 2.0}}}));
    EXPECT_EQ(lane_of(lanes, "supervisor", "near")["bars"],
              Json::array({{{"from", 0.0}, {"to", 2.0}}}));
}

TEST(History, AfterAHotChangeThePastKeepsItsOwnPlan) {
    const std::string doc = "Walk.plan.json";
    PlanPast past(walk(), [](const std::string& file) { return file; }, 1e9, {{doc, "first"}});
    ASSERT_TRUE(past.add(trace()[2]));
    ASSERT_TRUE(past.add(line("1.0", R"("change")")));
    PlanPast::Plans changed = walk();
    changed[0].actors[1].name = "rest";  // it was called stop
    EXPECT_TRUE(past.change(2, changed, {{doc, "second"}}));
    EXPECT_FALSE(past.change(2, walk()));  // it was told already
    ASSERT_TRUE(past.add(line("2.0", R"("actor-start","actor":"rest","activation":2,"in":{})")));
    EXPECT_EQ(past.text_at(-1, doc), std::nullopt);
    EXPECT_EQ(past.text_at(0.5, doc), "first");
    EXPECT_EQ(past.text_at(2.5, doc), "second");
    EXPECT_EQ(past.text_at(2.5, "Other.plan.json"), std::nullopt);
    EXPECT_EQ(past.at(0.5)["levels"][0]["actor"], "go");
    EXPECT_EQ(past.at(1.5)["levels"][0]["actor"], "go");
    EXPECT_EQ(past.at(2.5)["levels"][0]["actor"], "rest");
    // near watched with go from the start to the end of its activation.
    EXPECT_EQ(past.at(0.5)["levels"][0]["supervisors"].size(), 2u);
    EXPECT_EQ(past.at(2.5)["levels"][0]["supervisors"].size(), 1u);
}

// The run tells what it is made of; no file is read.
TEST(History, AVersionThatIsToldIsThatOfTheLinesBehindIt) {
    History history;
    history.begin({.name = "Walk"});
    EXPECT_FALSE(history.trace(trace()[2]));  // of nothing that is known
    history.plan(1, walk());
    ASSERT_TRUE(history.trace(trace()[2]));
    ASSERT_TRUE(history.trace(line("1.0", R"("change")")));
    PlanOutlines changed = walk();
    changed[0].actors[1].name = "rest";  // it was called stop
    history.plan(2, changed);
    history.plan(1, walk());  // it was told already
    ASSERT_TRUE(
        history.trace(line("2.0", R"("actor-start","actor":"rest","activation":2,"in":{})")));
    EXPECT_EQ(history.at({.t = 0.5})["plan"]["levels"][0]["template"], "Wait");
    EXPECT_EQ(history.at({.t = 2})["plan"]["levels"][0]["template"], "Wait");
    EXPECT_EQ(history.at({.t = 2})["plan"]["levels"][0]["actor"], "rest");
}

TEST(History, ATraceIsGivenBackAsItCame) {
    std::string text;
    for (const std::string& one : trace()) (text += one) += "\n";
    EXPECT_EQ(walked().trace_text(), text);
}

TEST(History, ALineThatIsNoneIsRefused) {
    History history;
    history.begin({.plans = walk()});
    for (const char* bad : {"", "[]", "{}", "x", R"({"t":-1,"plan":"a","kind":"log"})",
                            R"({"t":"1","plan":"a","kind":"log"})", R"({"t":1,"plan":2})"}) {
        EXPECT_FALSE(history.trace(bad)) << bad;
    }
    // Members of another type than they should have do no harm.
    EXPECT_TRUE(history.trace(R"({"t":1,"plan":"a/b/c","kind":"actor-start","actor":7,"in":[]})"));
    EXPECT_TRUE(history.trace(R"({"t":1,"plan":"a","kind":"of a newer Vagus"})"));
    EXPECT_EQ(history.at({.t = 1})["plan"]["state"], "running");
}

// Whatever a history is told in a run: a step each second, words and places, events, node states.
void tell_walk(History& history, double after, double until) {
    const auto is_in = [&](double t) { return t > after && t <= until; };
    for (int i = 0; i < 60; ++i) {
        const double t = i;
        const auto word = static_cast<int16_t>(i);
        if (!is_in(t)) continue;
        const std::string event =
            i % 2 == 0 ? R"("actor-start","actor":"go","in":{},"activation":)" + std::to_string(i)
                       : R"("actor-end","actor":"go","state":"Done","activation":)" +
                             std::to_string(i - 1);
        EXPECT_TRUE(history.trace("{\"t\":" + std::to_string(i) + R"(,"plan":"Walk","kind":)" +
                                  event + "}"));
        EXPECT_TRUE(history.record(one(t, 1, 7, word)));
        EXPECT_TRUE(history.record(stand(t, 0, 0.1F * static_cast<float>(i), 0)));
        history.happen({.t = t, .kind = "event", .node = 1, .source = "drive", .name = "beat"});
        history.happen({.t = t,
                        .kind = "state",
                        .node = 1,
                        .name = i % 3 == 0 ? "running" : "paused",
                        .line = static_cast<uint32_t>(i)});
    }
}

TEST(History, ARunThatContinuesHasThePastOfTheOneBefore) {
    const History::Window window{.from = 0, .to = 60, .width = 600, .words = {{1, 7}}};
    for (const double cut : {0.0, 0.5, 1.0, 9.999, 10.0, 31.0, 59.5}) {
        SCOPED_TRACE(cut);
        History straight, other;
        for (History* one : {&straight, &other}) one->begin({.run = 2, .plans = walk()});
        tell_walk(straight, -1, cut);
        tell_walk(other, -1, 60);
        other.continue_from(cut, 2);
        straight.passed(cut);
        for (int rest = 0; rest < 2; ++rest) {
            EXPECT_EQ(other.lanes(window), straight.lanes(window));
            EXPECT_EQ(other.ways(0, 60), straight.ways(0, 60));
            EXPECT_EQ(other.trace_text(), straight.trace_text());
            EXPECT_EQ(other.to(), straight.to());
            for (const double t : {0.0, 0.7, 9.0, 10.0, 30.5, 60.0}) {
                const History::Instant instant{.t = t, .ranges = {{1, 7, 1}}, .events = 100};
                EXPECT_EQ(other.at(instant), straight.at(instant)) << "at " << t;
            }
            for (History* one : {&straight, &other}) tell_walk(*one, cut, 60);
        }
    }
}

TEST(History, ARunThatContinuesHasTheVersionOfThatTime) {
    History history;
    history.begin({.run = 1, .plans = walk()});
    ASSERT_TRUE(history.trace(trace()[2]));
    PlanPast::Plans second = walk();
    second.front().name = "Second";
    history.trace(trace()[3]);
    history.plan(2, second);
    history.continue_from(0.5, 2);
    EXPECT_EQ(history.plan_name(), "Walk");
    history.plan(2, second);
    EXPECT_EQ(history.plan_name(), "Second");
    EXPECT_EQ(history.run(), 2u);
}

TEST(PlanPast, ALongTraceKeepsItsLimitAndItsSense) {
    PlanPast past(
        walk(), [](const std::string& file) { return file; }, 1e9);
    const std::string start =
        R"(,"plan":"Walk","kind":"actor-start","actor":"go","in":{},"activation":)";
    for (size_t i = 0; i <= kTraceLines; ++i) {
        ASSERT_TRUE(past.add("{\"t\":" + std::to_string(i) + start + std::to_string(i) + "}"));
    }
    EXPECT_EQ(past.dropped(), kTraceBlockLines);
    EXPECT_EQ(past.line_count(), kTraceLines + 1 - kTraceBlockLines);
    EXPECT_EQ(past.from(), static_cast<double>(kTraceBlockLines));
    EXPECT_EQ(past.at(499)["state"], "none");
    EXPECT_EQ(past.at(500)["levels"][0]["activation"], 500);
    EXPECT_EQ(past.at(1234.5)["levels"][0]["activation"], 1234);
}

}  // namespace
}  // namespace vagus::serve
