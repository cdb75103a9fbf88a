// What a look around gives: how far things are in each direction.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "plan/value.hpp"

namespace vagus::toolbox::carbot {

struct Echo {
    double angle_deg = 0;    // counter-clockwise from ahead
    double distance_cm = 0;  // from the sensor; 0: nothing within its reach
};

// The value of LookAround's output: in the order in which the sensor turned.
class DistanceMap final : public plan::ObjectData {
public:
    static constexpr std::string_view kTag = "distance-map";

    explicit DistanceMap(std::vector<Echo> echoes) : echoes_(std::move(echoes)) {}
    std::string_view tag() const override { return kTag; }
    const std::vector<Echo>& echoes() const { return echoes_; }

private:
    std::vector<Echo> echoes_;
};

}  // namespace vagus::toolbox::carbot
