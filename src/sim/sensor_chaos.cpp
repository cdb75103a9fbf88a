#include "sim/sensor_chaos.hpp"

#include <algorithm>
#include <cmath>

#include "sim/noise.hpp"

namespace vagus::sim {

void SensorChaos::give_back(Machine& machine) const {
    for (size_t i = 0; begun_ && i < shown_.size(); ++i) {
        int16_t& word = machine.variable(static_cast<uint16_t>(address_ + i));
        if (word == shown_[i]) word = sensed_[i];
    }
}

void SensorChaos::spoil(Machine& machine, Time now) {
    std::vector<int16_t> sensed;
    for (size_t i = 0; i < sensed_.size(); ++i) {
        sensed.push_back(machine.variable(static_cast<uint16_t>(address_ + i)));
    }
    const bool first = !std::exchange(begun_, true);
    const bool is_new = first || sensed != sensed_ || now - drawn_ >= kNoiseLasts;
    sensed_ = std::move(sensed);
    if (first && fault_->kind == ChaosKind::Stuck) shown_ = sensed_;
    if (fault_->kind == ChaosKind::Noisy && is_new) {
        drawn_ = now;
        for (size_t i = 0; i < shown_.size(); ++i) shown_[i] = spoilt(sensed_[i]);
    }
    for (size_t i = 0; i < shown_.size(); ++i) {
        machine.variable(static_cast<uint16_t>(address_ + i)) = shown_[i];
    }
}

int16_t SensorChaos::spoilt(int16_t value) {
    const double noisy = value + fault_->by * Noise(random_.next()).next();
    return static_cast<int16_t>(std::clamp<double>(std::floor(noisy + 0.5), -32768, 32767));
}

}  // namespace vagus::sim
