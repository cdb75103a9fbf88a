#include "record/keyframe_instants.hpp"

#include <algorithm>

namespace vagus::record {

namespace {

// Twice as far for each time that the age doubles, so that gaps are multiples of each other.
Duration apart_at(Duration age) {
    constexpr int kGapsOfAnAge = 4;
    Duration apart = kKeyframesApartMin;
    while (apart * 2 * kGapsOfAnAge <= age) {
        if (apart * 2 > kKeyframesApartMax && age <= kKeyframesHour) break;
        apart *= 2;
    }
    return apart;
}

Time floor_to(Time at, Duration step) {
    return at / step * step;
}

}  // namespace

std::vector<Time> keyframe_instants(Time newest) {
    std::vector<Time> instants;
    Time at = floor_to(newest, kKeyframesApartMin);
    while (at > Time{} && instants.size() < kKeyframesMax) {
        const Time wanted = floor_to(at, apart_at(newest - at));
        if (wanted == at) {
            instants.push_back(at);
            at -= kKeyframesApartMin;
        } else {
            at = wanted;  // older, so perhaps further apart
        }
    }
    std::ranges::reverse(instants);
    return instants;
}

}  // namespace vagus::record
