// What a chain of why.hpp tells of a fleet: events that it brought from another robot, answers of
// its keeper, values that all share.
#include <fmt/format.h>

#include <algorithm>

#include "record/why_walk.hpp"

namespace vagus::record {

namespace {

// What the robot did by that.
std::string deed_of(const keeper::Request& request, const std::string& thing) {
    if (std::holds_alternative<keeper::Release>(request)) return "gave " + thing + " back";
    if (std::holds_alternative<keeper::Give>(request)) return "gave " + thing;
    return "wrote " + thing;
}

// What the keeper's answer gave, or said.
std::string sentence_of(const keeper::Over& over) {
    if (!over.reply) return "no keeper of the fleet answered";
    if (over.reply->outcome != keeper::Outcome::Done) {
        return "the keeper of the fleet answered: " + over.reply->why;
    }
    if (!over.reply->record) return "the keeper of the fleet answered: done";
    return fmt::format("the keeper of the fleet answered, done: {}", thing_of(*over.reply->record));
}

template <typename One>
const One* only(const std::vector<session::FleetNews>& items) {
    const One* found = nullptr;
    for (const session::FleetNews& item : items) {
        const auto* const one = std::get_if<One>(&item);
        if (one == nullptr) continue;
        if (found != nullptr) return nullptr;
        found = one;
    }
    return found;
}

template <typename One>
bool has(const std::vector<session::FleetNews>& items) {
    return std::ranges::any_of(items,
                               [](const auto& item) { return std::holds_alternative<One>(item); });
}

}  // namespace

// Of another robot: on the bus of that it was a frame.
void Walk::message(const BusCauses::Message& message) {
    const embed::FleetEvent& event = message.event;
    if (!add({message.at, fmt::format("the fleet brought {} from {}", event.name, event.from), "",
              words_text(event.arguments)})) {
        return;
    }
    const std::optional<size_t> sender = all_.bus_of(event.from);
    if (sender && message.frame != 0) on_bus(*sender, [&] { frame(message.frame); });
}

// A plan that waits for an answer continues when the answer arrives, whatever else is new. If
// several news could have been the cause, the chain names how many there were, and ends.
void Walk::news(const BusCauses::News& news) {
    if (const auto* const over = only<keeper::Over>(news.items)) {
        return answer_of_keeper(news.at, *over);
    }
    const bool answered = has<keeper::Over>(news.items);
    const auto* const value = answered ? nullptr : only<keeper::Shared>(news.items);
    if (value != nullptr) return value_of_keeper(news.at, *value);
    const auto* const online = only<session::RobotOnline>(news.items);
    if (online != nullptr && news.items.size() == 1) {
        add({news.at,
             fmt::format("the fleet told that {} is {}", online->robot,
                         online->online ? "online" : "not online any more"),
             "", ""});
        return;
    }
    add({news.at, fmt::format("the fleet told {} things at once", news.items.size()), "", ""});
}

// The last actor that began before that line.
std::optional<size_t> Walk::started_before(size_t line) const {
    return last_line(std::min(line, lines().size()),
                     [&](size_t i) { return what<plan::ActorStarted>(i) != nullptr; });
}

// What it was given it may have waited for: then it follows from who gave it, else from its own
// question.
void Walk::answer_of_keeper(Time at, const keeper::Over& over) {
    if (!add({at, sentence_of(over), "", ""})) return;
    const BusCauses::Asked* const asked = bus_->asked(over.number);
    const auto begun = asked != nullptr ? started_before(asked->line) : std::nullopt;
    if (!begun) return;
    const KeeperLog* const keeper = all_.keeper_of(index_);
    const auto giver = keeper != nullptr ? keeper->giver_of(index_, over.number) : std::nullopt;
    const bool waited = giver && giver->at >= lines()[*begun].event.at;
    if (waited) return question_of(*giver);
    line(*begun);
}

void Walk::value_of_keeper(Time at, const keeper::Shared& value) {
    if (!add({at, "the fleet told " + thing_of(value), "", value.value})) return;
    const KeeperLog* const keeper = all_.keeper_of(index_);
    const auto writer = keeper != nullptr ? keeper->writer_of(value) : std::nullopt;
    if (writer) question_of(*writer);
}

// Of the plan of a robot, which may be another one.
void Walk::question_of(const DecidedQuestion& by) {
    on_bus(by.bus, [&] {
        const BusCauses::Asked* const asked = bus_->asked(by.question);
        if (asked == nullptr) return;
        const auto begun = started_before(asked->line);
        if (!begun) return;
        const std::string actor(what<plan::ActorStarted>(*begun)->actor);
        if (add_element(asked->at,
                        fmt::format("the actor {} of the plan {}", actor,
                                    deed_of(asked->request, by.thing)),
                        lines()[*begun].event.plan, actor)) {
            line(*begun);
        }
    });
}

}  // namespace vagus::record
