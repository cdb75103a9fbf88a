#include "serve/runner/recorder.hpp"

#include "base/time.hpp"

#include <cmath>
#include <utility>

#include "serve/talk/scene.hpp"

namespace vagus::serve {

void Recorder::begin() {
    forget();
    next_ = next_load_ = next_sight_ = Time{};
}

void Recorder::forget() {
    (void)writer_.take();
    words_.clear();
    things_.clear();
    sights_.clear();
}

void Recorder::look(const sim::World& world) {
    if (world.now() < next_) return;
    const auto slower = static_cast<Duration::rep>(words_.size() / kRecordedNodes + 1);
    next_ = world.now() + kRecordEvery * slower;
    const bool whole = words_.empty() && things_.empty();
    writer_.begin(seconds_of(world.now()));
    look_at_nodes(world);
    look_at_things(world);
    look_at_sights(world);
    look_at_loads(world);
    if (whole) whole_ = writer_.size();
}

void Recorder::look_at_nodes(const sim::World& world) {
    for (const sim::RobotView& robot : world.robots()) {
        if (robot.own_bus) continue;
        for (uint16_t i = 0; i < robot.nodes; ++i) {
            const auto node = static_cast<uint16_t>(robot.node + i);
            see(node, world.variables_of(node));
        }
    }
}

// Words that changed side by side go together.
void Recorder::see(uint16_t node, std::span<const int16_t> words) {
    // The history keeps no more of them.
    if (words_.size() >= kRecordedNodesMax && !words_.contains(node)) return;
    std::vector<int16_t>& before = words_[node];
    const bool first = before.size() != words.size();
    if (first) before.assign(words.begin(), words.end());
    if (first) return writer_.words(node, 0, words);
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == before[i]) continue;
        size_t end = i;
        while (end < words.size() && words[end] != before[end]) before[end] = words[end], ++end;
        writer_.words(node, static_cast<uint16_t>(i), words.subspan(i, end - i));
        i = end;
    }
}

void Recorder::look_at_things(const sim::World& world) {
    uint32_t index = 0;
    for (const sim::RobotView& robot : world.robots()) {
        see(kRobotKey | index++,
            {static_cast<float>(robot.pose.at.x), static_cast<float>(robot.pose.at.y),
             static_cast<float>(robot.pose.angle)});
    }
    for (const sim::ObjectView& object : world.objects()) {
        see(object.id.number,
            {static_cast<float>(object.pose.at.x), static_cast<float>(object.pose.at.y),
             static_cast<float>(object.pose.angle)});
    }
}

void Recorder::see(uint32_t key, const Standing& standing) {
    const auto before = things_.find(key);
    if (before != things_.end() && before->second == standing) return;
    things_[key] = standing;
    writer_.pose(key, standing.x, standing.y, standing.angle);
}

// What is forgotten is told at once, with the words and poses that are told as a whole.
void Recorder::look_at_sights(const sim::World& world) {
    if (world.now() < next_sight_ && !sights_.empty()) return;
    const auto robots = world.robots();
    const auto slower =
        static_cast<Duration::rep>((robots.size() + kSightRobots - 1) / kSightRobots);
    next_sight_ = world.now() + kRecordEvery * slower;
    uint16_t index = 0;
    for (const sim::RobotView& robot : robots) {
        if (index >= kSightRobotsMax) break;
        auto& [looks, lamps] = sights_[index];
        std::string looks_now = looks_of(world, robot, index);
        std::string lamps_now = lamps_of(world, robot, index);
        if (looks != looks_now) writer_.looks(index, looks = std::move(looks_now));
        if (lamps != lamps_now) writer_.lamps(index, lamps = std::move(lamps_now));
        ++index;
    }
}

void Recorder::look_at_loads(const sim::World& world) {
    if (world.now() < next_load_) return;
    next_load_ = world.now() + kLoadEvery;
    const auto load = world.bus_load();
    if (!load) return;
    for (const sim::NodeLoad& one : load->nodes) {
        const double hundredths = one.load.share_of_last_second * 100 * kLoadUnit;
        const auto share = static_cast<int16_t>(std::lround(hundredths));
        std::vector<int16_t>& loads = words_[kLoadNode];
        if (loads.size() <= one.node) loads.resize(size_t{one.node} + 1, -1);
        if (std::exchange(loads[one.node], share) == share) continue;
        writer_.words(kLoadNode, one.node, {&share, 1});
    }
}

}  // namespace vagus::serve
