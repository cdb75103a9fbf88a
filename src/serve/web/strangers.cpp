#include "serve/web/strangers.hpp"

#include <algorithm>

namespace vagus::serve {

Strangers::Place Strangers::add(const std::string& address, std::function<void()> cut_off) {
    const auto counts = by_address();
    const auto own = counts.find(address);
    if (own != counts.end() && own->second >= limits_.of_address) {
        cut_off_one_of(address);
    } else if (all_.size() >= limits_.all && !counts.empty()) {
        const auto most = std::max_element(
            counts.begin(), counts.end(),
            [](const auto& one, const auto& other) { return one.second < other.second; });
        cut_off_one_of(most->first);
    }
    const Place place = ++last_;
    all_.emplace(place, One{address, std::move(cut_off), place});
    return place;
}

void Strangers::heard(Place place) {
    const auto found = all_.find(place);
    if (found != all_.end()) found->second.heard = ++last_;
}

std::map<std::string, size_t> Strangers::by_address() const {
    std::map<std::string, size_t> counts;
    for (const auto& [place, one] : all_) ++counts[one.address];
    return counts;
}

void Strangers::cut_off_one_of(const std::string& address) {
    auto silent = all_.end();
    for (auto one = all_.begin(); one != all_.end(); ++one) {
        if (one->second.address != address) continue;
        if (silent == all_.end() || one->second.heard < silent->second.heard) silent = one;
    }
    const auto cut_off = std::move(silent->second.cut_off);
    all_.erase(silent);
    cut_off();
}

std::string owner_of(const std::string& address) {
    size_t colons = 0;
    for (size_t i = 0; i < address.size(); ++i) {
        if (address[i] != ':') continue;
        // What "::" leaves out is zero.
        if (++colons == 4 || address.substr(i, 2) == "::") return address.substr(0, i) + "::/64";
    }
    return address;
}

}  // namespace vagus::serve
