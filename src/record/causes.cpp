#include "record/causes.hpp"

#include "record/past_bus.hpp"
#include "session/plan_world.hpp"

namespace vagus::record {

Causes::Causes(Rerun& rerun) : rerun_(rerun), happenings_(rerun) {
    for (const RunBus& bus : rerun.buses()) {
        buses_.push_back(std::make_unique<BusCauses>(bus, happenings_));
    }
    BusCauses& first = *buses_.front();
    rerun.listen([&first](const plan::TraceEvent& event) { first.line(event); });
    rerun.pass_over([&first](const run::Raising& raising) {
        first.raising(raising);
        return false;
    });
    rerun.watch_robots(this);
    if (rerun.past_bus() != nullptr) first.learn(*rerun.past_bus());
    if (rerun.session() == nullptr) return;
    sim::World& world = rerun.session()->world();
    by_robot_.assign(world.definition().robots.size() + 1, &first);
    for (const auto& bus : buses_) by_robot_[bus->bus().number] = bus.get();
    world.watch(this);
    if (rerun.plan_world() == nullptr) return;
    rerun.plan_world()->on_emit(
        [&first](Time, const run::BusEvent& event) { first.plan_sent(event); });
}

Causes::~Causes() {
    rerun_.watch_robots(nullptr);
    if (rerun_.session() == nullptr) return;
    rerun_.session()->world().watch(nullptr);
    if (rerun_.plan_world() != nullptr) rerun_.plan_world()->on_emit({});
}

std::optional<size_t> Causes::bus_of(std::string_view robot) const {
    for (size_t i = 1; i < buses_.size(); ++i) {
        if (buses_[i]->bus().robot == robot) return i;
    }
    return std::nullopt;
}

const KeeperLog* Causes::keeper_of(size_t bus) const {
    const auto found = keepers_.find(buses_[bus]->bus().fleet);
    return found == keepers_.end() ? nullptr : &found->second;
}

void Causes::of_fleet(size_t robot, const embed::FromFleet& what) {
    BusCauses& its = of_robot(robot);
    if (const auto* const event = std::get_if<embed::FleetEvent>(&what)) its.fleet_brought(*event);
    if (const auto* const told = std::get_if<embed::FleetTold>(&what)) its.fleet_told(*told);
    if (const auto* const asked = std::get_if<embed::KeeperAsked>(&what)) its.plan_asked(*asked);
    const auto* const decided = std::get_if<embed::KeeperDecided>(&what);
    if (decided == nullptr) return;
    // What nobody waited for any more was asked by no code of the plan.
    const BusCauses::Asked* const asked = its.asked(decided->question);
    if (asked == nullptr) return;
    const DecidedQuestion by{robot + 1, decided->question, rerun_.session()->now()};
    keepers_[its.bus().fleet].add(by, asked->request, decided->reply);
}

void Causes::stopped(size_t robot, const std::string& why) {
    BusCauses& its = of_robot(robot);
    happenings_.stops_alone(its.bus().number, why);
    its.stops_alone(static_cast<uint32_t>(happenings_.all().size()));
}

}  // namespace vagus::record
