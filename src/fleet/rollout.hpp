// Another version for many robots, in steps: who should have it, who has it and is well, and when
// the next ones follow. The first robot that is not well stops it. A state machine, as Operator is.
//
//     Rollout rollout({.fleet = "lab", .want = want, .robots = {"r1", "r2"}, .steps = {1, 2}});
//     for (const LinkEvent& event : link.take()) rollout.hear(event, now);
//     rollout.tick(now);
//     for (const Post& post : rollout.take()) link.publish(post);
//     for (const Rollout::Line& line : rollout.table()) show(line.robot, text_of(line));
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "fleet/limits.hpp"
#include "fleet/link.hpp"

namespace vagus::fleet {

constexpr const char* kStepsUnlessTold = "1,10%,100%";

// "1,10%,100%": how many of so many robots have it after each step. The last step is all.
Result<std::vector<size_t>> read_steps(const std::string& text, size_t robots);

class Rollout {
public:
    enum class Place { Later, Wanted, Started, Well, Failed };

    // What became of a robot; `why` of Failed, and of Started what its project's condition
    // lacks.
    struct Line {
        std::string robot;
        Place place = Place::Later;
        std::string why = {};
        bool has = false;  // the version is in force there
        friend bool operator==(const Line&, const Line&) = default;
    };

    struct Options {
        std::string fleet = {};
        Want want = {};
        std::vector<std::string> robots = {};  // in this order
        std::vector<size_t> steps = {};        // how many of them; the last is all
        // Of a robot: from the want to its start, and from there until its condition was true.
        Duration within = 60s;
    };
    explicit Rollout(Options options);
    // The one of this number that another program gave and left: where its robots were. It is only
    // heard what becomes of them, without a deadline, because nobody knows when they started.
    Rollout(int64_t number, const std::vector<Line>& left);

    // Also what was said before it began.
    void hear(const LinkEvent& event, Time now);
    void tick(Time now);
    Time next_tick() const;
    std::vector<Post> take() { return std::exchange(posts_, {}); }

    // Nobody else gets it from now on; it is still heard what becomes of those that do.
    void stop() { ended_ = true; }
    // All are well, or one is not: then nobody else gets it. A robot that did not answer may still
    // find it, and its line says so.
    bool is_over() const;
    bool all_are_well() const;
    // In their order.
    std::vector<Line> table() const;
    const Want& want() const { return options_.want; }

private:
    struct Robot {
        Place place = Place::Later;
        Time until{};        // Wanted: it has started; Started: it is well
        Time begun{};        // Started: since when
        bool lacks = false;  // Started: its project's condition was not true for long enough yet
        std::string why = {};
        bool silent = false;  // Failed: it did not answer
        bool has = false;
    };
    bool may_change(const Robot& robot) const;
    void hear_version(Robot& robot, const Version& version);
    void hear_other(Robot& robot, const Version& version);
    void hear_state(Robot& robot, const State& state);
    void pass(Robot& robot);
    Time next_of(const Robot& robot) const;
    void fail(Robot& robot, std::string why);
    void begin_step();
    void want_of(const std::string& robot);

    const Options options_;
    const bool only_hears_ = false;
    std::map<std::string, Robot> robots_;
    bool ended_ = false;
    size_t step_ = 0;    // the next one
    size_t wanted_ = 0;  // so many robots, of the first
    std::vector<Post> posts_;
    Time now_{};
};

// "as it was", "wanted", "started", "well", "failed: refused: it has mistakes".
const char* word_of(Rollout::Place place);
std::string text_of(const Rollout::Line& line);

}  // namespace vagus::fleet
