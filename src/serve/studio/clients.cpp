#include "serve/studio/clients.hpp"

#include <algorithm>

namespace vagus::serve {

Clients::Member& Clients::enter(ClientId connection, const std::string& key,
                                const std::string& name, Role role, Time now,
                                std::optional<ClientId>& replaced) {
    forget(now);
    auto found = std::find_if(members_.begin(), members_.end(), [&](const auto& entry) {
        return entry.second.key == key && entry.second.role == role;
    });
    if (found == members_.end()) {
        const uint32_t number = ++last_;
        found = members_.emplace(number, Member{.number = number, .key = key}).first;
    }
    Member& member = found->second;
    if (member.connection) {
        replaced = member.connection;
        connections_.erase(*member.connection);
    }
    member.name = name;
    member.role = role;
    member.connection = connection;
    connections_[connection] = member.number;
    const Member* holder = driver();
    const bool free =
        !holder || (!holder->connection && now > holder->gone_since + kWheelAnswerWithin);
    if (role == Role::Drive && free) {
        driver_ = member.number;
        back_until_ = holder ? Time{} : now + kControlBackWithin;
    }
    return member;
}

void Clients::take_back(const Member& member, Time now) {
    if (member.role == Role::Drive && now < back_until_) driver_ = member.number;
    if (drives(member)) back_until_ = {};
}

void Clients::leave(ClientId connection, Time now) {
    Member* member = find(connection);
    if (!member) return;
    member->connection.reset();
    member->gone_since = now;
    connections_.erase(connection);
    // No answer of this page will come; end what waits for it.
    if (asked_ && drives(*member)) answer(true);
}

const Clients::Member* Clients::connected_with(const std::string& key, Role role) const {
    for (const auto& [number, member] : members_) {
        if (member.key == key && member.role == role && member.connection) return &member;
    }
    return nullptr;
}

Clients::Member* Clients::find(ClientId connection) {
    const auto found = connections_.find(connection);
    return found == connections_.end() ? nullptr : find(found->second);
}

const Clients::Member* Clients::find(uint32_t number) const {
    const auto found = members_.find(number);
    return found == members_.end() ? nullptr : &found->second;
}

Clients::Member* Clients::find(uint32_t number) {
    const auto found = members_.find(number);
    return found == members_.end() ? nullptr : &found->second;
}

const Clients::Member* Clients::driver() const {
    const auto found = members_.find(driver_);
    return found == members_.end() ? nullptr : &found->second;
}

size_t Clients::connected() const {
    return connections_.size();
}

void Clients::count_stop(uint32_t by) {
    for (auto& [number, member] : members_) {
        if (number != by) ++member.stops;
    }
}

Clients::Seen Clients::begin(Member& member, uint64_t id) {
    const auto found = member.answers.find(id);
    if (found != member.answers.end()) return found->second.empty() ? Seen::UnderWay : Seen::Done;
    if (id <= member.forgotten) return Seen::TooOld;
    if (member.answers.size() >= kAnswersKept) forget_oldest(member);
    member.answers.emplace(id, std::string());
    return Seen::New;
}

bool Clients::is_answered(const Member& member, uint64_t id) {
    const auto found = member.answers.find(id);
    return found != member.answers.end() && !found->second.empty();
}

void Clients::finish(Member& member, uint64_t id, const std::string& answer) {
    const auto found = member.answers.find(id);
    if (found == member.answers.end()) return;
    found->second = answer;
    member.answer_bytes += answer.size();
    while (member.answer_bytes > kAnswerBytesKept && member.answers.begin()->first < id) {
        forget_oldest(member);
    }
}

void Clients::forget_oldest(Member& member) {
    const auto oldest = member.answers.begin();
    member.forgotten = oldest->first;
    member.answer_bytes -= oldest->second.size();
    member.answers.erase(oldest);
}

bool Clients::ask(Member& member, Time now) {
    if (drives(member)) return true;
    const Member* holder = driver();
    if (!holder || !holder->connection) {
        driver_ = member.number;
        back_until_ = {};
        asked_.reset();
        return true;
    }
    if (!asked_) asked_ = Ask{member.number, now + kWheelAnswerWithin};
    return false;
}

void Clients::answer(bool give) {
    if (asked_ && give && is_here(asked_->member)) {
        driver_ = asked_->member;
        back_until_ = {};
    }
    asked_.reset();
}

bool Clients::tick(Time now) {
    if (!asked_ || now < asked_->until) return false;
    asked_.reset();
    return true;
}

Time Clients::next_tick() const {
    return asked_ ? asked_->until : Time::max();
}

bool Clients::is_here(uint32_t number) const {
    const auto found = members_.find(number);
    return found != members_.end() && found->second.connection.has_value();
}

void Clients::forget(Time now) {
    std::erase_if(members_, [&](const auto& entry) {
        const Member& member = entry.second;
        return !member.connection && member.number != driver_ &&
               now > member.gone_since + kForgetAfter;
    });
    while (members_.size() >= kKnownMax) {
        const auto oldest = std::find_if(members_.begin(), members_.end(), [&](const auto& entry) {
            return !entry.second.connection && entry.second.number != driver_;
        });
        if (oldest == members_.end()) return;
        members_.erase(oldest);
    }
}

}  // namespace vagus::serve
