// What keys do to a robot, as a person would with the hand: its buttons for a moment, a knock,
// driving. Keys that this robot does not have are not offered.
#pragma once

#include <string>
#include <vector>

#include "cli/screen/keys.hpp"
#include "cli/screen/view.hpp"
#include "session/sim_session.hpp"

namespace vagus::cli {

constexpr Duration kButtonFor = std::chrono::milliseconds(200);  // simulated: a key holds a button

class Hands {
public:
    // Keys that do something to such a robot. The arrows only drive a robot where nobody else does.
    static std::vector<KeyHelp> keys(sim::RobotType type);
    static std::vector<KeyHelp> keys_beside_a_plan(sim::RobotType type);

    // Does what the key says; the sentence for the screen. Empty: not a key for a robot.
    std::string act(Key key, session::SimSession& session, sim::RobotId robot);
    // Of what was held long enough.
    void release(session::SimSession& session);
    // After a restart nothing is held.
    void forget() { held_.clear(); }

private:
    struct Held {
        sim::RobotId robot;
        std::string button;
        Time until{};
    };
    std::string press(const std::string& button, session::SimSession& session, sim::RobotId robot);
    std::string drive(Key key, session::SimSession& session);

    std::vector<Held> held_;
    int16_t token_ = 0;  // of the last command by hand
};

}  // namespace vagus::cli
