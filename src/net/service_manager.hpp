// What a service tells the program that started it (sd_notify(3)): datagrams to the socket that
// $NOTIFY_SOCKET names. Where nothing is named, nothing is told.
//
//     ServiceManager manager = ServiceManager::from_environment();
//     manager.tell("READY=1\nSTATUS=4 nodes");
//     if (manager.watchdog_every()) …            // WATCHDOG=1 at least so often
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/time.hpp"

namespace vagus::net {

class ServiceManager {
public:
    // From $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID.
    static ServiceManager from_environment();
    // `socket` is a path, or a name that begins with @ (abstract); empty: nobody listens.
    ServiceManager(std::string socket, std::optional<Duration> watchdog);
    ~ServiceManager();
    ServiceManager(ServiceManager&& other) noexcept;
    ServiceManager& operator=(ServiceManager&&) = delete;

    bool listens() const { return descriptor_ >= 0; }
    // Lines NAME=VALUE. One that is not taken at once is lost: nobody waits for a manager.
    void tell(const std::string& lines) const;
    // Half of what the manager waits for: it says so itself.
    std::optional<Duration> watchdog_every() const { return watchdog_every_; }

private:
    std::string socket_;
    std::optional<Duration> watchdog_every_;
    int descriptor_ = -1;
};

}  // namespace vagus::net
