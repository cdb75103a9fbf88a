#include "serve/runner/world_show.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/time.hpp"
#include "serve/runner/bus_clock.hpp"
#include "serve/talk/scene.hpp"
#include "wire/protocol.hpp"

namespace vagus::serve {

namespace {

std::string source_of(const session::SimSession& session, uint16_t node) {
    if (node == wire::kHostId) return kHostName;
    const aesl::Target* const target = session.target(node);
    return target != nullptr ? target->name : fmt::format("node {}", node);
}

}  // namespace

void WorldShow::begin() {
    recorder_.begin();
    next_picture_ = {};
    follows_ = false;
}

// Its own scripts were loaded before anybody followed it.
void WorldShow::follow(session::SimSession& session) {
    follows_ = true;
    for (const session::NodeState& node : session.nodes()) {
        if (node.name.empty()) continue;
        hear(session, {.node = node.id, .what = debug::NodeDescribed{node.name}});
        if (node.state == debug::ProgramState::Unknown) continue;
        hear(session,
             {.node = node.id, .what = debug::StateChanged{.state = node.state, .at = {}}});
    }
    session.on_heard([this, &session](const debug::Event& event) { hear(session, event); });
}

void WorldShow::loaded(const session::SimSession& session, uint16_t node) {
    happen(session, loaded_now(node, source_of(session, node)));
}

void WorldShow::hear(const session::SimSession& session, const debug::Event& event) {
    auto happened = happened_of(event, source_of(session, event.node));
    if (happened) happen(session, std::move(*happened));
}

void WorldShow::happen(const session::SimSession& session, Happened happened) {
    if (!follows_) return;
    happened.t = seconds_of(session.now());
    happened_.list.push_back({std::move(happened)});
    if (happened_.list.size() >= kHappenedAtOnce) tell_past();
}

void WorldShow::tell_frames(session::SimSession& session, hub::LinkId link) {
    wire::Frame frame;
    while (session.world().bus().take(link, frame)) {
        teller_.tell(talk::FrameSeen{seconds_of(session.now()), {frame}});
    }
}

void WorldShow::record(const session::SimSession& session) {
    recorder_.look(session.world());
    keep_pictures(session);
    if (recorder_.is_due_to_send()) tell_past();
}

void WorldShow::keep_pictures(const session::SimSession& session) {
    if (session.now() < next_picture_) return;
    next_picture_ = session.now() + kPictureEvery;
    if (teller_.is_behind()) return;
    size_t kept = 0;
    for (const sim::RobotView& robot : session.world().robots()) {
        if (!session.world().has_camera(robot.id)) continue;
        if (++kept > kPictureRobotsMax) return;
        teller_.tell(talk::PictureThen{seconds_of(session.now()),
                                       std::string(robot.name),
                                       {picture_of(session.world(), robot.id)}});
    }
}

void WorldShow::tell_past() {
    tell_records();
    if (!happened_.list.empty()) teller_.tell(std::exchange(happened_, {}));
}

void WorldShow::tell_records() {
    if (recorder_.overflows()) recorder_.forget();
    if (teller_.is_behind()) return;
    std::string records = recorder_.take();
    if (!records.empty()) teller_.tell(talk::Records{{std::move(records)}});
}

void WorldShow::tell_poses(const session::SimSession& session) {
    const double t = seconds_of(session.now());
    teller_.tell(talk::Poses{t, {poses_of(session.world())}});
    if (wanted_.rays) teller_.tell(talk::Rays{t, {rays_of(session.world())}});
}

void WorldShow::tell_scene(const session::SimSession& session) {
    talk::Scene scene = scene_of(session.world());
    if (scene == scene_) return;
    scene_ = scene;
    teller_.tell(talk::SceneNow{std::move(scene)});
}

void WorldShow::tell_pictures(const session::SimSession& session) {
    for (const std::string& name : wanted_.pictures) {
        const auto robot = session.world().find_robot(name);
        std::string picture = robot ? picture_of(session.world(), *robot) : "";
        if (picture.empty()) continue;
        teller_.tell(talk::Picture{seconds_of(session.now()), name, {std::move(picture)}});
    }
}

}  // namespace vagus::serve
