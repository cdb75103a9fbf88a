#include "net/service_manager.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

namespace vagus::net {
namespace {

using namespace std::chrono_literals;

// The socket of a service manager.
class Manager {
public:
    explicit Manager(const std::string& name) : descriptor_(socket(AF_UNIX, SOCK_DGRAM, 0)) {
        sockaddr_un here = {};
        here.sun_family = AF_UNIX;
        std::memcpy(here.sun_path, name.data(), name.size());
        if (name.front() == '@') here.sun_path[0] = '\0';
        const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
        EXPECT_EQ(bind(descriptor_, reinterpret_cast<sockaddr*>(&here), size), 0);
    }
    ~Manager() { close(descriptor_); }
    std::string heard() const {
        char bytes[200];
        const ssize_t size = recv(descriptor_, bytes, sizeof bytes, MSG_DONTWAIT);
        return size < 0 ? "" : std::string(bytes, static_cast<size_t>(size));
    }

private:
    int descriptor_;
};

TEST(ServiceManager, HearsWhatIsToldAtAPathAndAtAnAbstractName) {
    const std::string path = testing::TempDir() + "/notify-" + std::to_string(getpid());
    for (const std::string& name : {path, "@vagus-notify-" + std::to_string(getpid())}) {
        const Manager manager(name);
        const ServiceManager service(name, std::nullopt);
        EXPECT_TRUE(service.listens());
        service.tell("READY=1\nSTATUS=two nodes");
        EXPECT_EQ(manager.heard(), "READY=1\nSTATUS=two nodes");
        EXPECT_EQ(manager.heard(), "");
    }
    std::filesystem::remove(path);
}

TEST(ServiceManager, NobodyListensWithoutAName) {
    for (const char* name : {"", "relative", "vsock:2:1"}) {
        const ServiceManager service(name, std::nullopt);
        EXPECT_FALSE(service.listens()) << name;
        service.tell("READY=1");
    }
    EXPECT_FALSE(ServiceManager("/" + std::string(200, 'x'), std::nullopt).listens());
}

TEST(ServiceManager, IsToldTwiceAsOftenAsItWaits) {
    EXPECT_EQ(ServiceManager("", 30s).watchdog_every(), Duration(15s));
    EXPECT_EQ(ServiceManager("", std::nullopt).watchdog_every(), std::nullopt);
}

TEST(ServiceManager, TheEnvironmentSaysForWhomTheWatchdogIs) {
    setenv("WATCHDOG_USEC", "10000000", 1);
    setenv("WATCHDOG_PID", "1", 1);
    EXPECT_EQ(ServiceManager::from_environment().watchdog_every(), std::nullopt);
    setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
    EXPECT_EQ(ServiceManager::from_environment().watchdog_every(), Duration(5s));
    setenv("WATCHDOG_USEC", "soon", 1);
    EXPECT_EQ(ServiceManager::from_environment().watchdog_every(), std::nullopt);
    unsetenv("WATCHDOG_USEC");
    unsetenv("WATCHDOG_PID");
}

}  // namespace
}  // namespace vagus::net
