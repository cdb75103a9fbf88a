// Many robots of a fleet for tests that look at one: real members with real connections, which do
// nothing but tell a state, obey, and send the events that they are told to emit. A variable that
// is set becomes a fault of that name.
//
//     fleet_crowd TARGET ROBOTS CHANGING [NAME]
//
// Robots are r1 to rN, or all of them want the one NAME. Those up to CHANGING do something else
// five times a second. It prints "crowd N" when all of them are in the fleet, with a NAME "N in, M
// out" whenever that changes, and ends with SIGINT or SIGTERM.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fleet/limits.hpp"
#include "fleet/member.hpp"
#include "net/end_signal.hpp"
#include "serve/broker/bell.hpp"
#include "serve/broker/fleet_options.hpp"

namespace {

using namespace vagus;
using namespace std::chrono_literals;

Time now() {
    return std::chrono::duration_cast<Duration>(
        std::chrono::steady_clock::now().time_since_epoch());
}

class Robot {
public:
    Robot(const std::string& target, const std::string& name, std::function<void()> wake)
        : member_(options_of(target, name), now()) {
        serve::LinkOptions link =
            serve::link_options({.target = target}, serve::operator_name()).value();
        link.will = member_.will();
        link_ = std::make_unique<serve::MosquittoLink>(std::move(link), std::move(wake));
    }

    void turn() {
        for (const fleet::LinkEvent& event : link_->take()) member_.hear(event, now());
        member_.show(shown_, now());
        member_.tick(now());
        for (const fleet::MemberAction& action : member_.take()) perform(action);
    }
    void leave() {
        member_.leave();
        turn();
    }
    void do_something_else(int64_t beat) {
        if (shown_.state == "running") shown_.actor = fmt::format("step{}", beat);
    }
    bool is(fleet::Member::Standing standing) const { return member_.standing() == standing; }

private:
    static fleet::MemberOptions options_of(const std::string& target, const std::string& name) {
        fleet::MemberOptions options{.fleet = fleet::parse_fleet_target(target).value().fleet,
                                     .robot = name,
                                     .instance = serve::operator_name(),
                                     .epoch = 1};
        options.project.send = {"alarm"};
        options.description = {.project = "crowd",
                               .vagus = "1.0.0",
                               .studio = "http://127.0.0.1:1/" + name,
                               .groups = {name.size() % 2 == 0 ? "red" : "blue"},
                               .send = {"alarm"},
                               .hear = {"alarm"}};
        return options;
    }

    void perform(const fleet::MemberAction& action) {
        if (const auto* filters = std::get_if<fleet::Subscribe>(&action)) {
            link_->subscribe(filters->filters);
        } else if (const auto* post = std::get_if<fleet::Post>(&action)) {
            link_->publish(*post);
        } else if (const auto* obey = std::get_if<fleet::Obey>(&action)) {
            this->obey(obey->command);
        }
    }

    // What is set becomes its problem.
    void fail(const std::string& why) {
        shown_.state = "fault";
        shown_.problems = {why};
    }

    void obey(const fleet::Command& command) {
        if (command.verb == "stop") shown_ = {.state = "stopped"};
        if (command.verb == "start" || command.verb == "continue") shown_ = {.state = "running"};
        if (command.verb == "pause") shown_.state = "paused";
        if (command.verb == "set") fail(command.name);
        if (command.verb == "emit") member_.emitted(command.event, command.values, now());
        member_.answer(command, {.done = true});
    }

    fleet::Member member_;
    std::unique_ptr<serve::MosquittoLink> link_;
    fleet::Shown shown_{.state = "running", .actor = "wait"};
};

using Robots = std::vector<std::unique_ptr<Robot>>;

// What is told once.
std::string news_of(const Robots& robots, bool of_one_name) {
    using Standing = fleet::Member::Standing;
    const auto count = [&robots](Standing standing) {
        return std::ranges::count_if(robots, [standing](auto& one) { return one->is(standing); });
    };
    const auto in = count(Standing::Holding);
    if (of_one_name) return fmt::format("{} in, {} out", in, count(Standing::Out));
    return static_cast<size_t>(in) == robots.size() ? fmt::format("crowd {}", in) : "";
}

void live(Robots& robots, size_t changing, bool of_one_name, serve::Bell& bell) {
    Time next = now();
    int64_t beat = 0;
    std::string told;
    while (!net::end_asked()) {
        if (now() >= next) {
            next = now() + fleet::kStateEveryMin;
            ++beat;
            for (size_t i = 0; i < changing; ++i) robots[i]->do_something_else(beat);
        }
        for (const auto& robot : robots) robot->turn();
        const std::string news = news_of(robots, of_one_name);
        if (!news.empty() && std::exchange(told, news) != news) {
            std::puts(news.c_str());
            std::fflush(stdout);
        }
        bell.wait(std::max(Duration{}, next - now()));
    }
    for (const auto& robot : robots) robot->leave();
}

}  // namespace

int main(int count, char** words) {
    if (count != 4 && count != 5) {
        std::fputs("fleet_crowd mqtt://HOST:PORT/FLEET ROBOTS CHANGING [NAME]\n", stderr);
        return 2;
    }
    net::watch_for_end();
    serve::Bell bell;
    Robots robots;
    const bool of_one_name = count == 5;
    const size_t size = std::strtoul(words[2], nullptr, 10);
    for (size_t i = 1; i <= size; ++i) {
        const std::string name = of_one_name ? words[4] : "r" + std::to_string(i);
        robots.push_back(std::make_unique<Robot>(words[1], name, [&bell] { bell.ring(); }));
    }
    live(robots, std::min<size_t>(size, std::strtoul(words[3], nullptr, 10)), of_one_name, bell);
    return 0;
}
