#include "serve/run/flows.hpp"

#include "serve/json.hpp"

#include <array>
#include <cstring>
#include <utility>

namespace vagus::serve {

namespace {

constexpr size_t kPosesHead = 4;  // two counts: of robots, of objects (protocol.json)
constexpr size_t kPoseBytes = 12;

}  // namespace

struct Flows::FlowWatch final : BinaryWatch {
    explicit FlowWatch(const Flow& its_flow) : flow(its_flow) {}
    std::optional<std::pair<double, std::string>> next() override {
        if (flow.number == sent || flow.bytes.empty()) return std::nullopt;
        sent = flow.number;
        return std::pair(flow.t, flow.bytes);
    }
    const Flow& flow;
    uint64_t sent = 0;
};

// The same of one robot's camera.
struct Flows::PictureWatch final : BinaryWatch {
    PictureWatch(const Flows& its_flows, std::string its_robot)
        : flows(its_flows), robot(std::move(its_robot)) {}
    std::optional<std::pair<double, std::string>> next() override {
        const auto found = flows.pictures_.find(robot);
        if (found == flows.pictures_.end() || found->second.number == sent) return std::nullopt;
        sent = found->second.number;
        return std::pair(found->second.t, found->second.bytes);
    }
    const Flows& flows;
    const std::string robot;
    uint64_t sent = 0;
};

Flows::Flows(Topics& topics) {
    topics.binary("poses", [this](const Json&) { return std::make_unique<FlowWatch>(poses_); });
    topics.binary("rays", [this](const Json&) { return std::make_unique<FlowWatch>(rays_); });
    topics.binary("picture", [this](const Json& of) {
        return std::make_unique<PictureWatch>(*this, of["robot"]);
    });
}

// A run whose clock is paused tells again and again what pages have drawn.
void Flows::put(Flow& flow, double t, std::string bytes) {
    if (flow.t == t && flow.bytes == bytes) return;
    flow = {++last_, t, std::move(bytes)};
}

void Flows::show(talk::Poses poses) {
    put(poses_, poses.t, std::move(poses.bytes.bytes));
}

void Flows::show(talk::Rays rays) {
    put(rays_, rays.t, std::move(rays.bytes.bytes));
}

void Flows::show(talk::Picture picture) {
    put(pictures_[picture.robot], picture.t, std::move(picture.bytes.bytes));
}

void Flows::keep_pictures_of(const std::set<std::string>& robots) {
    std::erase_if(pictures_, [&](const auto& one) { return !robots.contains(one.first); });
}

void Flows::forget() {
    poses_ = rays_ = {};
    pictures_.clear();
}

std::vector<talk::Pose> Flows::poses_now() const {
    std::vector<talk::Pose> found;
    const std::string& bytes = poses_.bytes;
    uint16_t robots = 0;
    if (bytes.size() < kPosesHead) return found;
    std::memcpy(&robots, bytes.data(), sizeof robots);
    for (size_t i = 0; i < robots && bytes.size() >= kPosesHead + (i + 1) * kPoseBytes; ++i) {
        std::array<float, 3> pose;
        std::memcpy(pose.data(), bytes.data() + kPosesHead + i * kPoseBytes, kPoseBytes);
        found.push_back({pose[0], pose[1], pose[2]});
    }
    return found;
}

}  // namespace vagus::serve
