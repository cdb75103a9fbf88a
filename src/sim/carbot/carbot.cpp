#include "sim/carbot/carbot.hpp"

#include "base/rng.hpp"

namespace vagus::sim::carbot {
namespace {

constexpr double kMass = 4.7;  // kg
constexpr double kLong = 0.40;
constexpr double kWide = 0.35;
constexpr RobotBody kBody = {.mass = kMass,
                             .inertia = kMass * (kLong * kLong + kWide * kWide) / 12,
                             .grip = kWheelAhead,
                             .height = 0.22};

// The corners are cut by 3 cm.
constexpr std::array<Point, 8> kOutline = {{{0.200, -0.145},
                                            {0.200, 0.145},
                                            {0.170, 0.175},
                                            {-0.170, 0.175},
                                            {-0.200, 0.145},
                                            {-0.200, -0.145},
                                            {-0.170, -0.175},
                                            {0.170, -0.175}}};

constexpr Point kCameraPlace = {0.16, 0};

// Each node has noise of its own.
uint64_t seed_of(uint64_t seed, Place place) {
    return SplitMix64(seed + place).next();
}

constexpr uint16_t id_of(const RobotDefinition& definition, Place place) {
    return static_cast<uint16_t>(definition.node + place);
}

}  // namespace

std::span<const Point> outline() {
    return kOutline;
}

std::optional<Point> Carbot::camera() const {
    return kCameraPlace;
}

Carbot::Carbot(Arena& arena, const RobotDefinition& definition, uint64_t seed)
    : body_(arena.add_robot({.corners = kOutline}, {definition.at, definition.angle}, kBody)),
      drive_(id_of(definition, kDrive), seed_of(seed, kDrive)),
      bumper_(id_of(definition, kBumper)),
      range_(id_of(definition, kRange), seed_of(seed, kRange)),
      head_(id_of(definition, kHead), seed_of(seed, kHead)),
      machines_{&drive_.machine(), &bumper_.machine(), &range_.machine(), &head_.machine()},
      paint_(definition.paint) {}

void Carbot::sense(const Surroundings& around) {
    drive_.sense(around);
    bumper_.sense(around, body_);
    range_.sense(around, body_);
    head_.sense(around, body_);
}

bool Carbot::drive(Arena& arena, Time) {
    arena.drive(body_, drive_.drive());
    return true;
}

void Carbot::set_button(std::string_view button, bool pressed) {
    if (button == "escape") bumper_.set_escape(pressed);
}

void Carbot::reseed(uint64_t seed) {
    drive_.reseed(seed_of(seed, kDrive));
    range_.reseed(seed_of(seed, kRange));
    head_.reseed(seed_of(seed, kHead));
}

std::vector<Lamp> Carbot::lamps() const {
    return {head_.lamp()};
}

std::vector<Beam> Carbot::beams(const Arena& arena) const {
    const std::optional<Beam> look = range_.look(arena.pose(body_));
    return look ? std::vector<Beam>{*look} : std::vector<Beam>{};
}

}  // namespace vagus::sim::carbot
