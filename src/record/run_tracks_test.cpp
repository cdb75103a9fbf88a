// What a recording is drawn from, of recordings made by hand.
#include "record/run_tracks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "mcap/writer.hpp"
#include "record/topics.hpp"

namespace vagus::record {
namespace {

using namespace std::chrono_literals;

// A recording in memory.
struct Made {
    std::string bytes;
    mcap::Writer writer{[this](std::string_view more) {
        bytes += more;
        return Status::done();
    }};
    std::map<std::string, uint16_t> channels;

    void put(std::string_view topic, Time at, const std::string& data) {
        const std::string name(topic);
        if (!channels.contains(name)) {
            channels[name] = writer.add_channel({.topic = name, .encoding = "json"});
        }
        writer.write(channels[name], static_cast<uint64_t>(at.count()) * 1000, data);
    }
    RunTracks tracks() {
        EXPECT_TRUE(writer.end().ok());
        return run_tracks(mcap::Reader::open(bytes, "run.mcap").value());
    }
};

std::string entity(const std::string& id, double x, const std::string& kind = "cubes") {
    return fmt::format(R"({{"id":"{}","{}":[{{"pose":{{"position":{{"x":{},"y":2}},)"
                       R"("orientation":{{"z":0,"w":1}}}},"size":{{"x":0.2,"y":0.1}}}}]}})",
                       id, kind, x);
}
std::string scene(const std::string& entities) {
    return R"({"deletions":[],"entities":[)" + entities + "]}";
}

TEST(RunTracks, ActorsLastFromTheirBeginningToTheirEnd) {
    Made made;
    const auto line = [&](Time at, const std::string& rest) {
        made.put(kTraceTopic, at, R"({"plan":"P)" + rest + "}");
    };
    line(1s, R"(","kind":"actor-start","actor":"a","activation":1)");
    line(2s, R"(/a","kind":"actor-start","actor":"inner","activation":2)");
    line(3s, R"(","kind":"event","supervisor":"watch","event":"Touched")");
    line(3s, R"(/a","kind":"interrupted","actor":"inner")");
    line(3s, R"(","kind":"interrupted","actor":"a")");
    line(4s, R"(","kind":"actor-start","actor":"a","activation":3)");
    made.put(kCheckTopic, 9s, "{}");
    const RunTracks tracks = made.tracks();
    EXPECT_EQ(tracks.end, Time(9s));
    std::vector<std::string> spans;
    for (const ActorSpan& one : tracks.actors) {
        spans.push_back(fmt::format("{} {} {}..{}", one.level, one.actor,
                                    one.from.count() / 1000000, one.to.count() / 1000000));
    }
    EXPECT_EQ(spans, (std::vector<std::string>{"0 a 1..3", "1 inner 2..3", "0 a 4..9"}));
    ASSERT_EQ(tracks.events.size(), 1u);
    EXPECT_EQ(tracks.events[0].supervisor, "watch");
    EXPECT_EQ(tracks.events[0].event, "Touched");
    EXPECT_EQ(tracks.events[0].at, Time(3s));
}

TEST(RunTracks, WaysAreOfRobotsAndTheSceneIsThatOfTheBeginning) {
    Made made;
    made.put(kSceneTopic, 0s,
             scene(entity("object/1", 1) + "," + entity("object/2", 3, "cylinders")));
    made.put(kPosesTopic, 0s, scene(entity("robot/r", 1) + "," + entity("object/1", 1)));
    made.put(kPosesTopic, 1s, scene(entity("robot/r", 1.5)));
    made.put(kSceneTopic, 2s, scene(entity("object/3", 4)));
    const RunTracks tracks = made.tracks();
    ASSERT_EQ(tracks.scene.size(), 2u);
    EXPECT_FALSE(tracks.scene[0].round);
    EXPECT_TRUE(tracks.scene[1].round);
    ASSERT_EQ(tracks.ways.size(), 1u);
    EXPECT_EQ(tracks.ways[0].robot, "r");
    EXPECT_EQ(tracks.ways[0].length, 0.2);
    ASSERT_EQ(tracks.ways[0].points.size(), 2u);
    EXPECT_EQ(tracks.ways[0].points[1].x, 1.5);
}

TEST(RunTracks, ALongWayIsThinnedOutAndManySpansAreCounted) {
    Made made;
    constexpr size_t kSamples = 3 * kTrackPointsMax;
    for (size_t i = 0; i < kSamples; ++i) {
        made.put(kPosesTopic, i * 100ms, scene(entity("robot/r", static_cast<double>(i))));
    }
    for (size_t i = 0; i < kTrackSpansMax + 1; ++i) {
        made.put(kTraceTopic, i * 1ms,
                 R"({"plan":"P","kind":"event","supervisor":"s","event":"E"})");
    }
    const RunTracks tracks = made.tracks();
    ASSERT_EQ(tracks.ways.size(), 1u);
    const std::vector<WayPoint>& points = tracks.ways[0].points;
    EXPECT_LE(points.size(), kTrackPointsMax);
    EXPECT_GT(points.size(), kTrackPointsMax / 4);
    EXPECT_EQ(points.front().at, Time{});
    EXPECT_GT(points.back().at, (kSamples - 10) * 100ms);
    EXPECT_EQ(tracks.events.size(), kTrackSpansMax);
    EXPECT_EQ(tracks.more, 1u);
}

}  // namespace
}  // namespace vagus::record
