// FindInfrared and ReadColour: what the head's sensors are for.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "toolbox/carbot/inputs.hpp"
#include "toolbox/carbot/rover.hpp"
#include "toolbox/carbot/templates.hpp"

namespace vagus::toolbox::carbot {

namespace {

using plan::Type;
using plan::Value;

constexpr Duration kLookEvery = std::chrono::milliseconds(100);
constexpr double kTurnGain = 1.5;   // degrees a second for each degree that it is off
constexpr double kTurnMaxDeg = 60;  // a second
constexpr double kAsideDeg = 60;    // so far off it only turns

// ---- FindInfrared ----

enum InfraredState { kInfraredReached, kNoInfraredFound };

const plan::Template& find_infrared_declared() {
    static const plan::Template kDeclared{
        .name = "FindInfrared",
        .help = "Drives to the strongest infrared source that is seen.",
        .icon = "M12 12v.1M8 8a6 6 0 0 0 0 8M16 8a6 6 0 0 1 0 8M12 22v-6M9 19l3-3l3 3",
        .inputs = {{.name = "intensity",
                    .type = Type::Int,
                    .fallback = Value(int64_t{900}),
                    .help = "how bright it must be to be reached; 1000 is at the source, a metre "
                            "away it is 750",
                    .low = 1,
                    .high = 1000},
                   speed_input(),
                   {.name = "patience",
                    .type = Type::Float,
                    .fallback = Value(1.0),
                    .unit = "s",
                    .help = "how long it may be out of sight",
                    .low = 0,
                    .high = 60}},
        .outputs = {{.name = "direction",
                     .type = Type::Float,
                     .unit = "deg",
                     .help = "where it is, from ahead"},
                    {.name = "intensity", .type = Type::Int, .help = "how bright it is"}},
        .outcomes = {{"InfraredReached", "the source is so near"},
                     {"NoInfraredFound", "no source is seen"}},
        .bus = Rover::bus_of(Rover::Needs::DriveAndHead)};
    return kDeclared;
}

class FindInfrared final : public run::Actor {
public:
    explicit FindInfrared(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        const plan::Template& of = find_infrared_declared();
        bright_ = static_cast<int>(input_of(context, of, 0));
        speed_ = input_of(context, of, 1);
        patience_ = Duration(static_cast<int64_t>(input_of(context, of, 2) * 1e6));
        Rover rover(context, parts_, Rover::Needs::DriveAndHead);
        stopping(rover, [&] {
            const InfraredState state = drive_there(context, rover);
            rover.halt();
            context.end(state);
            context.out(0, Value(beacon_.direction_deg));
            context.out(1, Value(int64_t{beacon_.intensity}));
        });
    }

private:
    InfraredState drive_there(const run::ActorContext& context, Rover& rover) {
        for (Time seen_at = context.now();;) {
            beacon_ = rover.beacon();
            if (beacon_.intensity >= bright_) return kInfraredReached;
            if (beacon_.intensity > 0) {
                seen_at = context.now();
                rover.steer({speed_for(), rate_for()});
            } else {
                if (context.now() - seen_at >= patience_) return kNoInfraredFound;
                rover.steer({0, 0});
            }
            rover.wait(kLookEvery);
        }
    }

    double speed_for() const {
        return speed_ * std::max(0.0, 1 - std::fabs(beacon_.direction_deg) / kAsideDeg);
    }
    double rate_for() const {
        return std::clamp(kTurnGain * beacon_.direction_deg, -kTurnMaxDeg, kTurnMaxDeg);
    }

    const Parts& parts_;
    int bright_ = 0;
    double speed_ = 0;
    Duration patience_{};
    Beacon beacon_;
};

// ---- ReadColour ----

enum ColourState { kColourRead, kNoColour };

const plan::Template& read_colour_declared() {
    static const plan::Template kDeclared{
        .name = "ReadColour",
        .help = "Reads the colour of what is right before the robot.",
        .icon = "M12 3c4 5 6 8 6 11a6 6 0 0 1-12 0c0-3 2-6 6-11",
        .outputs = {{.name = "red", .type = Type::Float, .help = "0 to 1"},
                    {.name = "green", .type = Type::Float, .help = "0 to 1"},
                    {.name = "blue", .type = Type::Float, .help = "0 to 1"},
                    {.name = "name",
                     .type = Type::String,
                     .help = "the nearest of black, white, grey, red, yellow, green, cyan, blue, "
                             "magenta"}},
        .outcomes = {{"ColourRead", "something is there"}, {"NoColour", "nothing is within 15 cm"}},
        .bus = Rover::bus_of(Rover::Needs::Head)};
    return kDeclared;
}

struct NamedColour {
    const char* name;
    double red, green, blue;
};
constexpr std::array<NamedColour, 9> kNamed = {{{"black", 0, 0, 0},
                                                {"white", 1, 1, 1},
                                                {"grey", 0.5, 0.5, 0.5},
                                                {"red", 1, 0, 0},
                                                {"yellow", 1, 1, 0},
                                                {"green", 0, 1, 0},
                                                {"cyan", 0, 1, 1},
                                                {"blue", 0, 0, 1},
                                                {"magenta", 1, 0, 1}}};

std::string name_of(const Surface& surface) {
    const auto distance = [&surface](const NamedColour& named) {
        const double red = surface.red - named.red;
        const double green = surface.green - named.green;
        const double blue = surface.blue - named.blue;
        return red * red + green * green + blue * blue;
    };
    return std::min_element(kNamed.begin(), kNamed.end(),
                            [&](const NamedColour& a, const NamedColour& b) {
                                return distance(a) < distance(b);
                            })
        ->name;
}

class ReadColour final : public run::Actor {
public:
    explicit ReadColour(const Parts& parts) : parts_(parts) {}

    void run(run::ActorContext& context) override {
        const Surface surface = Rover(context, parts_, Rover::Needs::Head).surface();
        context.end(surface.near ? kColourRead : kNoColour);
        if (!surface.near) return;
        context.out(0, Value(surface.red));
        context.out(1, Value(surface.green));
        context.out(2, Value(surface.blue));
        context.out(3, Value(name_of(surface)));
    }

private:
    const Parts& parts_;
};

}  // namespace

run::Coded find_infrared(const Parts& parts) {
    return {
        find_infrared_declared(), [&parts] { return std::make_unique<FindInfrared>(parts); }, {}};
}

run::Coded read_colour(const Parts& parts) {
    return {read_colour_declared(), [&parts] { return std::make_unique<ReadColour>(parts); }, {}};
}

}  // namespace vagus::toolbox::carbot
