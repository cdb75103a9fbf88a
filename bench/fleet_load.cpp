// Members of a fleet in one process, each with a connection of its own, and an operator who stops
// all robots and measures how long that takes. For bench/fleet.py.
//
//     fleet_load TARGET FOLDER members N      state at 1 Hz, three variables at 5 Hz, until killed
//     fleet_load TARGET FOLDER stop ROUNDS    milliseconds of each round: from the order to the
//                                              last answer; all robots are started again between
//
// FOLDER is that of `vagus fleet init`, with logins m0 to m(N-1) and operator.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "fleet/member.hpp"
#include "fleet/operator.hpp"
#include "serve/broker/bell.hpp"
#include "serve/broker/fleet_options.hpp"

using namespace vagus;
using namespace std::chrono_literals;

namespace {

constexpr Duration kTurn = 20ms;
constexpr Duration kVariablesEvery = 200ms;
constexpr int kTurnsOfState = 5;  // of variables: 1 Hz
constexpr Duration kRoundWithin = 60s;

Duration now() {
    return std::chrono::duration_cast<Duration>(
        std::chrono::steady_clock::now().time_since_epoch());
}

serve::LinkOptions link_to(const std::string& target, const std::string& folder,
                           const std::string& user) {
    auto options = serve::link_options(
        {.target = target, .ca = folder + "/ca.crt", .login = folder + "/" + user + ".login"},
        user + "-bench");
    if (options.ok()) return options.value();
    fmt::print("{}\n", options.error().what);
    std::exit(2);
}

struct Robot {
    Robot(const std::string& target, const std::string& folder, const std::string& name,
          serve::Bell& bell)
        : member({.fleet = "lab",
                  .robot = name,
                  .instance = name + "-bench",
                  .epoch = 1,
                  .description = {"Bench", "", "", "", {}, {}, {}, {}}},
                 now()) {
        serve::LinkOptions options = link_to(target, folder, name);
        options.will = member.will();
        link = std::make_unique<serve::MosquittoLink>(std::move(options), [&bell] { bell.ring(); });
    }

    void turn() {
        for (const fleet::LinkEvent& event : link->take()) member.hear(event, now());
        member.tick(now());
        for (const fleet::MemberAction& action : member.take()) {
            if (const auto* one = std::get_if<fleet::Subscribe>(&action)) {
                link->subscribe(one->filters);
            } else if (const auto* post = std::get_if<fleet::Post>(&action)) {
                link->publish(*post);
            } else if (const auto* obey = std::get_if<fleet::Obey>(&action)) {
                member.answer(obey->command, {.done = true});
            }
        }
    }

    fleet::Member member;
    std::unique_ptr<serve::MosquittoLink> link;
};

// What a robot shows that drives: its variables change all the time, its actor each second.
void change(Robot& robot, int turn) {
    const auto value = static_cast<int16_t>(turn);
    for (const char* const name : {"x", "y", "angle"}) {
        robot.member.changed("drive", name, {value});
    }
    robot.member.show({.state = "running", .actor = fmt::format("{}", turn / kTurnsOfState)},
                      now());
}

void members(const std::string& target, const std::string& folder, int count) {
    serve::Bell bell;
    std::vector<std::unique_ptr<Robot>> robots;
    for (int i = 0; i < count; ++i)
        robots.push_back(std::make_unique<Robot>(target, folder, fmt::format("m{}", i), bell));
    bool told = false;
    Duration change_at = now();
    for (int turn = 0;;) {
        int holding = 0;
        const bool changes = now() >= change_at;
        for (const auto& robot : robots) {
            if (changes) change(*robot, turn);
            robot->turn();
            holding += robot->member.standing() == fleet::Member::Standing::Holding ? 1 : 0;
        }
        if (changes) change_at += kVariablesEvery, ++turn;
        if (holding == count && !std::exchange(told, true)) {
            fmt::print("all {} members are in the fleet\n", count);
            std::fflush(stdout);
        }
        bell.wait(kTurn);
    }
}

class Desk {
public:
    Desk(const std::string& target, const std::string& folder)
        : desk_({.fleet = "lab", .name = "bench-desk"}),
          link_(link_to(target, folder, "operator"), [this] { bell_.ring(); }) {}

    // Milliseconds until all have answered.
    double order(const std::string& verb) {
        const Duration begun = now();
        desk_.end(order_);
        order_ = desk_.begin({{.verb = verb}, {.all = true}}, begun);
        while (!desk_.is_over(order_) && now() < begun + kRoundWithin) {
            for (const fleet::LinkEvent& event : link_.take()) desk_.hear(event, now());
            desk_.tick(now());
            for (const fleet::OperatorAction& action : desk_.take()) {
                if (const auto* one = std::get_if<fleet::Subscribe>(&action)) {
                    link_.subscribe(one->filters);
                } else {
                    link_.publish(std::get<fleet::Post>(action));
                }
            }
            bell_.wait(std::min(kTurn, Duration(desk_.next_tick() - now())));
        }
        return static_cast<double>((now() - begun).count()) / 1000;
    }
    size_t answered() const {
        size_t good = 0;
        for (const fleet::Outcome& one : desk_.outcomes(order_)) {
            good += one.answered && one.answer.done ? 1 : 0;
        }
        return good;
    }
    size_t asked() const { return desk_.outcomes(order_).size(); }

private:
    fleet::OrderNumber order_ = 0;
    serve::Bell bell_;
    fleet::Operator desk_;
    serve::MosquittoLink link_;
};

void stop(const std::string& target, const std::string& folder, int rounds) {
    Desk desk(target, folder);
    for (int i = 0; i <= rounds; ++i) {
        desk.order("start");
        const double took = desk.order("stop");
        if (i == 0) continue;  // the first one also waited for its connection
        fmt::print("stop {:.1f} {} {}\n", took, desk.answered(), desk.asked());
        std::fflush(stdout);
    }
}

}  // namespace

int main(int count, char** words) {
    if (count != 5) return 2;
    const std::string target = words[1], folder = words[2], what = words[3];
    if (what == "members") members(target, folder, std::atoi(words[4]));
    if (what == "stop") stop(target, folder, std::atoi(words[4]));
    return 0;
}
