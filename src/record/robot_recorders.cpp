#include "record/robot_recorders.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/json.hpp"

namespace vagus::record {

// Its channels have the names of that tape, below a robot.
class RobotRecorders::Below final : public Tape {
public:
    Below(Tape& tape, const std::string& robot)
        : tape_(tape), prefix_(std::string(kRobotTopics) + robot) {}

    uint16_t declare(const Topic& topic) override {
        Topic below = topic;
        below.name = prefix_ + topic.name;
        return tape_.declare(below);
    }
    void put(uint16_t topic, Time at, std::string_view data) override {
        tape_.put(topic, at, data);
    }
    void put_later(uint16_t topic, Time at, size_t about_bytes, Word word) override {
        tape_.put_later(topic, at, about_bytes, std::move(word));
    }

private:
    Tape& tape_;
    std::string prefix_;
};

RobotRecorders::RobotRecorders(Tape& tape, embed::RobotsRun& run) : run_(run) {
    for (session::RobotBus& robot : run.buses().robots()) {
        OfRobot made;
        made.tape = std::make_unique<Below>(tape, robot.name);
        made.recorder = std::make_unique<Recorder>(*made.tape, *robot.session);
        robots_.push_back(std::move(made));
    }
    run.listen([this](size_t robot, const plan::TraceEvent& event) {
        robots_[robot].recorder->trace(event);
    });
}

RobotRecorders::~RobotRecorders() {
    run_.listen({});
}

void RobotRecorders::end(Time at) {
    for (const OfRobot& one : robots_) one.recorder->end(at);
}

std::string RobotRecorders::check_member(Time at) const {
    std::string text;
    for (size_t i = 0; i < robots_.size(); ++i) {
        text += fmt::format("{}{}:{}", i > 0 ? "," : "", json_quote(run_.buses().robots()[i].name),
                            robots_[i].recorder->check_text(at));
    }
    return "\"robots\":{" + text + "}";
}

Result<std::vector<std::string>> recorded_robots(embed::RobotsRun& run) {
    std::vector<std::string> names;
    for (const session::RobotBus& robot : run.buses().robots()) names.push_back(robot.name);
    if (names.size() <= kRobotsRecordedMax) return names;
    return Error{Code::Refused,
                 fmt::format("expected at most {} robots with a project, found {}; take robots "
                             "out of the world file, or write what happens with --trace",
                             kRobotsRecordedMax, names.size())};
}

}  // namespace vagus::record
