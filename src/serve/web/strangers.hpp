// Connections that have shown no token. They take places from each other only: above the number of
// one address, or of all, the one that is silent the longest is cut off, of the address that has
// the most. So who holds many keeps nobody else out.
//
//     const auto place = strangers.add("10.0.0.7", [] { shut_it_down(); });
//     strangers.heard(place);       // it said something
//     strangers.remove(place);      // it is known now, or has gone
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace vagus::serve {

struct StrangerLimits {
    size_t all = 0;
    size_t of_address = 0;
};

class Strangers {
public:
    using Place = uint64_t;
    explicit Strangers(StrangerLimits limits) : limits_(limits) {}

    // The connection that had to make room is cut off before this returns.
    Place add(const std::string& address, std::function<void()> cut_off);
    void heard(Place place);
    void remove(Place place) { all_.erase(place); }
    size_t size() const { return all_.size(); }

private:
    struct One {
        std::string address;
        std::function<void()> cut_off;
        uint64_t heard = 0;
    };
    void cut_off_one_of(const std::string& address);
    std::map<std::string, size_t> by_address() const;

    StrangerLimits limits_;
    std::map<Place, One> all_;
    uint64_t last_ = 0;  // place, or thing heard
};

// Whose places an address shares: an IPv6 address is one of many that its owner has (/64).
std::string owner_of(const std::string& address);

}  // namespace vagus::serve
