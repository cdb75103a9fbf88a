#include "sim/thymio2/thymio2.hpp"

#include <algorithm>

namespace vagus::sim::thymio2 {
namespace {

static_assert(sizeof(Layout) == 74 * kWord, "docs/spec 5.2: 74 words are described");

// Sizes in words (docs/spec, 5.2).
constexpr uint16_t kBytecodeSize = 1534;
constexpr uint16_t kStackSize = 32;
constexpr uint16_t kVariablesSize = 586;
constexpr int16_t kProductId = 8;
constexpr int16_t kFirmwareVersion = 11;
constexpr int16_t kTemperature = 220;  // tenths of a degree
constexpr int16_t kOneG = 23;          // of the accelerometer, whose third axis looks down

// Events a second.
constexpr int64_t kMotorRate = 100;
constexpr int64_t kButtonsRate = 20;
constexpr int64_t kProxRate = 10;
constexpr int64_t kAccRate = 16;
constexpr int64_t kTemperatureRate = 1;

}  // namespace

#define VARIABLE_OF(field) machine_.variable(ADDRESS(field))

Thymio2::Thymio2(Arena& arena, const RobotDefinition& definition, const std::string& sd_folder,
                 uint64_t seed)
    : devices_{SdCard(sd_folder), {}},
      machine_({.description = &kDescription,
                .id = definition.node,
                .bytecode_size = kBytecodeSize,
                .stack_size = kStackSize,
                .variables_size = kVariablesSize,
                .robot = &devices_}),
      body_(arena, {definition.at, definition.angle}),
      noise_(seed),
      paint_(definition.paint) {
    VARIABLE_OF(id) = static_cast<int16_t>(definition.node);
    VARIABLE_OF(product_id) = kProductId;
    VARIABLE_OF(fwversion) = kFirmwareVersion;
    VARIABLE_OF(temperature) = kTemperature;
    VARIABLE_OF(sd_present) = devices_.card.present() ? 1 : 0;
}

void Thymio2::write(size_t offset, std::span<const int16_t> values) {
    for (size_t i = 0; i < values.size(); ++i)
        machine_.variable(static_cast<uint16_t>(offset / kWord + i)) = values[i];
}

// Events that come by themselves, and the rate of each, in the order of the original: after the
// timers, at one instant.
struct Steady {
    uint8_t event;
    int64_t rate;
};
constexpr Steady kSteady[] = {{event::Motor, kMotorRate},
                              {event::Buttons, kButtonsRate},
                              {event::Prox, kProxRate},
                              {event::Acc, kAccRate},
                              {event::Temperature, kTemperatureRate}};

void Thymio2::sense(const Surroundings& around) {
    run_timers(around.now);
    catch_up(around.now);
    if (is_due(around.now, kProxRate)) sense_distances(around);
    for (const auto& [event, rate] : kSteady)
        if (is_due(around.now, rate)) machine_.raise(event);
}

// Its distances it senses at every instant of theirs: their noise goes on.
Time Thymio2::next_due(Time now) {
    if (machine_.is_busy()) return now + kNodeStep;
    Time next = next_time(now, kProxRate);
    for (const auto& [event, rate] : kSteady)
        if (machine_.hears(event)) next = std::min(next, next_time(now, rate));
    for (size_t i = 0; i < timers_.size(); ++i) {
        const Timer& timer = timers_[i];
        if (period_of(i) != timer.period) return now + kNodeStep;
        if (timer.period > 0) next = std::min(next, timer.next);
    }
    return next;
}

// What the steady events write, and their trace, where nobody hears them.
void Thymio2::catch_up(Time now) {
    const auto has_passed = [&](int64_t rate) {
        return times_due(now, rate) > times_due(caught_up_, rate);
    };
    if (now <= caught_up_) return;
    if (has_passed(kMotorRate)) {
        const bool before = now / kPhysicsStep * kPhysicsStep <= driven_;
        VARIABLE_OF(motor_left_speed) = before ? speeds_before_[0] : body_.left_speed();
        VARIABLE_OF(motor_right_speed) = before ? speeds_before_[1] : body_.right_speed();
        if (!machine_.hears(event::Motor) && !machine_.is_busy())
            machine_.pass_unheard(event::Motor);
    }
    if (has_passed(kAccRate)) write(offsetof(Layout, acc), std::array<int16_t, 3>{0, 0, kOneG});
    if (has_passed(kTemperatureRate)) VARIABLE_OF(temperature) = kTemperature;
    caught_up_ = now;
}

int16_t Thymio2::period_of(size_t timer) const {
    return machine_.variable(static_cast<uint16_t>(ADDRESS(timer_period) + timer));
}

void Thymio2::sense_distances(const Surroundings& around) {
    write(offsetof(Layout, prox_horizontal), body_.look(around.arena, noise_).values);
    const GroundReadings down =
        body_.look_down(around.arena.pose(body_.id()), around.ground, noise_);
    write(offsetof(Layout, prox_ground_ambiant), down.ambient);
    write(offsetof(Layout, prox_ground_reflected), down.reflected);
    write(offsetof(Layout, prox_ground_delta), down.reflected);
}

// A change of a period restarts its count; a negative one is none (docs/spec, D18).
void Thymio2::run_timers(Time now) {
    for (size_t i = 0; i < timers_.size(); ++i) {
        Timer& timer = timers_[i];
        const int16_t period = period_of(i);
        if (period != timer.period) {
            timer.period = period;
            timer.next = now + std::chrono::milliseconds(period);
        }
        if (period <= 0 || now < timer.next) continue;
        timer.next += std::chrono::milliseconds(period);
        machine_.raise(static_cast<uint8_t>(event::Timer0 + i));
    }
}

bool Thymio2::drive(Arena& arena, Time now) {
    speeds_before_ = {body_.left_speed(), body_.right_speed()};
    driven_ = now;
    return body_.drive(arena, VARIABLE_OF(motor_left_target), VARIABLE_OF(motor_right_target));
}

void Thymio2::knock() {
    machine_.raise(event::Tap);
}

void Thymio2::set_button(std::string_view button, bool pressed) {
    const auto names = buttons_of(RobotType::Thymio2);
    const auto found = std::find(names.begin(), names.end(), button);
    if (found == names.end()) return;
    const auto index = static_cast<uint8_t>(found - names.begin());
    int16_t& variable = machine_.variable(static_cast<uint16_t>(ADDRESS(button_backward) + index));
    const int16_t value = pressed ? 1 : 0;
    if (variable == value) return;
    variable = value;
    machine_.raise(static_cast<uint8_t>(event::ButtonBackward + index));
}

namespace {

struct LampPlace {
    const char* name;
    Point at;
    Colour colour;  // at full intensity; of an RGB part only its own component
};

constexpr Colour kRed = {1, 0, 0};
constexpr Colour kOrange = {1, 0.6, 0};
constexpr Colour kBlue = {0, 0.3, 1};

// In the order of Lamps, without the three RGB lights that come first.
constexpr LampPlace kLampPlaces[] = {
    {"leds.circle", {0.042, 0}, kOrange},      {"leds.circle", {0.037, -0.012}, kOrange},
    {"leds.circle", {0.025, -0.017}, kOrange}, {"leds.circle", {0.013, -0.012}, kOrange},
    {"leds.circle", {0.008, 0}, kOrange},      {"leds.circle", {0.013, 0.012}, kOrange},
    {"leds.circle", {0.025, 0.017}, kOrange},  {"leds.circle", {0.037, 0.012}, kOrange},
    {"leds.buttons", {0.035, 0}, kRed},        {"leds.buttons", {0.025, -0.010}, kRed},
    {"leds.buttons", {0.015, 0}, kRed},        {"leds.buttons", {0.025, 0.010}, kRed},
    {"leds.prox.h", {0.060, 0.050}, kRed},     {"leds.prox.h", {0.073, 0.026}, kRed},
    {"leds.prox.h", {0.079, 0.006}, kRed},     {"leds.prox.h", {0.079, -0.006}, kRed},
    {"leds.prox.h", {0.073, -0.026}, kRed},    {"leds.prox.h", {0.060, -0.050}, kRed},
    {"leds.prox.h", {-0.029, 0.030}, kRed},    {"leds.prox.h", {-0.029, -0.030}, kRed},
    {"leds.prox.v", {0.072, 0.012}, kRed},     {"leds.prox.v", {0.072, -0.012}, kRed},
    {"leds.rc", {-0.020, 0.040}, kRed},        {"leds.sound", {-0.020, -0.030}, kBlue},
    {"leds.temperature", {0, -0.050}, kRed},   {"leds.temperature", {0.005, -0.050}, kBlue}};

constexpr struct {
    const char* name;
    Point at;
} kColourPlaces[] = {{"leds.top", {0.010, 0}},
                     {"leds.bottom.right", {0.020, -0.050}},
                     {"leds.bottom.left", {0.020, 0.050}}};

double share(int16_t level) {
    return static_cast<double>(level) / kLampMax;
}

}  // namespace

std::vector<Lamp> Thymio2::lamps() const {
    std::vector<Lamp> all;
    const auto& levels = devices_.lamps;
    size_t next = 0;
    for (const auto& [name, at] : kColourPlaces) {
        all.push_back(
            {name, at, {share(levels[next]), share(levels[next + 1]), share(levels[next + 2])}});
        next += 3;
    }
    for (const auto& [name, at, colour] : kLampPlaces) {
        const double level = share(levels[next++]);
        all.push_back({name, at, {level * colour.r, level * colour.g, level * colour.b}});
    }
    return all;
}

std::vector<Beam> Thymio2::beams(const Arena& arena) const {
    return body_.beams(arena);
}

}  // namespace vagus::sim::thymio2
