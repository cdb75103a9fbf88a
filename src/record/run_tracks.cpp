#include "record/run_tracks.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "base/json.hpp"
#include "record/recorder.hpp"
#include "record/topics.hpp"

namespace vagus::record {

namespace {

constexpr std::string_view kRobot = "robot/";

class Drawer {
public:
    void see(std::string_view topic, Time at, std::string_view data) {
        tracks_.end = std::max(tracks_.end, at);
        const bool scene = topic == kSceneTopic && tracks_.scene.empty();
        if (topic != kTraceTopic && topic != kPosesTopic && !scene) return;
        const auto json = read_json(data);
        const auto* const message = std::get_if<JsonValue>(&json);
        if (message == nullptr) return;
        if (topic == kTraceTopic) return see_trace(*message, at);
        const JsonValue* const entities = message->find("entities");
        if (entities == nullptr) return;
        for (const JsonValue& entity : entities->items) {
            scene ? see_object(entity) : see_robot(entity, at);
        }
    }

    RunTracks take() {
        for (const auto& [key, span] : open_) tracks_.actors[span].to = tracks_.end;
        return std::move(tracks_);
    }

private:
    void see_trace(const JsonValue& line, Time at) {
        const std::string kind = text_in(line, "kind");
        const std::string plan = text_in(line, "plan");
        const std::string actor = text_in(line, "actor");
        if (kind == "event") {
            if (!has_room(tracks_.events.size())) return;
            tracks_.events.push_back({text_in(line, "supervisor"), text_in(line, "event"), at});
        } else if (kind == "actor-start") {
            if (!has_room(tracks_.actors.size())) return;
            const auto level = static_cast<int>(std::count(plan.begin(), plan.end(), '/'));
            open_[{plan, actor}] = tracks_.actors.size();
            tracks_.actors.push_back({actor, level, at, at});
        } else if (kind == "actor-end" || kind == "interrupted") {
            const auto span = open_.find({plan, actor});
            if (span == open_.end()) return;
            tracks_.actors[span->second].to = at;
            open_.erase(span);
        }
    }

    bool has_room(size_t count) {
        if (count < kTrackSpansMax) return true;
        ++tracks_.more;
        return false;
    }

    void see_object(const JsonValue& entity) {
        if (text_in(entity, "id").starts_with(kRobot)) return;
        const auto shape = scene_shape(entity);
        if (shape && tracks_.scene.size() < kTrackShapesMax) tracks_.scene.push_back(*shape);
    }

    void see_robot(const JsonValue& entity, Time at) {
        const std::string id = text_in(entity, "id");
        const auto shape = id.starts_with(kRobot) ? scene_shape(entity) : std::nullopt;
        if (!shape) return;
        const std::string name = id.substr(kRobot.size());
        auto way = std::find_if(tracks_.ways.begin(), tracks_.ways.end(),
                                [&](const RobotWay& one) { return one.robot == name; });
        if (way == tracks_.ways.end()) {
            if (tracks_.ways.size() >= kTrackRobotsMax) return;
            tracks_.ways.push_back({name, shape->length, shape->width, {}});
            way = tracks_.ways.end() - 1;
        }
        add(*way, {at, shape->x, shape->y, shape->angle});
    }

    // A way that gets too long keeps every second of its points, and is followed half as often.
    void add(RobotWay& way, const WayPoint& point) {
        Duration& every = every_[way.robot];
        if (!way.points.empty() && point.at - way.points.back().at < every) return;
        way.points.push_back(point);
        if (way.points.size() <= kTrackPointsMax) return;
        every = 2 * (way.points[1].at - way.points[0].at);
        std::vector<WayPoint> thinned;
        for (size_t i = 0; i < way.points.size(); i += 2) thinned.push_back(way.points[i]);
        way.points = std::move(thinned);
    }

    RunTracks tracks_;
    std::map<std::pair<std::string, std::string>, size_t> open_;  // by plan and actor
    std::map<std::string, Duration> every_;                       // by robot
};

}  // namespace

RunTracks run_tracks(const mcap::Reader& reader) {
    Drawer drawer;
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        const mcap::Channel* const channel = reader.channel(message->channel);
        if (channel == nullptr) continue;
        drawer.see(channel->topic, time_of(message->log_time), message->data);
    }
    return drawer.take();
}

}  // namespace vagus::record
