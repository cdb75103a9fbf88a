// What flows from a run to pages as it is: poses, rays, pictures of cameras. Each page is sent the
// latest bytes of each kind once; the same of the same instant are not sent again.
//
//     Flows flows(desk.topics());
//     flows.show(poses);
//     open.poses = flows.poses_now();
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "serve/studio/topics.hpp"
#include "serve/talk/news.hpp"

namespace vagus::serve {

class Flows {
public:
    // Declares the topics poses, rays, picture. `topics` are borrowed.
    explicit Flows(Topics& topics);

    void show(talk::Poses poses);
    void show(talk::Rays rays);
    void show(talk::Picture picture);
    // Pictures of other robots are dropped: nobody watches them any more.
    void keep_pictures_of(const std::set<std::string>& robots);
    void forget();

    // Where the robots are, in the order of the scene.
    std::vector<talk::Pose> poses_now() const;

private:
    // The latest bytes of a kind.
    struct Flow {
        uint64_t number = 0;  // counts up
        double t = 0;
        std::string bytes;
    };
    struct FlowWatch;
    struct PictureWatch;
    void put(Flow& flow, double t, std::string bytes);

    Flow poses_, rays_;
    std::map<std::string, Flow> pictures_;  // by robot
    uint64_t last_ = 0;
};

}  // namespace vagus::serve
