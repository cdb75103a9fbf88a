#include "serve/runner/run_fleet.hpp"

#include <fmt/format.h>

#include "serve/broker/fleet_options.hpp"

namespace vagus::serve {

Result<std::unique_ptr<RunFleet>> RunFleet::open(const talk::MemberOf& member, uint64_t order,
                                                 Clock clock) {
    const FleetOptions options{.target = member.target,
                               .robot = member.robot,
                               .ca = member.ca,
                               .certificate = member.certificate,
                               .key = member.key,
                               .login = member.login};
    const std::string client = fmt::format("{}-{}-{}", member.robot, member.instance, order);
    LinkOptions link = TRY(link_of_fleet(options, client));
    Member who{.fleet = link.target.fleet,
               .robot = member.robot,
               .instance = member.instance,
               .epoch = member_identity().second};
    return std::make_unique<RunFleet>(
        std::move(who), std::make_unique<MosquittoLink>(std::move(link), [] {}), std::move(clock));
}

RunFleet::RunFleet(Member member, std::unique_ptr<fleet::Link> link, Clock clock)
    : member_(std::move(member)),
      clock_(std::move(clock)),
      fleet_({.fleet = member_.fleet, .robot = member_.robot, .epoch = member_.epoch}),
      link_(std::move(link)) {}

bool RunFleet::turn() {
    const std::lock_guard lock(guard_);
    for (const fleet::LinkEvent& event : link_->take()) hear(event);
    send();
    return fleet_.take_news();
}

void RunFleet::hear(const fleet::LinkEvent& event) {
    if (std::holds_alternative<fleet::Connected>(event)) link_->subscribe(fleet_.filters());
    if (std::holds_alternative<fleet::Lost>(event)) has_name_ = false;
    fleet_.hear(event, clock_());
    const auto* const received = std::get_if<fleet::Received>(&event);
    if (received == nullptr || received->heard.topic.robot != member_.robot) return;
    const auto* const said = std::get_if<fleet::Connection>(&received->heard.message);
    if (said == nullptr) return;
    has_name_ = said->state == "online" && said->instance == member_.instance;
}

// What is not sent now is asked again.
void RunFleet::send() {
    fleet_.tick(clock_());
    for (const fleet::Post& post : fleet_.take()) {
        if (has_name_) link_->publish(post);
    }
}

std::vector<RunFleet::Told> RunFleet::take_told() {
    const std::lock_guard lock(guard_);
    return fleet_.take_told();
}

uint64_t RunFleet::ask(keeper::Request request) {
    const std::lock_guard lock(guard_);
    fleet_.tick(clock_());
    const uint64_t number = fleet_.ask(std::move(request));
    send();
    return number;
}

std::optional<keeper::Over> RunFleet::answer(uint64_t number) {
    const std::lock_guard lock(guard_);
    return fleet_.answer(number);
}

void RunFleet::cancel(uint64_t number) {
    const std::lock_guard lock(guard_);
    fleet_.cancel(number);
}

// By the clock of now, not of the last turn.
bool RunFleet::holds(keeper::Term term) const {
    const std::lock_guard lock(guard_);
    fleet_.tick(clock_());
    return fleet_.holds(term);
}

std::optional<keeper::Shared> RunFleet::shared(const std::string& key) const {
    const std::lock_guard lock(guard_);
    return fleet_.shared(key);
}

std::vector<std::string> RunFleet::online() const {
    const std::lock_guard lock(guard_);
    return fleet_.online();
}

void RunFleet::tell(const std::string& name, std::vector<int16_t> values) {
    const std::lock_guard lock(guard_);
    fleet_.tell(name, std::move(values));
}

}  // namespace vagus::serve
