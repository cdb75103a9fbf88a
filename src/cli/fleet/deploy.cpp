#include "cli/fleet/deploy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cli/output.hpp"
#include "fleet/rollout.hpp"
#include "serve/process.hpp"
#include "serve/web/shelf.hpp"
#include "serve/workbench/pack.hpp"

namespace vagus::cli {
namespace {

constexpr uint64_t kWish = 1;  // number of what is published

// Why the broker does not pass a wish on; nothing: it does, or this tells something else.
std::string refusal_in(const fleet::LinkEvent& event) {
    const auto* told = std::get_if<fleet::Acknowledged>(&event);
    return told != nullptr && told->number == kWish ? told->refused : "";
}

int roll_out(FleetSession& session, fleet::Rollout rollout) {
    using Place = fleet::Rollout::Place;
    std::map<std::string, std::string> told;
    std::string refused;
    session.on_event([&](const fleet::LinkEvent& event) {
        if (refused.empty()) refused = refusal_in(event);
        rollout.hear(event, session.now());
    });
    const auto turn = [&] {
        rollout.tick(session.now());
        for (fleet::Post& post : rollout.take()) {
            post.number = kWish;
            session.publish(post);
        }
        for (const fleet::Rollout::Line& line : rollout.table()) {
            const std::string text = fleet::text_of(line);
            if (line.place == Place::Later || std::exchange(told[line.robot], text) == text)
                continue;
            print(fmt::format("{}: {}\n", line.robot, text));
        }
        return rollout.is_over() || !refused.empty();
    };
    const bool ended = session.wait_until(turn, Duration::max() / 4);
    session.on_event([](auto&) {});
    size_t well = 0;
    const auto table = rollout.table();
    for (const fleet::Rollout::Line& line : table) {
        if (line.place == Place::Well) ++well;
        if (line.place == Place::Later) print(line.robot + ": as it was\n");
    }
    print(fmt::format("{} of {} robots: well\n", well, table.size()));
    const auto have = std::ranges::count_if(table, &fleet::Rollout::Line::has);
    if (have > 0 && !rollout.all_are_well() && !rollout.want().back) {
        say(fmt::format("it is in force on {} of them, until --rollback takes it back\n", have));
    }
    if (!refused.empty()) {
        return complain("the broker does not pass it on: " + refused +
                        "; use the --login of an operator");
    }
    if (!ended) say("the roll-out was left; robots that have it go on with it\n");
    return rollout.all_are_well() ? kExitDone : kExitFailed;
}

// Whether the version of its last roll-out is in force. One that was taken back is not.
bool has_one(const fleet::Known& robot) {
    if (!robot.version || robot.version->sha256.empty()) return false;
    return robot.version->result != "refused" && robot.version->result != "rolled_back";
}

// What is taken back is one roll-out. A robot that did not get it would lose the version that it
// had before, and of two roll-outs nobody can know the later one: there is no clock that all share.
Result<std::vector<std::string>> those_that_have_it(FleetSession& session,
                                                    const std::vector<std::string>& robots) {
    if (robots.size() == 1) return robots;  // it was named, and says itself what is before it
    std::map<int64_t, std::vector<std::string>> by_number;
    for (const std::string& name : robots) {
        const auto known = session.desk().robots().find(name);
        if (known == session.desk().robots().end() || !has_one(known->second)) {
            print(name + ": as it was: no version of a roll-out is in force there\n");
            continue;
        }
        by_number[known->second.version->number].push_back(name);
    }
    if (by_number.size() == 1) return by_number.begin()->second;
    if (by_number.empty()) {
        return Error{Code::Unavailable, "there is nothing to take back, and nothing was changed"};
    }
    std::string lists;
    for (const auto& [number, names] : by_number) {
        lists += fmt::format("{}that of {}", lists.empty() ? "" : "; ", fmt::join(names, ", "));
    }
    return Error{Code::Unavailable,
                 fmt::format("these robots have versions of {} roll-outs, and nothing was changed: "
                             "{}. Name those of one of them, as t1 or t1..t30",
                             by_number.size(), lists)};
}

}  // namespace

int deploy(FleetSession& session, const FleetCall& call) {
    // Those that are there say at once whether it is a good version.
    std::vector<std::string> robots = session.desk().chosen_online_first(chosen_by(call));
    if (robots.empty()) return complain("no robot is there that this is for");
    if (call.rollback) {
        auto have = those_that_have_it(session, robots);
        if (!have.ok()) return complain_of(have.error());
        robots = std::move(have.value());
    }
    const auto steps = fleet::read_steps(call.steps, robots.size());
    if (!steps.ok()) return complain_of({steps.error().code, "--" + steps.error().what});
    fleet::Want want{.number = 1 + serve::random_number(), .back = call.rollback};
    std::unique_ptr<serve::Shelf> shelf;
    if (!call.rollback) {
        const auto collected = serve::collect_bundle(call.project);
        if (!collected.ok()) return complain_of(collected.error());
        const auto bytes = serve::pack(collected.value());
        if (!bytes.ok()) return complain_of(bytes.error());
        auto opened = serve::Shelf::open(call.shelf, bytes.value());
        if (!opened.ok()) return complain_of(opened.error());
        shelf = std::move(opened.value());
        want.sha256 = serve::sha256_of(bytes.value());
        want.address = shelf->address();
    }
    const auto within = std::chrono::duration_cast<Duration>(
        std::chrono::duration<double>(call.wait_s.value_or(kRolloutWait_s)));
    return roll_out(session, fleet::Rollout({.fleet = session.fleet(),
                                             .want = want,
                                             .robots = robots,
                                             .steps = steps.value(),
                                             .within = within}));
}

}  // namespace vagus::cli
