// Targets that can be offered: what is plugged in, what listens on this computer, and what
// announces itself in the network (RFC 6763: `_aseba._tcp`), where a daemon for that runs.
//
//     Targets targets;
//     targets.look(now);              // from time to time, while somebody watches
//     show(targets.found());
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/time.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kLookEvery = 2s;
constexpr size_t kFoundMax = 200;

struct FoundTarget {
    std::string target, name, kind, help;  // as in the protocol
    bool operator==(const FoundTarget&) const = default;
};

// Serial devices of this computer, by the names that stay theirs.
std::vector<FoundTarget> serial_targets(const std::string& by_id = "/dev/serial/by-id",
                                        const std::string& devices = "/dev");
// Ports of this computer on which something listens where Aseba's programs do: 33333 to 33342.
std::vector<FoundTarget> local_targets(const std::string& tcp = "/proc/net/tcp",
                                       const std::string& tcp6 = "/proc/net/tcp6");
// What `avahi-browse --parsable --resolve --terminate _aseba._tcp` printed.
std::vector<FoundTarget> announced_targets(const std::string& printed);

class Targets {
public:
    Targets();
    ~Targets();
    // Looks, at most every kLookEvery. True if something else is there than before.
    bool look(Time now);
    const std::vector<FoundTarget>& found() const { return found_; }
    nlohmann::json document() const;

private:
    class Browse;
    std::vector<FoundTarget> found_;
    std::unique_ptr<Browse> browse_;  // of avahi, under way
    std::vector<FoundTarget> announced_;
    Time next_{};
};

}  // namespace vagus::serve
