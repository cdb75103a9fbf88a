// The lanes of two recordings that are compared side by side (compare_runs.hpp): each follows what
// both say of one thing, in the order of time, until they differ.
//
// Times count from the instant at which the two are aligned; what was before is only remembered.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "base/time.hpp"
#include "base/trig.hpp"

namespace vagus::record {

enum class Side : uint8_t { A, B };

// Where the samples of two runs are not of the same instants, poses between two samples are
// compared with what lies between them, and this is no difference.
constexpr double kPoseApart = 0.005;                 // m
constexpr double kPoseTurned = 2 * trig::kPi / 180;  // rad

struct LaneDifference {
    Time at{};          // from where the two are aligned
    std::string place;  // in what is said: "set.token"; empty: all of it
    std::string a;      // as JSON; empty: nothing was said
    std::string b;
};

class Lane {
public:
    explicit Lane(std::string name) : name_(std::move(name)) {}
    Lane(const Lane&) = delete;
    Lane& operator=(const Lane&) = delete;
    virtual ~Lane() = default;

    const std::string& name() const { return name_; }
    uint64_t compared() const { return compared_; }
    const std::optional<LaneDifference>& difference() const { return difference_; }

    // In the order of time of each side.
    virtual void add(Side side, Time at, const JsonValue& message) = 0;
    // Both sides have said all that they say up to then.
    virtual void follow(Time until) = 0;
    // That was all, up to the end of the shorter one.
    virtual void end(Time until) { follow(until); }

protected:
    static size_t index(Side side) { return static_cast<size_t>(side); }
    void found(LaneDifference difference) {
        if (!difference_) difference_ = std::move(difference);
    }
    uint64_t compared_ = 0;

private:
    std::string name_;
    std::optional<LaneDifference> difference_;
};

// Of two lines that differ both are told as they are, or only what differs in them.
enum class Telling : uint8_t { Lines, WhatDiffers };

// Lines: the same, one after the other, at the same instants. Without these members of the message.
std::unique_ptr<Lane> make_lines_lane(std::string name, std::vector<std::string> without,
                                      Telling telling = Telling::Lines);

// Variables, said as they change: {"set":{NAME:VALUE,…}}. `window`: where samples are not of the
// same instants, a value counts that the other has within so much time. Names that only one of
// them has are passed over.
std::unique_ptr<Lane> make_values_lane(std::string name, Duration window);

// Poses of one body: an entity of foxglove.SceneUpdate.
std::unique_ptr<Lane> make_pose_lane(std::string name);

}  // namespace vagus::record
