#include "cli/sim/lines.hpp"

#include <cstdio>

#include "base/text.hpp"
#include "cli/output.hpp"
#include "cli/screen/degrees.hpp"
#include "cli/sim/view.hpp"

namespace vagus::cli {
namespace {

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string stamp(Time at) {
    return fixed(static_cast<double>(at.count()) / 1e6, 3) + " s  ";
}

std::string state_line(const session::SimSession& session, const sim::RobotView& robot) {
    std::string line = stamp(session.now()) + visible(robot.name) + "  at " +
                       fixed(robot.pose.at.x, 2) + ", " + fixed(robot.pose.at.y, 2) + " m  " +
                       std::to_string(degrees_shown(robot.pose.angle)) + " deg";
    const Dials& dials = dials_of(robot.type);
    for (const Dial& dial : dials.bars) {
        line += "  " + std::string(dial.label);
        for (const int16_t value : session.node_variable(robot.id, dial.variable)) {
            line += " " + std::to_string(value);
        }
    }
    for (const WheelDial& dial : dials.wheels) {
        const auto speed = session.node_variable(robot.id, dial.speed);
        if (!speed.empty()) line += "  " + std::string(dial.label) + " " + std::to_string(speed[0]);
    }
    return line + "\n";
}

}  // namespace

bool SimLines::tell(const std::vector<session::Note>& notes) {
    bool open = true;
    for (const session::Note& note : notes) {
        switch (note.kind) {
            case session::NoteKind::Event:
                if (event_lines_++ < kEventLinesMax) {
                    open = print(stamp(note.at) + "event  " + visible(note.text) + "\n") && open;
                }
                break;
            case session::NoteKind::Loaded:
                open = print(stamp(note.at) + "loaded  " + visible(note.text) + "\n") && open;
                break;
            case session::NoteKind::Fault:
                open = print(stamp(note.at) + "fault  " + visible(note.text) + "\n") && open;
                break;
            case session::NoteKind::Mistakes:
            case session::NoteKind::Warnings:
                say(note.text);
                break;
            case session::NoteKind::Trouble:
                complain(note.text);
                break;
        }
    }
    return open;
}

bool SimLines::tell_state() {
    if (session_.now() < next_) return true;
    next_ = session_.now() - session_.now() % kStateEvery + kStateEvery;
    bool open = true;
    if (event_lines_ > kEventLinesMax) {
        const uint64_t more = event_lines_ - kEventLinesMax;
        open = print(stamp(session_.now()) + "event  and " + std::to_string(more) + " more\n");
    }
    event_lines_ = 0;
    for (const sim::RobotView& robot : session_.world().robots()) {
        open = print(state_line(session_, robot)) && open;
    }
    return open;
}

}  // namespace vagus::cli
