#include "cli/sim/hands.hpp"

#include <algorithm>
#include <array>

namespace vagus::cli {
namespace {

// How the arrows drive a robot by hand, until its script misses signs of life: mm/s, 0.1 deg/s.
constexpr int16_t kHandSpeed = 200;
constexpr int16_t kHandRate = 600;
constexpr int16_t kTokenMax = 0x7fff;

bool has_button(sim::RobotType type, std::string_view button) {
    const auto names = sim::buttons_of(type);
    return std::find(names.begin(), names.end(), button) != names.end();
}

// The one that keys e and b press: that ends what the robot does, or starts it.
std::string main_button(sim::RobotType type) {
    for (const char* button : {"escape", "center"}) {
        if (has_button(type, button)) return button;
    }
    return "";
}

sim::RobotType type_of(const session::SimSession& session, sim::RobotId robot) {
    return session.world().definition().robots.at(robot.number - 1).type;
}

std::string arrow_button(Key key) {
    switch (key) {
        case Key::Forward:
            return "forward";
        case Key::Backward:
            return "backward";
        case Key::Left:
            return "left";
        case Key::Right:
            return "right";
        default:
            return "";
    }
}

}  // namespace

std::vector<KeyHelp> Hands::keys_beside_a_plan(sim::RobotType type) {
    std::vector<KeyHelp> keys;
    const std::string button = main_button(type);
    if (!button.empty()) keys.push_back({button == "escape" ? "e" : "b", button + " button"});
    if (sim::feels_knocks(type)) keys.push_back({"t", "tap"});
    return keys;
}

std::vector<KeyHelp> Hands::keys(sim::RobotType type) {
    std::vector<KeyHelp> keys = keys_beside_a_plan(type);
    if (has_button(type, "forward")) keys.push_back({"arrows", "buttons"});
    if (type == sim::RobotType::Carbot) keys.push_back({"arrows", "drive"});
    return keys;
}

std::string Hands::act(Key key, session::SimSession& session, sim::RobotId robot) {
    const sim::RobotType type = type_of(session, robot);
    if (key == Key::Escape || key == Key::Centre) {
        const std::string button = main_button(type);
        return button.empty() ? "this robot has no button" : press(button, session, robot);
    }
    if (key == Key::Tap) {
        if (!sim::feels_knocks(type)) return "this robot does not feel a tap";
        const Status done = session.world().tap(robot);
        return done.ok() ? "tapped" : done.error().what;
    }
    const std::string button = arrow_button(key);
    if (button.empty()) return "";
    return has_button(type, button) ? press(button, session, robot) : drive(key, session);
}

std::string Hands::press(const std::string& button, session::SimSession& session,
                         sim::RobotId robot) {
    const Status done = session.world().press(robot, button);
    if (!done.ok()) return done.error().what;
    held_.push_back({robot, button, session.now() + kButtonFor});
    return button + " button is pressed";
}

// The driving events of docs/carbot.md, if the script has them. Each key is a command of its own,
// so that one after a touch is obeyed.
std::string Hands::drive(Key key, session::SimSession& session) {
    int16_t speed = 0;
    int16_t rate = 0;
    if (key == Key::Forward) speed = kHandSpeed;
    if (key == Key::Backward) speed = -kHandSpeed;
    if (key == Key::Left) rate = kHandRate;
    if (key == Key::Right) rate = -kHandRate;
    token_ = token_ == kTokenMax ? int16_t{1} : static_cast<int16_t>(token_ + 1);
    const std::array<int16_t, 3> arguments = {token_, speed, rate};
    const Status done = session.emit("drive.steer", arguments, session.now());
    return done.ok() ? "driven by hand" : "this robot has no buttons that the arrows could press";
}

void Hands::release(session::SimSession& session) {
    std::erase_if(held_, [&session](const Held& held) {
        if (session.now() < held.until) return false;
        (void)session.world().release(held.robot, held.button).ok();  // it was pressed: it is there
        return true;
    });
}

}  // namespace vagus::cli
