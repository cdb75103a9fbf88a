#include "record/keeper_log.hpp"

#include <fmt/format.h>

#include <variant>

namespace vagus::record {

namespace {

template <typename... One>
bool is_one_of(const keeper::Request& request) {
    return (std::holds_alternative<One>(request) || ...);
}

}  // namespace

std::string thing_of(const keeper::Record& record) {
    if (const auto* const task = std::get_if<keeper::Task>(&record)) {
        return fmt::format("the task {} of {}", task->id, task->queue);
    }
    if (const auto* const claim = std::get_if<keeper::Claim>(&record)) {
        return "the name " + claim->name;
    }
    return "the shared value " + std::get<keeper::Shared>(record).key;
}

void KeeperLog::add(const DecidedQuestion& asked, const keeper::Request& request,
                    const keeper::Reply& reply) {
    if (reply.outcome != keeper::Outcome::Done || !reply.record) return;
    DecidedQuestion by = asked;
    by.thing = thing_of(*reply.record);
    if (const auto* const value = std::get_if<keeper::Shared>(&*reply.record)) {
        written_.try_emplace({value->key, value->version}, std::move(by));
        return;
    }
    const bool gets = is_one_of<keeper::Take, keeper::ClaimName>(request);
    const bool gives = is_one_of<keeper::Give, keeper::Release>(request);
    if (!gets && !gives) return;
    std::vector<Step>& steps = steps_[by.thing];
    for (const Step& one : steps) {
        if (one.asked.is(by.bus, by.question)) return;
    }
    if (gets) got_[{by.bus, by.question}] = by.thing;
    steps.push_back({std::move(by), gives});
}

std::optional<DecidedQuestion> KeeperLog::giver_of(size_t bus, uint64_t question) const {
    const auto thing = got_.find({bus, question});
    if (thing == got_.end()) return std::nullopt;
    const Step* before = nullptr;
    for (const Step& one : steps_.at(thing->second)) {
        if (one.asked.is(bus, question)) break;
        before = &one;
    }
    if (before == nullptr || !before->gives) return std::nullopt;
    return before->asked;
}

std::optional<DecidedQuestion> KeeperLog::writer_of(const keeper::Shared& value) const {
    const auto found = written_.find({value.key, value.version});
    return found == written_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace vagus::record
