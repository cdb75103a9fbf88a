// What the terminal view shows of a session: picks the robot's figures, remembers trails and what
// changed a moment ago.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "cli/screen/view.hpp"
#include "session/sim_session.hpp"

namespace vagus::cli {

constexpr size_t kTrailPoints = 400;  // of each robot, oldest forgotten

// The sensors and wheels that are shown of a type of robot, by the names of its variables.
struct Dial {
    std::string_view label;
    std::string_view variable;
    int full = 1;
};
// Two figures of a wheel: by default what it was told and what it does.
struct WheelDial {
    std::string_view label;
    std::string_view target;
    std::string_view speed;
    std::string_view target_word = "told";
    std::string_view speed_word = "does";
};
struct Dials {
    std::vector<Dial> bars;
    std::vector<WheelDial> wheels;
};
const Dials& dials_of(sim::RobotType type);

class SimView {
public:
    explicit SimView(const session::SimSession& session);

    // Remembers where the robots are and what the variables of the selected node hold; call often.
    void follow(const session::SimSession& session, size_t selected);
    // Everything but speed, pause, keys and what is told from outside (listening, notice).
    // `selected` is the place of a node in session.nodes().
    View view(const session::SimSession& session, size_t selected) const;
    // After a reset: trails end.
    void forget();

private:
    struct Remembered {
        std::vector<int16_t> values;
        Time changed{};
    };
    PanelView panel(const session::SimSession& session, size_t selected) const;
    void follow_variables(const session::SimSession& session, uint16_t node);
    void add_variables(const session::SimSession& session, uint16_t node, PanelView& panel) const;

    GroundImage image_;
    std::map<sim::RobotId, std::deque<Point>> trails_;
    std::map<std::pair<uint16_t, std::string>, Remembered> variables_;  // by node and name
    Time next_trail_{};
};

}  // namespace vagus::cli
