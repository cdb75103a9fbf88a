// Two recordings side by side, made by hand: where each lane differs first.
#include "record/compare_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mcap/writer.hpp"
#include "record/run_file.hpp"
#include "record/topics.hpp"

namespace vagus::record {
namespace {

using namespace std::chrono_literals;

// ---- lanes ----

JsonValue json(const std::string& text) {
    return parse_json(text, "test").value();
}

TEST(LinesLane, TheFirstLineThatIsNotTheSame) {
    const auto lane = make_lines_lane("/plan/trace", {"t"});
    lane->add(Side::A, 1s, json(R"({"t":1,"kind":"log","text":"one"})"));
    lane->add(Side::B, 1s, json(R"({"t":9,"kind":"log","text":"one"})"));
    lane->add(Side::A, 2s, json(R"({"t":2,"kind":"log","text":"two"})"));
    lane->add(Side::B, 2s, json(R"({"t":2,"kind":"log","text":"three"})"));
    lane->end(10s);
    EXPECT_EQ(lane->compared(), 2u);
    ASSERT_TRUE(lane->difference());
    EXPECT_EQ(lane->difference()->at, 2s);
    EXPECT_EQ(lane->difference()->place, "text");
    EXPECT_EQ(lane->difference()->a, R"({"kind":"log","text":"two"})");
    EXPECT_EQ(lane->difference()->b, R"({"kind":"log","text":"three"})");
}

// The other says it later, or never: a difference once nothing can come any more.
TEST(LinesLane, ALineThatOnlyOneHas) {
    const auto lane = make_lines_lane("/bus/events", {"t"});
    lane->add(Side::B, 3s, json(R"({"name":"go"})"));
    lane->follow(2999ms);
    EXPECT_FALSE(lane->difference());
    lane->add(Side::A, 3001ms, json(R"({"name":"go"})"));
    lane->follow(3s);
    ASSERT_TRUE(lane->difference());
    EXPECT_EQ(lane->difference()->at, 3s);
    EXPECT_EQ(lane->difference()->a, "");
    EXPECT_EQ(lane->difference()->b, R"({"name":"go"})");
}

TEST(LinesLane, BeforeTheyAreAlignedAndBehindTheEndNothingCounts) {
    const auto lane = make_lines_lane("/bus/events", {});
    lane->add(Side::A, -1us, json(R"({"name":"before"})"));
    lane->add(Side::A, 5s, json(R"({"name":"behind"})"));
    lane->end(4999ms);
    EXPECT_EQ(lane->compared(), 0u);
    EXPECT_FALSE(lane->difference());
}

TEST(LinesLane, OnlyWhatDiffersWhereThatIsWanted) {
    const auto lane = make_lines_lane("/vagus/check", {}, Telling::WhatDiffers);
    lane->add(Side::A, 1s, json(R"({"nodes":{"a":"x","b":1}})"));
    lane->add(Side::B, 1s, json(R"({"nodes":{"a":"x","b":2}})"));
    lane->end(1s);
    ASSERT_TRUE(lane->difference());
    EXPECT_EQ(lane->difference()->place, "nodes.b");
    EXPECT_EQ(lane->difference()->a, "1");
    EXPECT_EQ(lane->difference()->b, "2");
}

TEST(ValuesLane, AVariableThatHoldsAnother) {
    const auto lane = make_values_lane("/node/drive/variables", 0ms);
    for (const Side side : {Side::A, Side::B}) {
        lane->add(side, 20ms, json(R"({"set":{"n":1,"list":[1,2]}})"));
    }
    lane->add(Side::A, 40ms, json(R"({"set":{"n":2}})"));
    lane->add(Side::B, 60ms, json(R"({"set":{"n":2}})"));
    lane->end(1s);
    ASSERT_TRUE(lane->difference());
    EXPECT_EQ(lane->difference()->at, 40ms);
    EXPECT_EQ(lane->difference()->place, "n");
    EXPECT_EQ(lane->difference()->a, "2");
    EXPECT_EQ(lane->difference()->b, "1");
}

TEST(ValuesLane, AllOfThemAsAPictureIsNoDifference) {
    const auto lane = make_values_lane("/node/drive/variables", 0ms);
    lane->add(Side::A, 20ms, json(R"({"set":{"n":1,"m":5}})"));
    lane->add(Side::B, 20ms, json(R"({"set":{"n":1,"m":5}})"));
    lane->add(Side::B, 40ms, json(R"({"all":true,"set":{"n":1,"m":5}})"));
    lane->end(1s);
    EXPECT_FALSE(lane->difference());
}

// One has it 13 ms later, because its samples are at other instants; 21 ms are too many.
TEST(ValuesLane, SamplesOfOtherInstantsHaveAWindow) {
    for (const auto& [later, differs] : {std::pair(13ms, false), std::pair(21ms, true)}) {
        const auto lane = make_values_lane("/node/drive/variables", 20ms);
        lane->add(Side::A, -20ms, json(R"({"set":{"n":1}})"));
        lane->add(Side::B, -7ms, json(R"({"set":{"n":1}})"));
        lane->add(Side::A, 40ms, json(R"({"set":{"n":2}})"));
        lane->add(Side::B, 40ms + later, json(R"({"set":{"n":2}})"));
        lane->follow(50ms);
        EXPECT_FALSE(lane->difference());
        lane->end(1s);
        ASSERT_EQ(lane->difference().has_value(), differs);
        if (!differs) continue;
        EXPECT_EQ(lane->difference()->at, 40ms);
    }
}

// What was written before they are aligned, and is not written again.
TEST(ValuesLane, WhatTheyHoldWhereTheyAreAlignedCounts) {
    const auto lane = make_values_lane("/node/drive/variables", 0ms);
    lane->add(Side::A, -5s, json(R"({"set":{"n":1}})"));
    lane->add(Side::B, -3s, json(R"({"set":{"n":2}})"));
    lane->end(1s);
    ASSERT_TRUE(lane->difference());
    EXPECT_EQ(lane->difference()->at, 0s);
    EXPECT_EQ(lane->difference()->place, "n");
}

JsonValue box(double x, double z, double w) {
    const auto text = [](double value) { return std::to_string(value); };
    return json(R"({"id":"robot/r","cubes":[{"pose":{"position":{"x":)" + text(x) +
                R"(,"y":1.5,"z":0},"orientation":{"x":0,"y":0,"z":)" + text(z) + R"(,"w":)" +
                text(w) + "}}}]}");
}

TEST(PoseLane, AtTheSameInstantsToTheLastDigit) {
    const auto lane = make_pose_lane("/world/poses robot/r");
    lane->add(Side::A, 100ms, box(1, 0, 1));
    lane->add(Side::B, 100ms, box(1, 0, 1));
    lane->add(Side::A, 200ms, box(1.1, 0, 1));
    lane->add(Side::B, 200ms, box(1.100001, 0, 1));
    lane->end(1s);
    ASSERT_TRUE(lane->difference());
    EXPECT_EQ(lane->difference()->at, 200ms);
    EXPECT_EQ(lane->difference()->a, R"({"x":1.100000,"y":1.500000,"angle":0.00})");
    EXPECT_EQ(lane->difference()->b, R"({"x":1.100001,"y":1.500000,"angle":0.00})");
}

// Half-way between 1 m and 1.1 m it is at 1.05 m: 1.054 m is near enough, 1.056 m is not.
TEST(PoseLane, AtOtherInstantsBetweenTwoSamples) {
    for (const auto& [x, differs] : {std::pair(1.054, false), std::pair(1.056, true)}) {
        const auto lane = make_pose_lane("/world/poses robot/r");
        lane->add(Side::B, 100ms, box(1, 0, 1));
        lane->add(Side::A, 150ms, box(x, 0, 1));
        lane->add(Side::B, 200ms, box(1.1, 0, 1));
        lane->end(1s);
        EXPECT_EQ(lane->compared(), 1u);
        EXPECT_EQ(lane->difference().has_value(), differs) << x;
    }
}

// ---- whole recordings ----

struct Said {
    std::string topic;
    Time at{};
    std::string data;
};

std::string recording(const std::string& max_time, const std::vector<Said>& messages,
                      const std::string& script = "var n\n",
                      const std::vector<std::string>& robots = {}) {
    std::string bytes;
    mcap::Writer writer([&bytes](std::string_view more) {
        bytes += more;
        return Status::done();
    });
    mcap::Attachment file;
    file.name = "n.aesl";
    file.data = script;
    writer.attach(file);
    std::map<std::string, uint16_t> channels;
    const auto put = [&](const std::string& topic, Time at, const std::string& data) {
        if (!channels.contains(topic)) {
            mcap::Channel channel;
            channel.topic = topic;
            channels[topic] = writer.add_channel(channel);
        }
        writer.write(channels[topic], nanoseconds(at), data);
    };
    RunFile about;
    about.verb = "plan run";
    about.max_time = max_time;
    about.robots = robots;
    put(std::string(kRunTopic), 0s, format_run(about));
    for (const Said& one : messages) {
        put(one.topic, one.at, one.data);
        EXPECT_TRUE(writer.flush().ok());  // each in a chunk of its own
    }
    EXPECT_TRUE(writer.end().ok());
    return bytes;
}

Said starts(Time at, const std::string& actor, int activation) {
    return {std::string(kTraceTopic), at,
            R"({"t":0,"plan":"P","kind":"actor-start","actor":")" + actor + R"(","activation":)" +
                std::to_string(activation) + "}"};
}

Said ends(Time at) {
    return {std::string(kTraceTopic), at, R"({"t":0,"plan":"P","kind":"plan-end","result":"OK"})"};
}

Said emits(Time at, const std::string& name) {
    return {std::string(kEventsTopic), at, R"({"t":0,"frame":1,"name":")" + name + "\"}"};
}

Comparison compared(const std::string& a, const std::string& b, const Align& align = {}) {
    const auto in_a = mcap::Reader::open(a, "a.mcap");
    const auto in_b = mcap::Reader::open(b, "b.mcap");
    return compare_runs(in_a.value(), in_b.value(), align).value();
}

TEST(CompareRuns, TheSameHasNoDifference) {
    const std::string one = recording("9", {starts(1s, "go", 1), emits(2s, "x"), ends(3s)});
    const Comparison found = compared(one, one);
    EXPECT_FALSE(found.differs());
    EXPECT_TRUE(found.started.empty());
    EXPECT_EQ(format_comparison(found, "a", "b"), "a and b: 4 values compared: no difference\n");
}

TEST(CompareRuns, TheEarliestDifferenceIsFirst) {
    const Comparison found =
        compared(recording("9", {starts(1s, "go", 1), emits(2s, "x"), emits(3s, "y"), ends(5s)}),
                 recording("8", {starts(1s, "go", 1), emits(2500ms, "x"), ends(4s)}, "var m\n"));
    EXPECT_EQ(format_comparison(found, "a", "b"),
              "started with another max_time\n  A: \"9\"\n  B: \"8\"\n"
              "started with another file n.aesl\n  A: 6 bytes\n  B: 6 bytes\n"
              "differs at 2.000000 s: /bus/events\n  A: {\"name\":\"x\"}\n  B: nothing\n"
              "differs at 4.000000 s: /plan/trace\n  A: nothing\n"
              "  B: {\"plan\":\"P\",\"kind\":\"plan-end\",\"result\":\"OK\"}\n"
              "differs at 4.000000 s: end\n  A: {\"t\":5.000000,\"result\":\"OK\"}\n"
              "  B: {\"t\":4.000000,\"result\":\"OK\"}\n"
              "no difference: /vagus/input, /world/scene, /vagus/check\n");
}

TEST(CompareRuns, AlignedAtAnActorOrAnEvent) {
    const std::string a =
        recording("9", {starts(1s, "wait", 1), starts(2s, "go", 2), emits(3s, "x"), ends(4s)});
    const std::string b =
        recording("9", {starts(1s, "wait", 1), starts(5s, "wait", 2), starts(6500ms, "go", 3),
                        emits(7500ms, "x"), ends(8500ms)});
    const Comparison found = compared(a, b, {Align::At::Actor, "go"});
    EXPECT_EQ(found.start_a, 2s);
    EXPECT_EQ(found.start_b, 6500ms);
    EXPECT_FALSE(found.differs()) << format_comparison(found, "a", "b");
    EXPECT_EQ(compared(a, b, {Align::At::Event, "x"}).start_b, 7500ms);
    const std::string later =
        recording("9", {starts(2s, "go", 1), emits(3s, "x"), emits(3100ms, "y"), ends(4s)});
    const Comparison parted = compared(later, b, {Align::At::Actor, "go"});
    ASSERT_TRUE(parted.differs());
    EXPECT_EQ(format_comparison(parted, "a", "b"),
              "differs at 3.100000 s of A, 7.600000 s of B: /bus/events\n  A: {\"name\":\"y\"}\n"
              "  B: nothing\n"
              "no difference: /vagus/input, /plan/trace, /world/scene, end\n");
}

// ---- recordings that are not whole ----

std::string name_at(std::string_view text, std::string_view from, std::string_view to) {
    const size_t begin = text.find(from) + from.size();
    return std::string(text.substr(begin, text.find(to, begin) - begin));
}

// What is missing has not failed to happen.
TEST(CompareRuns, ARecordingThatIsDamagedInItsMiddleIsNoOtherRun) {
    const std::string whole = recording("9", {emits(1s, "x"), emits(2s, "here"), ends(4s)});
    std::string damaged = whole;
    damaged[damaged.find("here")] = 'm';
    const auto a = mcap::Reader::open(whole, "a.mcap");
    const auto b = mcap::Reader::open(damaged, "b.mcap");
    for (const auto& found :
         {compare_runs(a.value(), b.value(), {}), compare_runs(b.value(), a.value(), {})}) {
        ASSERT_FALSE(found.ok());
        const std::string& what = found.error().what;
        EXPECT_TRUE(what.starts_with("b.mcap: the chunk at byte ")) << what;
        const size_t place = std::stoul(name_at(what, "at byte ", " "));
        EXPECT_GT(place, damaged.find("mere") - 200) << what;
        EXPECT_LT(place, damaged.find("mere")) << what;
        EXPECT_NE(what.find("its checksum is wrong: expected "), std::string::npos) << what;
        EXPECT_TRUE(what.ends_with("by `vagus replay b.mcap --repair WHOLE.mcap`")) << what;
    }
}

// The rest of a mapped file that is cut off reads as zeros, from whatever instant on.
TEST(CompareRuns, ARecordingThatIsCutOffWhileItIsReadIsNoOtherRun) {
    const std::string whole = recording("9", {emits(1s, "x"), emits(2s, "y"), ends(4s)});
    std::string cut = whole;
    const auto a = mcap::Reader::open(whole, "a.mcap");
    const auto b = mcap::Reader::open(cut, "b.mcap");
    ASSERT_TRUE(b.value().is_complete());
    std::fill(cut.begin() + static_cast<std::ptrdiff_t>(cut.find("\"y\"")), cut.end(), '\0');
    const auto found = compare_runs(a.value(), b.value(), {});
    ASSERT_FALSE(found.ok());
    EXPECT_TRUE(found.error().what.starts_with("b.mcap: the chunk at byte ")) << found.error().what;
}

// Of its last instants some messages were not yet written when it was killed.
TEST(CompareRuns, TheLastSecondOfARecordingWithoutAnEndIsNotCompared) {
    const std::string whole =
        recording("9", {emits(1s, "x"), starts(4s, "go", 1), emits(4s, "y"), ends(9s)});
    const size_t last = whole.find("\"y\"");
    const std::string killed = whole.substr(0, last);
    const auto a = mcap::Reader::open(whole, "a.mcap");
    const auto b = mcap::Reader::open(killed, "b.mcap");
    ASSERT_FALSE(b.value().is_complete());
    EXPECT_FALSE(compare_runs(a.value(), b.value(), {}).value().differs());
    const std::string other = recording("9", {emits(2s, "x"), ends(9s)});
    const auto c = mcap::Reader::open(other, "c.mcap");
    EXPECT_TRUE(compare_runs(c.value(), b.value(), {}).value().differs());
}

// ---- robots with projects of their own ----

Said of(const std::string& robot, Said said) {
    said.topic.insert(0, "/robot/" + robot);
    return said;
}

// A name may have a slash, and be the beginning of another one.
TEST(CompareRuns, EachRobotHasLanesOfItsOwn) {
    const std::vector<std::string> robots = {"r", "r/2", "s"};
    const std::string a = recording("9",
                                    {of("r", starts(1s, "go", 1)), of("r/2", emits(2s, "x")),
                                     of("s", emits(2s, "x")), of("r", ends(3s))},
                                    "var n\n", robots);
    const std::string b = recording("9",
                                    {of("r", starts(1s, "go", 1)), of("r/2", emits(2s, "y")),
                                     of("s", emits(2s, "x")), of("r", ends(3s))},
                                    "var n\n", robots);
    const Comparison found = compared(a, b);
    EXPECT_EQ(format_comparison(found, "a", "b"),
              "differs at 2.000000 s: /robot/r/2/bus/events, name\n  A: {\"name\":\"x\"}\n"
              "  B: {\"name\":\"y\"}\n"
              "no difference: /vagus/input, /plan/trace, /bus/events, /world/scene, /vagus/check, "
              "/robot/r, /robot/r/2/plan/trace, /robot/r/2/vagus/check, /robot/s, end\n");
    EXPECT_EQ(found.lanes.front().robot, "r/2");
}

TEST(CompareRuns, AlignedAtTheFirstOfAnyRobotOrAtThatOfOne) {
    const std::string a = recording(
        "9", {of("r", starts(1s, "go", 1)), of("s", starts(2s, "go", 1)), of("s", ends(5s))},
        "var n\n", {"r", "s"});
    const std::string b = recording(
        "9", {of("s", starts(2500ms, "go", 1)), of("r", starts(4s, "go", 1)), of("s", ends(5s))},
        "var n\n", {"r", "s"});
    const Comparison any = compared(a, b, {Align::At::Actor, "go"});
    EXPECT_EQ(any.start_a, 1s);
    EXPECT_EQ(any.start_b, 2500ms);
    const Comparison one = compared(a, b, {Align::At::Actor, "r/go"});
    EXPECT_EQ(one.start_b, 4s);
    const auto reader = mcap::Reader::open(a, "a.mcap");
    EXPECT_EQ(
        compare_runs(reader.value(), reader.value(), {Align::At::Actor, "r/stop"}).error().what,
        "--align: in a.mcap began no actor \"r/stop\"; there are: r/go, s/go");
}

TEST(CompareRuns, WhatItCannotBeAlignedAt) {
    const std::string one = recording("9", {starts(1s, "go", 1), emits(2s, "drive"), ends(3s)});
    const auto reader = mcap::Reader::open(one, "a.mcap");
    const auto error = [&reader](const Align& align) {
        return compare_runs(reader.value(), reader.value(), align).error().what;
    };
    EXPECT_EQ(error({Align::At::Actor, "stop"}),
              "--align: in a.mcap began no actor \"stop\"; there are: go");
    EXPECT_EQ(error({Align::At::Event, "drivr"}),
              "--align: in a.mcap came no event \"drivr\"; did you mean drive?");
    EXPECT_FALSE(read_align({"actor"}).ok());
    EXPECT_EQ(read_align({"middle"}).error().what,
              "--align: expected start, actor NAME or event NAME; found \"middle\"");
}

TEST(CompareRuns, AsJson) {
    const Comparison found = compared(recording("9", {emits(2s, "x"), ends(3s)}),
                                      recording("9", {emits(2s, "y"), ends(3s)}));
    const JsonValue tree = json(format_comparison_json(found));
    const JsonValue& lane = tree.find("lanes")->items.front();
    EXPECT_EQ(lane.find("lane")->text, "/bus/events");
    EXPECT_EQ(lane.find("difference")->find("a_t")->number, 2);
    EXPECT_EQ(lane.find("difference")->find("a")->find("name")->text, "x");
    EXPECT_EQ(lane.find("difference")->find("b")->find("name")->text, "y");
}

}  // namespace
}  // namespace vagus::record
