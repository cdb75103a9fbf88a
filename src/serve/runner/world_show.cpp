#include "serve/runner/world_show.hpp"

#include "base/time.hpp"
#include "serve/runner/bus_clock.hpp"
#include "serve/runner/scene.hpp"

namespace vagus::serve {

void WorldShow::tell_frames(session::SimSession& session, hub::LinkId link) {
    wire::Frame frame;
    while (session.world().bus().take(link, frame)) {
        teller_.tell(talk::FrameSeen{seconds_of(session.now()), {frame}});
    }
}

void WorldShow::record(const session::SimSession& session) {
    recorder_.look(session.world());
    if (recorder_.is_due_to_send()) tell_records();
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
