#include "fleet/rollout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/text.hpp"
#include "fleet/limits.hpp"

namespace vagus::fleet {
namespace {

// "3" or "10%" of so many; nothing: it is neither.
std::optional<size_t> read_step(std::string_view text, size_t robots) {
    const bool percent = text.ends_with('%');
    if (percent) text.remove_suffix(1);
    size_t number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end || number == 0) return std::nullopt;
    if (percent && number > 100) return std::nullopt;
    return std::min(percent ? (robots * number + 99) / 100 : number, robots);
}

std::vector<std::string> names_of(const std::vector<Rollout::Line>& lines) {
    std::vector<std::string> names;
    for (const Rollout::Line& line : lines) names.push_back(line.robot);
    return names;
}

}  // namespace

Result<std::vector<size_t>> read_steps(const std::string& text, size_t robots) {
    std::vector<size_t> steps;
    for (const std::string_view one : split(text, ',')) {
        const auto step = read_step(one, robots);
        if (!step) {
            return Error{Code::BadInput,
                         fmt::format("steps {}: expected numbers of robots or percent, such as "
                                     "1,10%,100%, found \"{}\"",
                                     text, one)};
        }
        if (steps.empty() || *step > steps.back()) steps.push_back(*step);
    }
    if (robots > 0 && (steps.empty() || steps.back() < robots)) steps.push_back(robots);
    return steps;
}

Rollout::Rollout(Options options) : options_(std::move(options)) {
    for (const std::string& robot : options_.robots) robots_[robot];
}

Rollout::Rollout(int64_t number, const std::vector<Line>& left)
    : options_{.want = {.number = number}, .robots = names_of(left)}, only_hears_(true) {
    ended_ = true;
    for (const Line& line : left) {
        robots_[line.robot] = {.place = line.place,
                               .until = Time::max(),
                               .lacks = line.place == Place::Started && !line.why.empty(),
                               .why = line.why,
                               .has = line.has};
    }
}

void Rollout::hear(const LinkEvent& event, Time now) {
    now_ = now;
    // What was said while there was no connection did not arrive.
    if (std::holds_alternative<Connected>(event) && !only_hears_) {
        for (const auto& [name, robot] : robots_) {
            if (robot.place == Place::Wanted || robot.silent) want_of(name);
        }
    }
    const auto* received = std::get_if<Received>(&event);
    if (received == nullptr) return;
    const auto found = robots_.find(received->heard.topic.robot);
    if (found == robots_.end()) return;
    const Message& message = received->heard.message;
    if (const auto* version = std::get_if<Version>(&message)) hear_version(found->second, *version);
    if (const auto* state = std::get_if<State>(&message)) hear_state(found->second, *state);
}

// Whether its next word says what came of the wish. Of a roll-out that was left nobody knows what
// its robots have said since: only one that is well is done.
bool Rollout::may_change(const Robot& robot) const {
    if (only_hears_) return robot.place != Place::Well && robot.until == Time::max();
    return robot.place == Place::Wanted || robot.silent;
}

// A robot that was told twice tells once more what came of it.
void Rollout::hear_version(Robot& robot, const Version& version) {
    if (version.number != options_.want.number) return hear_other(robot, version);
    if (version.result == "taken") return;
    if (may_change(robot)) {
        robot.silent = false;
        const bool is_back = version.result == "rolled_back";
        robot.has = version.result != "refused" && !is_back;
        if (version.result != "started") {
            return fail(robot, (is_back ? "rolled back" : version.result) + ": " + version.why);
        }
        robot.place = Place::Started;
        robot.begun = now_;
        robot.until = now_ + kHealthyFor;
    }
    if (robot.place != Place::Started) return;
    robot.lacks = version.healthy == "not_yet";
    robot.why = robot.lacks ? version.why : "";
}

// Of a wish that somebody else has told since; one before ours is heard while ours is only wanted.
void Rollout::hear_other(Robot& robot, const Version& version) {
    const bool had = robot.place == Place::Started || robot.place == Place::Well;
    if (!had || version.result != "started") return;
    robot.has = false;
    fail(robot, "somebody has given it another version since");
}

void Rollout::hear_state(Robot& robot, const State& state) {
    const bool counts = robot.place == Place::Started || robot.place == Place::Well;
    if (!counts || state.state != "fault") return;
    fail(robot, state.problems.empty() ? "a fault" : "a fault: " + state.problems.front());
}

void Rollout::fail(Robot& robot, std::string why) {
    robot.place = Place::Failed;
    robot.why = std::move(why);
}

// Whether its time is over.
void Rollout::pass(Robot& robot) {
    if (now_ < next_of(robot)) return;
    if (robot.place == Place::Wanted) {
        robot.silent = true;
        return fail(robot, "did not answer; it finds it when it is back");
    }
    if (robot.place != Place::Started) return;
    if (!robot.lacks) {
        robot.place = Place::Well;
        return;
    }
    fail(robot, fmt::format("not well within {} s of its start: {}", seconds_of(options_.within),
                            robot.why));
}

Time Rollout::next_of(const Robot& robot) const {
    if (robot.place == Place::Started && robot.lacks) {
        return only_hears_ ? Time::max() : robot.begun + options_.within;
    }
    const bool waits = robot.place == Place::Wanted || robot.place == Place::Started;
    return waits ? robot.until : Time::max();
}

void Rollout::tick(Time now) {
    now_ = now;
    for (auto& [name, robot] : robots_) pass(robot);
    const bool all_well = std::all_of(
        options_.robots.begin(), options_.robots.begin() + static_cast<std::ptrdiff_t>(wanted_),
        [this](const auto& name) { return robots_.at(name).place == Place::Well; });
    ended_ = ended_ || is_over();
    if (all_well && !ended_ && step_ < options_.steps.size()) begin_step();
}

void Rollout::begin_step() {
    const size_t end = options_.steps[step_++];
    for (; wanted_ < end; ++wanted_) {
        const std::string& name = options_.robots[wanted_];
        robots_.at(name) = {.place = Place::Wanted, .until = now_ + options_.within};
        want_of(name);
    }
}

void Rollout::want_of(const std::string& robot) {
    posts_.push_back({.topic = text_of(options_.fleet, {.kind = Kind::Want, .robot = robot}),
                      .payload = payload_of(options_.want),
                      .qos = info_of(Kind::Want).qos,
                      .retained = info_of(Kind::Want).retained});
}

Time Rollout::next_tick() const {
    Time next = Time::max();
    for (const auto& [name, robot] : robots_) next = std::min(next, next_of(robot));
    return next;
}

// Of a step that failed the others come to their end, too.
bool Rollout::is_over() const {
    if (ended_) return true;
    bool failed = false, waits = false;
    for (const auto& [name, robot] : robots_) {
        failed = failed || robot.place == Place::Failed;
        waits = waits || robot.place == Place::Wanted || robot.place == Place::Started;
    }
    return !waits && (failed || all_are_well());
}

bool Rollout::all_are_well() const {
    return std::all_of(robots_.begin(), robots_.end(),
                       [](const auto& one) { return one.second.place == Place::Well; });
}

std::vector<Rollout::Line> Rollout::table() const {
    std::vector<Line> lines;
    for (const std::string& name : options_.robots) {
        const Robot& robot = robots_.at(name);
        lines.push_back({name, robot.place, robot.why, robot.has});
    }
    return lines;
}

const char* word_of(Rollout::Place place) {
    switch (place) {
        case Rollout::Place::Later:
            return "as it was";
        case Rollout::Place::Wanted:
            return "wanted";
        case Rollout::Place::Started:
            return "started";
        case Rollout::Place::Well:
            return "well";
        case Rollout::Place::Failed:
            return "failed";
    }
    return "as it was";
}

std::string text_of(const Rollout::Line& line) {
    if (line.why.empty()) return word_of(line.place);
    return fmt::format("{}: {}", word_of(line.place), line.why);
}

}  // namespace vagus::fleet
