#include "sim/spacing.hpp"

#include <algorithm>
#include <utility>

#include "base/trig.hpp"

namespace vagus::sim {

void Spacing::add(uint32_t index, Company company) {
    if (index >= places_.size()) places_.resize(index + 1);
    const Stand& at = sight_.stand(index);
    places_[index] = {at.x, at.y, 0, company == Company::MayBeAlone, false};
    sight_.anchor(index);
}

void Spacing::remove(uint32_t index) {
    places_[index] = {};
    std::erase(changed_, index);
}

void Spacing::set_alone(uint32_t index, bool alone) {
    if (places_[index].alone == alone) return;
    places_[index].alone = alone;
    changed_.push_back(index);
}

std::vector<uint32_t> Spacing::take_changed() {
    return std::exchange(changed_, {});
}

// How far `index`, which is at its anchor, may go until `other` could touch it. Where the leash
// of the other one is in the way, it is shortened: around where it is now, inside of what it
// was.
double Spacing::room_beside(uint32_t index, uint32_t other) {
    const Place& place = places_[index];
    Place& its = places_[other];
    const double bounds = sight_.bound(index) + sight_.bound(other) + kSkin;
    const double room = trig::hypot(its.x - place.x, its.y - place.y) - bounds - its.leash;
    if (room >= kLeashMax / 2 || its.leash <= kLeashMin) return room;
    const Stand& at = sight_.stand(other);
    const double gap = trig::hypot(at.x - place.x, at.y - place.y) - bounds;
    const double left = its.leash - trig::hypot(at.x - its.x, at.y - its.y);
    const double leash = std::min(left, std::max(gap / 2, kLeashMin));
    if (leash < kLeashMin) return room;
    its.x = at.x;
    its.y = at.y;
    its.leash = leash;
    sight_.anchor(other);
    return gap - leash;
}

void Spacing::settle(uint32_t index) {
    Place& place = places_[index];
    const Stand& at = sight_.stand(index);
    place.x = at.x;
    place.y = at.y;
    sight_.anchor(index);
    double room = sight_.room_to_fixed(index, kLeashMax + kSkin) - kSkin;
    sight_.visit_moving(index, kLeashMax + kSkin, [&](uint32_t other) {
        const double beside = room_beside(index, other);
        if (beside < kLeashMin) set_alone(other, false);
        room = std::min(room, beside);
    });
    const double needed = place.alone ? kLeashMin : kLeashMin + kAloneAgain;
    set_alone(index, place.may_be_alone && room >= needed);
    place.leash = place.alone ? std::min(room, kLeashMax) : kLeashMin;
}

}  // namespace vagus::sim
