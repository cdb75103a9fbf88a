#include "serve/history/recorded_world.hpp"

#include <cmath>
#include <utility>

#include "base/seconds.hpp"
#include "record/scene_update.hpp"
#include "record/topics.hpp"
#include "serve/talk/scene.hpp"
#include "sim/world.hpp"
#include "sim/world_file.hpp"

namespace vagus::serve {

namespace {

// Null, if there is none of that name.
const Json& member_of(const Json& json, const char* name) {
    static const Json kNone;
    const auto found = json.find(name);
    return found != json.end() ? *found : kNone;
}

double number_of(const Json& json, const char* name) {
    const Json& number = member_of(json, name);
    return number.is_number() ? number.get<double>() : 0;
}

}  // namespace

// The picture on the ground is one of the page: here nothing looks at it.
RecordedWorld::RecordedWorld(const mcap::Reader& reader, const record::RunFile& about) {
    const mcap::Attachment* const file = reader.attachment(about.world);
    if (about.world.empty() || file == nullptr) return;
    auto definition = sim::read_world(file->data, about.world);
    if (!definition.ok()) return;
    const std::string image = std::exchange(definition.value().ground_image, "");
    const auto world = sim::World::create(std::move(definition.value()));
    if (!world.ok()) return;
    scene_ = scene_of(world.value()).document.json;
    if (!image.empty()) scene_["image"] = image;
    uint32_t index = 0;
    for (const sim::RobotView& robot : world.value().robots()) {
        keys_["robot/" + std::string(robot.name)] = kRobotKey | index++;
        first_nodes_[std::string(robot.name)] = robot.node;
    }
    for (const sim::ObjectView& object : world.value().objects()) {
        keys_["object/" + record::key_of(object)] = object.id.number;
    }
}

uint16_t RecordedWorld::first_node(const std::string& robot) const {
    const auto found = first_nodes_.find(robot);
    return found == first_nodes_.end() ? 1 : found->second;
}

bool RecordedWorld::see(std::string_view topic, Time at, std::string_view data) {
    if (topic != record::kPosesTopic && topic != record::kSceneTopic) return false;
    const Json update = Json::parse(data, nullptr, false);
    if (!update.is_object()) return false;
    writer_.begin(seconds_of(at));
    for (const Json& entity : member_of(update, "entities")) see_entity(entity);
    return true;
}

// One box or cylinder, upright: its turn is about the axis that points up.
void RecordedWorld::see_entity(const Json& entity) {
    const Json& id = member_of(entity, "id");
    if (!id.is_string()) return;
    const auto key = keys_.find(id.get<std::string>());
    if (key == keys_.end()) return;
    for (const char* const kind : {"cubes", "cylinders"}) {
        const Json& shapes = member_of(entity, kind);
        if (!shapes.is_array() || shapes.empty()) continue;
        const Json& pose = member_of(shapes.front(), "pose");
        const Json& at = member_of(pose, "position");
        const Json& turn = member_of(pose, "orientation");
        const double angle = 2 * std::atan2(number_of(turn, "z"), number_of(turn, "w"));
        writer_.pose(key->second, static_cast<float>(number_of(at, "x")),
                     static_cast<float>(number_of(at, "y")), static_cast<float>(angle));
    }
}

}  // namespace vagus::serve
