#include "keeper/leases.hpp"

#include <algorithm>
#include <utility>

#include "keeper/keeper.hpp"

namespace vagus::keeper {

namespace {

// By the clock of whoever gave it, which may be slower.
constexpr Duration kKeeperForgotten = kLeaseMax + kLeaseMax / 50;

const Lease* lease_in(const Reply& reply) {
    if (!reply.record) return nullptr;
    if (const auto* task = std::get_if<Task>(&*reply.record)) return &task->lease;
    if (const auto* claim = std::get_if<Claim>(&*reply.record)) return &claim->lease;
    return nullptr;
}

bool asks_for_lease(const Request& request) {
    return std::holds_alternative<Take>(request) || std::holds_alternative<ClaimName>(request);
}

}  // namespace

uint64_t Leases::ask(Request request, Time now) {
    if (questions_.size() >= kQuestionsMax) return 0;
    // From now on it is not worked on, whenever the keeper hears so.
    if (const auto* finish = std::get_if<Finish>(&request)) held_.erase(finish->term);
    if (const auto* release = std::get_if<Release>(&request)) held_.erase(release->term);
    return add(std::move(request), now, false);
}

uint64_t Leases::add(Request request, Time now, bool is_own) {
    questions_[++questions_asked_] = {std::move(request), now, now, is_own};
    return questions_asked_;
}

void Leases::cancel(uint64_t number) {
    if (const auto question = questions_.find(number); question != questions_.end())
        question->second.is_cancelled = true;
}

std::vector<Ask> Leases::tick(Time now) {
    for (auto& [term, held] : held_) {
        if (now < held.renew || now >= held.until) continue;
        held.renew = now + held.length / 3;
        questions_.erase(held.renewal);
        held.renewal = add(Renew{term}, now, true);
    }
    std::vector<Ask> asks;
    for (auto question = questions_.begin(); question != questions_.end();) {
        auto& [number, asked] = *question;
        if (now >= asked.first + kAskAtMost) {
            if (!asked.is_own && !asked.is_cancelled) over_.push_back({number, {}});
            question = questions_.erase(question);
            continue;
        }
        if (now >= asked.again) {
            asked.again = now + kAskAgain;
            asks.push_back({number, asked.request});
        }
        ++question;
    }
    return asks;
}

void Leases::heard_of(uint64_t keeper_epoch, Time now) {
    const bool is_forgotten = now >= keeper_heard_ + kKeeperForgotten;
    if (keeper_epoch < keeper_epoch_ && !is_forgotten) return;
    keeper_epoch_ = keeper_epoch;
    keeper_heard_ = now;
}

void Leases::hear(uint64_t number, const Reply& reply, Time now) {
    const auto found = questions_.find(number);
    if (found == questions_.end()) return;
    heard_of(reply.epoch, now);
    if (reply.epoch < keeper_epoch_) return;
    const Question question = std::move(found->second);
    questions_.erase(found);
    const Lease* lease = lease_in(reply);
    if (const auto* renew = std::get_if<Renew>(&question.request)) {
        const auto held = held_.find(renew->term);
        if (held == held_.end()) return;
        if (reply.outcome == Outcome::Done)
            held->second.until = std::max(held->second.until, question.first + held->second.length);
        else
            held->second.until = now;
        return;
    }
    if (asks_for_lease(question.request) && reply.outcome == Outcome::Done && lease) {
        if (question.is_cancelled) {
            add(Release{lease->term}, now, true);
            return;
        }
        held_[lease->term] = {question.first + lease->length, now + lease->length / 3,
                              lease->length};
    }
    if (!question.is_own && !question.is_cancelled) over_.push_back({number, reply});
}

std::vector<Over> Leases::take_over() {
    return std::exchange(over_, {});
}

std::vector<Term> Leases::take_ended(Time now) {
    std::vector<Term> ended;
    for (auto held = held_.begin(); held != held_.end();) {
        if (now < held->second.until) {
            ++held;
            continue;
        }
        ended.push_back(held->first);
        questions_.erase(held->second.renewal);
        held = held_.erase(held);
    }
    return ended;
}

bool Leases::holds(Term term, Time now) const {
    const auto held = held_.find(term);
    return held != held_.end() && now < held->second.until;
}

Time Leases::next() const {
    Time next = Time::max();
    for (const auto& [term, held] : held_) next = std::min({next, held.until, held.renew});
    for (const auto& [number, question] : questions_)
        next = std::min({next, question.again, question.first + kAskAtMost});
    return next;
}

}  // namespace vagus::keeper
