// What a recorded run is drawn from beside another one (compare_runs.hpp): which actor was active
// when, what supervisors raised, where each robot went, and what is in the world at its beginning.
//
//     const RunTracks tracks = run_tracks(reader);
//     for (const ActorSpan& span : tracks.actors) draw(span.actor, span.from, span.to);
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "mcap/reader.hpp"
#include "record/scene_shape.hpp"

namespace vagus::record {

constexpr size_t kTrackSpansMax = 5000;   // of actors, of events; the others are counted
constexpr size_t kTrackPointsMax = 2000;  // of the way of one robot; a longer one is thinned out
constexpr size_t kTrackRobotsMax = 64;
constexpr size_t kTrackShapesMax = 2000;

struct ActorSpan {
    std::string actor;
    int level = 0;  // 0: of the outermost plan
    Time from{};
    Time to{};
};

struct RaisedEvent {
    std::string supervisor;
    std::string event;
    Time at{};
};

struct WayPoint {
    Time at{};
    double x = 0, y = 0, angle = 0;  // m, rad
};

struct RobotWay {
    std::string robot;
    double length = 0, width = 0;  // of its hull
    std::vector<WayPoint> points;
};

struct RunTracks {
    Time end{};
    std::vector<ActorSpan> actors;  // in the order of their beginnings
    std::vector<RaisedEvent> events;
    uint64_t more = 0;  // spans and events that are left out
    std::vector<RobotWay> ways;
    std::vector<SceneShape> scene;
};

// As far as the file can be read.
RunTracks run_tracks(const mcap::Reader& reader);

}  // namespace vagus::record
