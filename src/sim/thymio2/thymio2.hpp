// The node of a simulated Thymio II: its variables, local events and natives around a
// thymio2::Body.
#pragma once

#include <array>
#include <cstddef>

#include "sim/robot.hpp"
#include "sim/sd_card.hpp"
#include "sim/thymio2/body.hpp"

namespace vagus::sim::thymio2 {

#define VAGUS_VARIABLES "sim/thymio2/variables.def"
#include "sim/node_variables.inl"

// Numbers of the local events.
namespace event {
enum Number : uint8_t {
#define EVENT(enumerator, name, doc) enumerator,
#include "sim/thymio2/events.def"
#undef EVENT
};
}  // namespace event

// Groups of lights that one native sets: where each begins in the list of all intensities.
enum class Lamps : uint8_t {
    Top = 0,
    BottomRight = 3,
    BottomLeft = 6,
    Circle = 9,
    Buttons = 17,
    ProxH = 21,
    ProxV = 29,
    Rc = 31,
    Sound = 32,
    Temperature = 33,
    End = 35
};
constexpr int16_t kLampMax = 32;

// What the natives change beside variables.
struct Devices {
    SdCard card;
    std::array<int16_t, static_cast<size_t>(Lamps::End)> lamps{};  // 0 to kLampMax
};

extern const node::Description kDescription;

class Thymio2 : public Robot {
public:
    // `seed` is that of its noise.
    Thymio2(Arena& arena, const RobotDefinition& definition, const std::string& sd_folder,
            uint64_t seed);

    std::span<Machine* const> machines() override { return machines_; }
    BodyId body() const override { return body_.id(); }
    std::span<const Point> outline() const override { return thymio2::outline(); }
    void sense(const Surroundings& around) override;
    Time next_due(Time now) override;
    void catch_up(Time now) override;
    bool drive(Arena& arena, Time now) override;
    void knock() override;
    void set_button(std::string_view button, bool pressed) override;
    std::vector<Lamp> lamps() const override;
    std::vector<Beam> beams(const Arena& arena) const override;
    void reseed(uint64_t seed) override { noise_.reseed(seed); }
    Colour colour() const override { return paint_; }

private:
    int16_t period_of(size_t timer) const;
    void sense_distances(const Surroundings& around);
    void run_timers(Time now);
    void write(size_t offset, std::span<const int16_t> values);

    struct Timer {
        int16_t period = 0;
        Time next{};
    };

    Devices devices_;
    Machine machine_;
    std::array<Machine*, 1> machines_ = {&machine_};
    Body body_;
    Noise noise_;
    Colour paint_;
    std::array<Timer, 2> timers_;
    Time caught_up_{};  // the variables are as at this instant
    Time driven_{};     // of the last drive()
    // Speeds of the wheels before it: what an instant not after it still tells.
    std::array<int16_t, 2> speeds_before_{};
};

}  // namespace vagus::sim::thymio2
