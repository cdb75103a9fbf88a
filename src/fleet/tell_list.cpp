#include "fleet/tell_list.hpp"

#include <algorithm>

#include "fleet/limits.hpp"

namespace vagus::fleet {

bool TellList::add(const Tells& variable, Time now) {
    const auto known = std::find_if(asked_.begin(), asked_.end(),
                                    [&](const auto& one) { return one.first == variable; });
    if (known != asked_.end()) {
        known->second = now + kTellFor;
        return true;
    }
    if (asked_.size() >= kTellMax) return false;
    asked_.emplace_back(variable, now + kTellFor);
    return true;
}

bool TellList::forget_old(Time now) {
    return std::erase_if(asked_, [now](const auto& one) { return now >= one.second; }) > 0;
}

std::vector<Tells> TellList::all() const {
    std::vector<Tells> list = project_;
    for (const auto& [variable, until] : asked_) {
        if (std::find(list.begin(), list.end(), variable) == list.end()) list.push_back(variable);
    }
    return list;
}

Time TellList::next() const {
    Time next = Time::max();
    for (const auto& [variable, until] : asked_) next = std::min(next, until);
    return next;
}

}  // namespace vagus::fleet
