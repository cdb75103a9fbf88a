#include "session/member_fleet.hpp"

#include <algorithm>

#include "fleet/topic.hpp"

namespace vagus::session {

std::vector<fleet::Filter> MemberFleet::filters() const {
    std::vector<fleet::Filter> filters = client_.filters();
    filters.push_back({fleet::filter_of(fleet_, fleet::Kind::Shared)});
    filters.push_back({fleet::filter_of(fleet_, fleet::Kind::Connection)});
    return filters;
}

uint64_t MemberFleet::ask(keeper::Request request) {
    const keeper::Request asked = request;
    const uint64_t number = client_.ask(std::move(request), now_);
    if (told_of_question_ && number != 0) told_of_question_(number, asked);
    return number;
}

void MemberFleet::hear(const fleet::LinkEvent& event, Time now) {
    now_ = now;
    client_.hear(event, now);
    if (const auto* taken = std::get_if<fleet::TakenBack>(&event)) {
        news_ |= shared_.erase(taken->topic.name) > 0;
        news_ |= online_.erase(taken->topic.robot) > 0;
    }
    const auto* const received = std::get_if<fleet::Received>(&event);
    if (received == nullptr) return;
    const fleet::Heard& heard = received->heard;
    if (const auto* connection = std::get_if<fleet::Connection>(&heard.message)) {
        const bool online = connection->state == "online";
        online_[heard.topic.robot] = online;
        is_new(RobotOnline{heard.topic.robot, online});
    } else if (const auto* record = std::get_if<keeper::Record>(&heard.message)) {
        const auto* const value = std::get_if<keeper::Shared>(record);
        if (value == nullptr) return;
        keeper::Shared& known = shared_[value->key];
        // One that comes again, late, is none that is new.
        if (value->version < known.version) return;
        known = *value;
        is_new(*value);
    }
}

void MemberFleet::tick(Time now) {
    now_ = now;
    client_.tick(now);
    for (keeper::Over& over : client_.leases().take_over()) {
        is_new(over);
        const auto* const value = over.reply && over.reply->record
                                      ? std::get_if<keeper::Shared>(&*over.reply->record)
                                      : nullptr;
        if (value != nullptr && shared_[value->key].version < value->version) {
            shared_[value->key] = *value;
        }
        over_[over.number] = std::move(over);
    }
    news_ |= !client_.leases().take_ended(now).empty();
}

std::optional<keeper::Over> MemberFleet::answer(uint64_t number) {
    const auto found = over_.find(number);
    if (found == over_.end()) return std::nullopt;
    keeper::Over over = std::move(found->second);
    over_.erase(found);
    return over;
}

std::optional<keeper::Shared> MemberFleet::shared(const std::string& key) const {
    const auto found = shared_.find(key);
    return found == shared_.end() ? std::nullopt : std::optional(found->second);
}

// By length first: "r2" is before "r10".
std::vector<std::string> MemberFleet::online() const {
    std::vector<std::string> names;
    for (const auto& [name, online] : online_) {
        if (online || name == me_) names.push_back(name);
    }
    if (!online_.contains(me_)) names.push_back(me_);
    std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
        return std::pair(a.size(), a) < std::pair(b.size(), b);
    });
    return names;
}

void MemberFleet::tell(const std::string& name, std::vector<int16_t> values) {
    if (told_.size() < kToldMax) told_.push_back({name, std::move(values)});
}

}  // namespace vagus::session
