#include "serve/runner/compare_host.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "record/compare_runs.hpp"
#include "record/damage.hpp"
#include "record/run_tracks.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/json.hpp"
#include "serve/runner/one_answer.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kTextMax = 1000, kNameMax = 256;

Json of_lane(const record::ComparedLane& lane) {
    Json told = {{"name", line_of(lane.name, kNameMax)}, {"compared", lane.compared}};
    if (!lane.difference) return told;
    told["t"] = seconds_of(lane.difference->at);
    told["place"] = line_of(lane.difference->place, kTextMax);
    told["a"] = line_of(lane.difference->a, kTextMax);
    told["b"] = line_of(lane.difference->b, kTextMax);
    return told;
}

Json of_way(const record::RobotWay& way) {
    Json points = Json::array();
    for (const record::WayPoint& one : way.points) {
        for (const double value : {seconds_of(one.at), one.x, one.y, one.angle}) {
            points.push_back(value);
        }
    }
    return {{"robot", line_of(way.robot, kNameMax)},
            {"length", way.length},
            {"width", way.width},
            {"points", std::move(points)}};
}

Json of_run(const mcap::Reader& reader, const record::RunTracks& tracks, Time start) {
    Json actors = Json::array();
    for (const record::ActorSpan& one : tracks.actors) {
        actors.push_back({{"name", line_of(one.actor, kNameMax)},
                          {"level", one.level},
                          {"from", seconds_of(one.from)},
                          {"to", seconds_of(one.to)}});
    }
    Json events = Json::array();
    for (const record::RaisedEvent& one : tracks.events) {
        events.push_back({{"name", line_of(one.event, kNameMax)},
                          {"supervisor", line_of(one.supervisor, kNameMax)},
                          {"t", seconds_of(one.at)}});
    }
    Json ways = Json::array();
    for (const record::RobotWay& one : tracks.ways) ways.push_back(of_way(one));
    return {{"start", seconds_of(start)},
            {"end", seconds_of(tracks.end)},
            {"complete", record::is_whole(reader)},
            {"actors", std::move(actors)},
            {"events", std::move(events)},
            {"ways", std::move(ways)},
            {"more", tracks.more}};
}

Json of_scene(const std::vector<record::SceneShape>& scene) {
    Json shapes = Json::array();
    for (const record::SceneShape& one : scene) {
        shapes.push_back({{"round", one.round},
                          {"at", {one.x, one.y}},
                          {"angle", one.angle},
                          {"size", {one.length, one.width}}});
    }
    return shapes;
}

Result<Json> compared(const Json& asked) {
    const std::string path_a = asked["a"];
    const std::string path_b = asked["b"];
    const auto align = TRY(record::read_align(asked["align"].get<std::vector<std::string>>()));
    const MappedFile file_a = TRY(MappedFile::open(path_a));
    const MappedFile file_b = TRY(MappedFile::open(path_b));
    // By their paths: what is said of a damaged one holds a command for the terminal.
    const mcap::Reader a = TRY(mcap::Reader::open(file_a.bytes(), path_a));
    const mcap::Reader b = TRY(mcap::Reader::open(file_b.bytes(), path_b));
    const record::Comparison found = TRY(record::compare_runs(a, b, align));
    Json lanes = Json::array();
    for (const record::ComparedLane& lane : found.lanes) {
        if (lanes.size() < kLanesToldMax) lanes.push_back(of_lane(lane));
    }
    Json started = Json::array();
    for (const record::StartedApart& one : found.started) {
        if (started.size() >= kStartedToldMax) break;
        started.push_back({{"what", line_of(one.what, kTextMax)},
                           {"a", line_of(one.a, kTextMax)},
                           {"b", line_of(one.b, kTextMax)}});
    }
    const record::RunTracks of_a = record::run_tracks(a);
    const record::RunTracks of_b = record::run_tracks(b);
    return Json{{"a", of_run(a, of_a, found.start_a)},
                {"b", of_run(b, of_b, found.start_b)},
                {"lanes", std::move(lanes)},
                {"started", std::move(started)},
                {"scene", of_scene(of_a.scene)}};
}

// The words of the command line are nobody's here.
std::string without(const std::string& text, std::string_view prefix) {
    return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

}  // namespace

std::string answer_compare(const std::string& question) {
    const Json asked = Json::parse(question, nullptr, false);
    const bool good =
        asked.is_object() && asked.contains("a") && asked.contains("b") && asked.contains("align");
    if (!good) return "";
    const auto found = compared(asked);
    const Json answer =
        found.ok() ? found.value() : Json{{"error", without(found.error().what, "--align: ")}};
    return json_text(answer);
}

int run_compare(Pipe pipe) {
    return answer_one(std::move(pipe), {kCompareAsked, kCompareAnswered}, answer_compare);
}

}  // namespace vagus::serve
