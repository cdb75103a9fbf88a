#include "net/service_manager.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace vagus::net {

namespace {

std::string said(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

std::optional<int64_t> number_in(const std::string& text) {
    int64_t number = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = failed == std::errc() && end == text.data() + text.size();
    return whole && number > 0 ? std::optional(number) : std::nullopt;
}

}  // namespace

ServiceManager ServiceManager::from_environment() {
    const auto microseconds = number_in(said("WATCHDOG_USEC"));
    const auto meant = number_in(said("WATCHDOG_PID"));
    const bool for_us = !meant || *meant == getpid();
    return {said("NOTIFY_SOCKET"),
            microseconds && for_us ? std::optional(Duration(*microseconds)) : std::nullopt};
}

ServiceManager::ServiceManager(std::string socket, std::optional<Duration> watchdog)
    : socket_(std::move(socket)) {
    if (watchdog) watchdog_every_ = *watchdog / 2;
    const bool named = !socket_.empty() && (socket_.front() == '/' || socket_.front() == '@');
    if (!named || socket_.size() >= sizeof(sockaddr_un::sun_path)) return;
    descriptor_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

ServiceManager::~ServiceManager() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

ServiceManager::ServiceManager(ServiceManager&& other) noexcept
    : socket_(std::move(other.socket_)),
      watchdog_every_(other.watchdog_every_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

void ServiceManager::tell(const std::string& lines) const {
    if (descriptor_ < 0) return;
    sockaddr_un to = {};
    to.sun_family = AF_UNIX;
    std::memcpy(to.sun_path, socket_.data(), socket_.size());
    if (socket_.front() == '@') to.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
    (void)::sendto(descriptor_, lines.data(), lines.size(), MSG_NOSIGNAL,
                   reinterpret_cast<const sockaddr*>(&to), size);
}

}  // namespace vagus::net
