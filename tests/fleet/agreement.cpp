// The modelled link (fleet/modelled_broker.hpp) beside a real broker: random stories of a fleet are
// played over both, and beside them it is counted what the rules of docs/fleet.md say. Who heard
// what, and in which order from each sender, must be the same three times.
//
//     fleet_agreement TARGET FOLDER RUNS SEED
//
// FOLDER is that of `vagus fleet init`, with logins r0 to r5. Run n has the seed SEED + n, and a
// fleet of its own at the broker. Prints "run SEED: the same", or what differs, and at the end "N
// runs, M events were heard the same". Exit code 1 if something differed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fleet/member.hpp"
#include "fleet/modelled_broker.hpp"
#include "fleet/topic.hpp"
#include "relay.hpp"
#include "serve/broker/bell.hpp"
#include "serve/broker/fleet_options.hpp"
#include "story.hpp"

namespace vagus::fleet_tests {
namespace {

constexpr const char* kProbe = "probe";
constexpr Duration kModelStep = 1ms;
constexpr Duration kModelWithin = 15s;  // of virtual time: then it never comes
constexpr Duration kRealWithin = 60s;   // the same, by the wall clock

// What a story is played over. Robots are counted.
class Ways {
public:
    virtual ~Ways() = default;
    // `at`: of the story. What waits for a second passes with it.
    virtual void go_to(Time at) = 0;
    virtual fleet::Link& add(size_t robot, const fleet::Member& member) = 0;
    virtual void remove(size_t robot) = 0;
    virtual void cut(size_t robot) = 0;
    virtual void restore(size_t robot) = 0;
    // Something passes on them. False: it has been too long since begin().
    virtual bool pass() = 0;
    virtual void begin() = 0;
    // The clock that members are told.
    virtual Time now() const = 0;
    // How long it is between two events that the story says to be so far apart.
    virtual Duration apart(Duration in_the_story) const = 0;
};

class ModelledWays final : public Ways {
public:
    ModelledWays(std::string fleet, const fleet::WayModel& model, uint64_t seed)
        : fleet_(std::move(fleet)), broker_(model, seed), ways_(kRobotsMax) {}

    void go_to(Time at) override {
        now_ = at;
        broker_.pass(now_);
    }
    fleet::Link& add(size_t robot, const fleet::Member& member) override {
        ways_[robot] = &broker_.add(fleet_, member.will());
        broker_.connect(*ways_[robot]);
        return *ways_[robot];
    }
    void remove(size_t) override {}
    void cut(size_t robot) override { broker_.cut(*ways_[robot]); }
    void restore(size_t robot) override { broker_.restore(*ways_[robot]); }
    bool pass() override {
        go_to(now_ + kModelStep);
        return now_ < until_;
    }
    void begin() override { until_ = now_ + kModelWithin; }
    Time now() const override { return now_; }
    Duration apart(Duration in_the_story) const override { return in_the_story; }

private:
    const std::string fleet_;
    Time now_{}, until_{};
    fleet::ModelledBroker broker_;
    std::vector<fleet::ModelledBroker::Way*> ways_;
};

Time wall() {
    return std::chrono::duration_cast<Duration>(
        std::chrono::steady_clock::now().time_since_epoch());
}

// Members are told the time of the story: nothing of what they do depends on how fast it is.
class RealWays final : public Ways {
public:
    struct Place {
        fleet::FleetTarget target;
        std::string folder;
        uint64_t seed = 0;
    };
    explicit RealWays(Place place) : place_(std::move(place)), links_(kRobotsMax) {
        for (size_t i = 0; i < kRobotsMax; ++i) {
            relays_.push_back(std::make_unique<Relay>(place_.target.port));
        }
    }

    void go_to(Time at) override { now_ = at; }
    fleet::Link& add(size_t robot, const fleet::Member& member) override {
        const std::string name = name_of(robot);
        fleet::FleetTarget target = place_.target;
        target.port = relays_[robot]->port();
        const serve::FleetOptions options{.target = to_string(target),
                                          .ca = place_.folder + "/ca.crt",
                                          .login = place_.folder + "/" + name + ".login"};
        auto link = serve::link_options(options, fmt::format("{}-{}", name, place_.seed));
        if (!link.ok()) {
            fmt::print("{}\n", link.error().what);
            std::exit(2);
        }
        link.value().will = member.will();
        links_[robot] = std::make_unique<serve::MosquittoLink>(std::move(link.value()),
                                                               [this] { bell_.ring(); });
        return *links_[robot];
    }
    void remove(size_t robot) override { links_[robot].reset(); }
    void cut(size_t robot) override { relays_[robot]->cut(); }
    void restore(size_t robot) override { relays_[robot]->restore(); }
    bool pass() override {
        bell_.wait(20ms);
        return wall() < until_;
    }
    void begin() override { until_ = wall() + kRealWithin; }
    Time now() const override { return now_; }
    Duration apart(Duration) const override { return {}; }

private:
    const Place place_;
    Time now_{}, until_{};
    serve::Bell bell_;  // before those who ring it
    std::vector<std::unique_ptr<Relay>> relays_;
    std::vector<std::unique_ptr<serve::MosquittoLink>> links_;
};

// Plays one story, and knows who heard what.
class Play {
public:
    Play(const Story& story, Ways& ways, std::string fleet)
        : story_(story), ways_(ways), fleet_(std::move(fleet)), robots_(kRobotsMax) {}

    Heard run() {
        for (size_t i = 0; i < story_.phases.size() && wrong_.empty(); ++i) play(i);
        for (size_t i = 0; i < kRobotsMax; ++i) leave(i);
        Heard heard;
        for (Robot& robot : robots_) heard.push_back(std::move(robot.heard));
        return heard;
    }
    // What never happened; empty: everything did.
    std::string wrong(const char* where) const {
        return wrong_.empty() ? "" : fmt::format("{}: {}", where, wrong_);
    }

private:
    struct Robot {
        std::unique_ptr<fleet::Member> member = {};
        fleet::Link* link = nullptr;
        bool cut = false;
        enum class Filters { NotYet, Asked, Known } filters = Filters::NotYet;
        std::vector<FromRobot> heard = {};
        std::vector<int16_t> fences = std::vector<int16_t>(kRobotsMax, -1);  // of each sender
    };

    void play(size_t number) {
        const Phase& phase = story_.phases[number];
        ways_.go_to(kPhase * static_cast<int64_t>(number + 1));
        for (const size_t robot : phase.come) come(robot);
        all_are_in();
        for (const size_t robot : phase.go) leave(robot);
        for (const size_t robot : phase.cut) cut(robot);
        if (!phase.cut.empty()) {
            ways_.go_to(ways_.now() + fleet::kMissedAfter);
            until("the cut is noticed", [this] {
                return each([](const Robot& one) {
                    return !one.cut || one.member->standing() == fleet::Member::Standing::Apart;
                });
            });
        }
        for (const Emission& one : phase.emissions) emit(one);
        fence(static_cast<int16_t>(2 * number));
        for (const size_t robot : phase.cut) restore(robot);
        all_are_in();
        fence(static_cast<int16_t>(2 * number + 1));
    }

    void come(size_t number) {
        fleet::MemberOptions options{.fleet = fleet_,
                                     .robot = name_of(number),
                                     .instance = fmt::format("{}-instance", name_of(number)),
                                     .epoch = 1,
                                     .project = story_.robots[number],
                                     .description = {}};
        Robot& robot = robots_[number];
        robot.member = std::make_unique<fleet::Member>(std::move(options), ways_.now());
        robot.link = &ways_.add(number, *robot.member);
    }
    void leave(size_t number) {
        Robot& robot = robots_[number];
        if (!robot.member) return;
        robot.member->leave();
        turn(robot);
        ways_.remove(number);
        robot.member.reset();
    }
    void cut(size_t number) {
        robots_[number].cut = true;
        ways_.cut(number);
    }
    void restore(size_t number) {
        robots_[number].cut = false;
        robots_[number].filters = Robot::Filters::NotYet;
        ways_.restore(number);
    }

    void emit(const Emission& one) {
        robots_[one.robot].member->emitted(one.event, {one.number}, ways_.now());
        turn_all();
        for (const Time end = ways_.now() + ways_.apart(one.before_next); ways_.now() < end;) {
            ways_.pass();
            turn_all();
        }
    }

    void all_are_in() {
        until("all are in the fleet", [this] {
            return each([](const Robot& one) { return one.filters == Robot::Filters::Known; });
        });
    }
    // Whether the broker knows what the robot hears: it is asked something behind that, and the
    // question comes back.
    void look_for_filters(Robot& robot) const {
        if (robot.filters != Robot::Filters::NotYet) return;
        if (robot.member->standing() != fleet::Member::Standing::Holding) return;
        robot.filters = Robot::Filters::Asked;
        const auto number = static_cast<size_t>(&robot - robots_.data());
        robot.link->publish(
            {.topic = fleet::text_of(
                 fleet_, {.kind = fleet::Kind::Ask, .robot = name_of(number), .name = "name"}),
             .payload = fleet::payload_of(fleet::Ask{kProbe})});
    }
    static void hear_probe(Robot& robot, const fleet::LinkEvent& event) {
        const auto* received = std::get_if<fleet::Received>(&event);
        if (received == nullptr || robot.filters != Robot::Filters::Asked) return;
        const auto* ask = std::get_if<fleet::Ask>(&received->heard.message);
        if (ask != nullptr && ask->instance == kProbe) robot.filters = Robot::Filters::Known;
    }

    // What was emitted before it has come when it comes: of a sender, in order.
    void fence(int16_t number) {
        for (Robot& robot : robots_) {
            if (robot.member && !robot.cut) robot.member->emitted(kFence, {number}, ways_.now());
        }
        until("all is heard", [this, number] {
            return each([this, number](const Robot& one) { return has_heard(one, number); });
        });
    }
    bool has_heard(const Robot& by, int16_t fence) const {
        for (size_t i = 0; i < robots_.size(); ++i) {
            const Robot& other = robots_[i];
            if (by.cut || &other == &by || !other.member || other.cut) continue;
            if (by.fences[i] < fence) return false;
        }
        return true;
    }

    bool each(const std::function<bool(const Robot&)>& holds) const {
        return std::ranges::all_of(
            robots_, [&holds](const Robot& one) { return !one.member || holds(one); });
    }
    void until(const std::string& what, const std::function<bool()>& holds) {
        ways_.begin();
        for (turn_all(); !holds(); turn_all()) {
            if (ways_.pass()) continue;
            if (wrong_.empty()) {
                wrong_ = fmt::format("after {} s never: {}", ways_.now() / 1s, what);
            }
            return;
        }
    }

    void turn_all() {
        for (Robot& robot : robots_) {
            if (robot.member) turn(robot);
        }
    }
    void turn(Robot& robot) {
        for (const fleet::LinkEvent& event : robot.link->take()) {
            robot.member->hear(event, ways_.now());
            hear_probe(robot, event);
        }
        robot.member->tick(ways_.now());
        for (const fleet::MemberAction& action : robot.member->take()) {
            if (const auto* one = std::get_if<fleet::Subscribe>(&action)) {
                robot.link->subscribe(one->filters);
            } else if (const auto* post = std::get_if<fleet::Post>(&action)) {
                robot.link->publish(*post);
            } else if (const auto* event = std::get_if<fleet::EmitOnBus>(&action)) {
                hear(robot, *event);
            }
        }
        look_for_filters(robot);
    }
    static void hear(Robot& robot, const fleet::EmitOnBus& event) {
        const size_t sender = number_of(event.from);
        if (event.event == kFence) {
            robot.fences[sender] = event.args.at(0);
        } else {
            robot.heard.push_back({sender, event.event, event.args.at(0)});
        }
    }

    const Story& story_;
    Ways& ways_;
    const std::string fleet_;
    std::vector<Robot> robots_;
    std::string wrong_;
};

std::string text_of(const std::vector<FromRobot>& heard) {
    std::vector<std::string> texts;
    for (const FromRobot& one : heard) {
        texts.push_back(fmt::format("{}:{}:{}", name_of(one.robot), one.event, one.number));
    }
    return fmt::format("{}", fmt::join(texts, " "));
}

// What each heard from each sender, in order; the first that is not what is expected.
std::string difference(const char* where, const Heard& found, const Heard& expected) {
    for (size_t robot = 0; robot < kRobotsMax; ++robot) {
        for (size_t sender = 0; sender < kRobotsMax; ++sender) {
            const auto has = only_of(sender, found[robot]);
            const auto wanted = only_of(sender, expected[robot]);
            if (has == wanted) continue;
            return fmt::format("{}: {} heard [{}], expected [{}]", where, name_of(robot),
                               text_of(has), text_of(wanted));
        }
    }
    return "";
}

struct Judgement {
    size_t heard = 0;
    std::string wrong;
};

Judgement judge(const RealWays::Place& place) {
    const Story story = random_story(place.seed);
    const Heard expected = expected_of(story);
    Judgement judgement;
    for (const auto& one : expected) judgement.heard += one.size();

    const std::string fleet = place.target.fleet;
    ModelledWays modelled(fleet, story.model, place.seed);
    Play in_model(story, modelled, fleet);
    const Heard of_model = in_model.run();
    RealWays real(place);
    Play at_broker(story, real, fleet);
    const Heard of_broker = at_broker.run();
    for (const std::string& wrong :
         {in_model.wrong("modelled"), at_broker.wrong("real"),
          difference("modelled", of_model, expected), difference("real", of_broker, expected)}) {
        if (judgement.wrong.empty()) judgement.wrong = wrong;
    }
    return judgement;
}

int judge_all(const std::string& target, const std::string& folder, uint64_t runs, uint64_t first) {
    size_t heard = 0;
    uint64_t wrong = 0;
    for (uint64_t i = 0; i < runs; ++i) {
        auto place = fleet::parse_fleet_target(target);
        if (!place.ok()) return 2;
        place.value().fleet = fmt::format("run{}", i);
        const Judgement one = judge({.target = place.value(), .folder = folder, .seed = first + i});
        heard += one.heard;
        wrong += one.wrong.empty() ? 0 : 1;
        fmt::print("run {}: {}\n", first + i, one.wrong.empty() ? "the same" : one.wrong);
        std::fflush(stdout);
    }
    if (wrong == 0) fmt::print("{} runs, {} events were heard the same\n", runs, heard);
    return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace vagus::fleet_tests

int main(int count, char** words) {
    if (count != 5) {
        std::fputs("fleet_agreement mqtts://HOST:PORT/FLEET FOLDER RUNS SEED\n", stderr);
        return 2;
    }
    return vagus::fleet_tests::judge_all(words[1], words[2], std::strtoull(words[3], nullptr, 10),
                                         std::strtoull(words[4], nullptr, 10));
}
