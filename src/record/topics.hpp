// The channels of a recording (docs/recordings.md): which there are, and how a message of each
// looks. The same values go to a file, and are compared with those of a file when a run is run
// again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "base/time.hpp"

namespace vagus::record {

constexpr std::string_view kRunTopic = "/vagus/run";
constexpr std::string_view kInputTopic = "/vagus/input";
constexpr std::string_view kCutTopic = "/vagus/cut";  // where a repaired recording was cut off
constexpr std::string_view kCheckTopic = "/vagus/check";
constexpr std::string_view kTraceTopic = "/plan/trace";
constexpr std::string_view kStatesTopic = "/plan/states";
constexpr std::string_view kFramesTopic = "/bus/frames";
constexpr std::string_view kEventsTopic = "/bus/events";
constexpr std::string_view kNodesTopic = "/bus/nodes";
constexpr std::string_view kPosesTopic = "/world/poses";
constexpr std::string_view kSceneTopic = "/world/scene";
constexpr std::string_view kCameraTopics = "/camera/";  // and the name of the robot
constexpr std::string_view kChaosTopic = "/world/chaos";
// Before those of a robot with a project of its own: "/robot/r4/plan/trace".
constexpr std::string_view kRobotTopics = "/robot/";

// How a channel is declared.
struct Topic {
    std::string name;
    bool json = true;              // else bytes
    std::string_view schema = {};  // name of one of schemas(); empty: none
    bool may_be_dropped = false;   // where the disk is too slow
};

// Times of MCAP, which counts nanoseconds.
constexpr uint64_t nanoseconds(Time at) {
    return static_cast<uint64_t>(std::chrono::nanoseconds(at).count());
}
constexpr Time time_of(uint64_t ns) {
    return Time(static_cast<int64_t>(ns / 1000));
}

// A time as members of Foxglove's schemas have it.
std::string stamp_json(Time at);

// The JSON schema of that name: "foxglove.SceneUpdate". Empty: there is none.
std::string_view schema_text(std::string_view name);

// Where messages go. Topics are declared before their first message; each has its number.
class Tape {
public:
    Tape() = default;
    Tape(const Tape&) = delete;
    Tape& operator=(const Tape&) = delete;
    virtual ~Tape() = default;
    virtual uint16_t declare(const Topic& topic) = 0;
    virtual void put(uint16_t topic, Time at, std::string_view data) = 0;
    // The same of a message that is still to be worded, perhaps on another thread, and soon: what
    // it needs it owns.
    using Word = std::function<std::string()>;
    virtual void put_later(uint16_t topic, Time at, size_t about_bytes, Word word) = 0;
};

}  // namespace vagus::record
