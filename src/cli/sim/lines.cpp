#include "cli/sim/lines.hpp"

#include <cstdio>
#include <set>
#include <utility>

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

SimLines::SimLines(const session::WorldBuses& buses, LinesOn on) : buses_(buses), on_(on) {
    for (const sim::RobotView& robot : buses.world().robots()) poses_.push_back(robot.pose);
}

bool SimLines::put(const std::string& line) const {
    if (on_ == LinesOn::Stdout) return print(line);
    say(line);
    return true;
}

bool SimLines::tell_one(Tally& tally, const session::Note& note) {
    if (tally.count++ >= kNoteLinesMax) return true;
    return put(stamp(note.at) + tally.word + "  " + visible(note.text) + "\n");
}

bool SimLines::tell_more(Tally& tally) const {
    const uint64_t count = std::exchange(tally.count, 0);
    if (count <= kNoteLinesMax) return true;
    return put(stamp(buses_.now()) + tally.word + "  and " + std::to_string(count - kNoteLinesMax) +
               " more\n");
}

bool SimLines::tell(const std::vector<session::Note>& notes) {
    bool open = true;
    for (const session::Note& note : notes) {
        switch (note.kind) {
            case session::NoteKind::Event:
                open = tell_one(events_, note) && open;
                break;
            case session::NoteKind::Loaded:
                if (!has_many_robots()) loads_.count = 0;
                open = tell_one(loads_, note) && open;
                break;
            case session::NoteKind::Fault:
                open = tell_one(faults_, note) && open;
                break;
            case session::NoteKind::Plan:
                open = tell_one(plans_, note) && open;
                break;
            case session::NoteKind::Fleet:
                open = tell_one(fleet_, note) && open;
                break;
            case session::NoteKind::Chaos:
                open = tell_one(chaos_, note) && open;
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
    if (buses_.now() < next_) return true;
    next_ = buses_.now() - buses_.now() % kStateEvery + kStateEvery;
    bool open = true;
    for (Tally* const tally : {&loads_, &events_, &faults_, &plans_, &fleet_, &chaos_})
        open = tell_more(*tally) && open;
    if (has_many_robots()) return put(summary()) && open;
    for (const sim::RobotView& robot : buses_.world().robots()) {
        open = put(state_line(buses_.of(robot.id), robot)) && open;
    }
    return open;
}

std::string SimLines::summary() {
    const auto robots = buses_.world().robots();
    size_t moving = 0;
    for (size_t i = 0; i < robots.size(); ++i) {
        if (robots[i].pose == poses_[i]) continue;
        poses_[i] = robots[i].pose;
        ++moving;
    }
    std::set<uint32_t> running, stopped;  // a robot may be several nodes
    buses_.each([&](const session::SimSession& session) {
        for (const session::NodeState& node : session.nodes()) {
            if (!node.fault.empty()) {
                stopped.insert(node.robot.number);
            } else if (node.has_script && node.state == debug::ProgramState::Running) {
                running.insert(node.robot.number);
            } else {
                // It has none, or somebody has paused or stopped it.
            }
        }
    });
    return stamp(buses_.now()) + std::to_string(robots.size()) + " robots  " +
           std::to_string(moving) + " moving  " + std::to_string(robots.size() - moving) +
           " at rest  " + std::to_string(running.size()) + " running a script  " +
           std::to_string(stopped.size()) + " stopped by a fault\n";
}

}  // namespace vagus::cli
