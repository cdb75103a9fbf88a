#include "cli/fleet/deploy.hpp"

#include <fmt/format.h>

#include "cli/output.hpp"
#include "fleet/rollout.hpp"
#include "serve/process.hpp"
#include "serve/web/shelf.hpp"
#include "serve/workbench/pack.hpp"

namespace vagus::cli {
namespace {

int roll_out(FleetSession& session, fleet::Rollout rollout) {
    using Place = fleet::Rollout::Place;
    std::map<std::string, std::string> told;
    session.on_event([&](const fleet::LinkEvent& event) { rollout.hear(event, session.now()); });
    session.subscribe({{fleet::filter_of(session.fleet(), fleet::Kind::Version)}});
    const auto turn = [&] {
        rollout.tick(session.now());
        for (const fleet::Post& post : rollout.take()) session.publish(post);
        for (const fleet::Rollout::Line& line : rollout.table()) {
            const std::string text = fleet::text_of(line);
            if (line.place == Place::Later || std::exchange(told[line.robot], text) == text)
                continue;
            print(fmt::format("{}: {}\n", line.robot, text));
        }
        return rollout.is_over();
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
    if (!ended) say("the roll-out was left; robots that have it go on with it\n");
    return rollout.all_are_well() ? kExitDone : kExitFailed;
}

}  // namespace

int deploy(FleetSession& session, const FleetCall& call) {
    // Those that are there say at once whether it is a good version.
    const std::vector<std::string> robots = session.desk().chosen_online_first(chosen_by(call));
    if (robots.empty()) return complain("no robot is there that this is for");
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
