// Which bodies can touch anything soon? A body that nothing can reach for some steps needs no
// solver: it moves as its wheels say. Most bodies of a wide world are alone most of the time.
//
// Each body that moves has an anchor, a place where it was, and a leash, how far it may go from
// there. A body is alone while the discs around all anchors, as wide as body, leash and kSkin,
// do not reach its own, nor do walls. So nobody has to look around before the leash is used up.
//
//     spacing.settle(index);                 // after it moved: looks around
//     if (spacing.has_strayed(index)) …      // after each step; cheap
//     for (uint32_t each : spacing.take_changed()) act(each, spacing.is_alone(each));
#pragma once

#include <cstdint>
#include <vector>

#include "sim/definitions.hpp"
#include "sim/sight.hpp"

namespace vagus::sim {

constexpr double kLeashMin = 0.006;  // m
// How much of the way to each other two bodies keep free: more than both can pass their leashes by
// in one step, and the distance at which the solver takes them for touching.
constexpr double kSkin = 0.012;
constexpr double kAloneAgain = 0.01;  // m more room than kLeashMin: nobody changes to and fro

enum class Company : uint8_t { MayBeAlone, Never };

class Spacing {
public:
    // `sight` knows where bodies are and how wide they are; it must outlive this.
    explicit Spacing(Sight& sight) : sight_(sight) {}

    // A body that moves, known to sight. It has company until it is settled.
    void add(uint32_t index, Company company);
    void remove(uint32_t index);

    bool is_alone(uint32_t index) const { return places_[index].alone; }
    bool has_strayed(uint32_t index) const {
        const Place& place = places_[index];
        const Stand& at = sight_.stand(index);
        const double x = at.x - place.x;
        const double y = at.y - place.y;
        return x * x + y * y > place.leash * place.leash;
    }
    // Anchors it where it is now. Others may no longer be alone then.
    void settle(uint32_t index);
    // Those of which is_alone() has changed since.
    std::vector<uint32_t> take_changed();

private:
    struct Place {
        double x = 0, y = 0;  // the anchor
        double leash = 0;
        bool may_be_alone = false;
        bool alone = false;
    };

    double room_beside(uint32_t index, uint32_t other);
    void set_alone(uint32_t index, bool alone);

    Sight& sight_;
    std::vector<Place> places_;
    std::vector<uint32_t> changed_;
};

}  // namespace vagus::sim
