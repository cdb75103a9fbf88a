#include "toolbox/carbot/rover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "toolbox/bus_template.hpp"

namespace vagus::toolbox::carbot {

using run::BusEvent;
using run::CodeError;

namespace {

constexpr BusValue kPlace{.scale = 10, .words = 2};
constexpr BusValue kTenth{.scale = 10, .words = 1};
constexpr BusValue kThousandth{.scale = 1000, .words = 1};
constexpr BusValue kWhole{.scale = 1, .words = 1};
constexpr Duration kGrace{plan::kGraceDefaultMs * 1000};

std::vector<NodeNames> nodes_of(Rover::Needs needs) {
    switch (needs) {
        case Rover::Needs::Range:
            return {{"range"}};
        case Rover::Needs::Drive:
            return {{"drive"}};
        case Rover::Needs::Head:
            return {{"head"}};
        case Rover::Needs::DriveAndHead:
            return {{"drive"}, {"head"}};
        case Rover::Needs::DriveAndRange:
            break;
    }
    return {{"drive"}, {"range"}};
}

double number(const BusEvent& event, size_t at, const BusValue& as) {
    if (at + static_cast<size_t>(as.words) > event.arguments.size()) {
        throw CodeError(fmt::format("the event \"{}\" came with {} words after its token, too few",
                                    event.name, event.arguments.size()));
    }
    return decode(plan::Type::Float, as, event.arguments.data() + at).number();
}

Echo echo_of(const BusEvent& event) {
    return {.angle_deg = number(event, 0, kTenth), .distance_cm = number(event, 1, kTenth)};
}

}  // namespace

int16_t tenths(double value) {
    return static_cast<int16_t>(std::clamp(std::round(value * 10), -32768.0, 32767.0));
}

Rover::Rover(run::ActorContext& context, const Parts& parts, Needs needs)
    : context_(context),
      talk_(context, parts, nodes_of(needs),
            {"range.measured", "range.done", "drive.odometry", "drive.stopped", "infrared.told",
             "colour.told"},
            "drive.ended"),
      ranges_(needs == Needs::Range || needs == Needs::DriveAndRange) {}

plan::BusUse Rover::bus_of(Needs needs) {
    plan::BusUse use;
    use.nodes = nodes_of(needs);
    const auto add = [&use](std::initializer_list<const char*> starts,
                            std::initializer_list<const char*> others) {
        use.starts.insert(use.starts.end(), starts.begin(), starts.end());
        use.events.insert(use.events.end(), starts.begin(), starts.end());
        use.events.insert(use.events.end(), others.begin(), others.end());
    };
    for (const NodeNames& node : use.nodes) {
        if (node.front() == "drive")
            add({"drive.steer"}, {"drive.stop", "drive.ask", "drive.stopped", "drive.odometry"});
        if (node.front() == "range")
            add({"range.look", "range.scan"}, {"range.unwatch", "range.measured", "range.done"});
        if (node.front() == "head")
            add({"infrared.ask", "colour.ask"}, {"infrared.told", "colour.told"});
    }
    return use;
}

void Rover::steer(const Steering& steering) {
    steering_ = steering;
    moves_ = true;
    say_steering();
}

void Rover::say_steering() {
    talk_.say("drive.steer", {tenths(steering_->speed_cm), tenths(steering_->rate_deg)});
    steer_again_ = context_.now() + kSteerPeriod;
}

void Rover::halt() {
    steering_.reset();
    talk_.say("drive.stop");
    await("drive.stopped", "drive.stopped");
    moves_ = false;
}

void Rover::stop() {
    if (ranges_) talk_.say("range.unwatch");
    if (moves_) talk_.stop("drive.stop", "drive.stopped", kGrace);
}

Echo Rover::look(double angle_deg) {
    talk_.say("range.look", {tenths(angle_deg)});
    return echo_of(await("range.measured", "range.measured"));
}

std::vector<Echo> Rover::scan(double from_deg, double to_deg, double step_deg) {
    talk_.say("range.scan", {tenths(from_deg), tenths(to_deg), tenths(step_deg)});
    std::vector<Echo> echoes;
    for (;;) {
        const BusEvent event = await("range.measured", "range.done");
        if (event.name == "range.done") return echoes;
        if (echoes.size() == kEchoesMax) {
            throw CodeError(
                fmt::format("the scan gave more than {} distances; look at the script "
                            "of the node \"range\"",
                            kEchoesMax));
        }
        echoes.push_back(echo_of(event));
    }
}

Pose Rover::pose() {
    talk_.say("drive.ask");
    const BusEvent told = await("drive.odometry", "drive.odometry");
    return {number(told, 0, kPlace), number(told, 2, kPlace), number(told, 4, kTenth)};
}

Beacon Rover::beacon() {
    talk_.say("infrared.ask");
    const BusEvent told = await("infrared.told", "infrared.told");
    return {number(told, 0, kTenth), static_cast<int>(number(told, 1, kWhole))};
}

Surface Rover::surface() {
    talk_.say("colour.ask");
    const BusEvent told = await("colour.told", "colour.told");
    return {number(told, 0, kWhole) != 0, number(told, 1, kThousandth),
            number(told, 2, kThousandth), number(told, 3, kThousandth)};
}

void Rover::wait(Duration time) {
    for (const Time end = context_.now() + time; context_.now() < end;) hear_until(end);
}

// The next event until then; says the steering again as it falls due.
std::optional<BusEvent> Rover::hear_until(Time end) {
    const Time until = steering_ ? std::min(end, steer_again_) : end;
    std::optional<BusEvent> event = talk_.hear(std::max(until - context_.now(), Duration{0}));
    if (steering_ && context_.now() >= steer_again_) say_steering();
    return event;
}

BusEvent Rover::await(const std::string& one, const std::string& other) {
    for (const Time end = context_.now() + kAnswerWithin; context_.now() < end;) {
        std::optional<BusEvent> event = hear_until(end);
        if (event && (event->name == one || event->name == other)) return std::move(*event);
    }
    throw CodeError(fmt::format("no \"{}\" came within {} s; is the script of the node loaded?",
                                other, kAnswerWithin / std::chrono::seconds(1)));
}

}  // namespace vagus::toolbox::carbot
