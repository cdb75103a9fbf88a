// CAN without a device: a socket pair carries `struct can_frame`, one a packet, as a raw CAN socket
// does. Serial lines without a device: a pseudo-terminal.
#include "net/channel.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "net/links.hpp"
#include "wire/can.hpp"

namespace vagus::net {
namespace {

using Hex = std::vector<uint8_t>;

// ---- CAN ----

class CanLoop : public testing::Test {
protected:
    CanLoop() {
        std::array<int, 2> ends;
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends.data()), 0);
        bus_ = ends[1];
        channel_ = make_can_channel(ends[0]);
    }
    ~CanLoop() override { close_bus(); }

    void put(canid_t id, const Hex& bytes) {
        can_frame frame{};
        frame.can_id = id;
        frame.can_dlc = static_cast<uint8_t>(bytes.size());
        std::memcpy(frame.data, bytes.data(), bytes.size());
        EXPECT_EQ(::send(bus_, &frame, sizeof frame, 0), ssize_t{sizeof frame});
    }
    // Identifier and bytes of the next frame on the bus; empty if there is none.
    std::pair<canid_t, Hex> get() {
        can_frame frame{};
        if (::recv(bus_, &frame, sizeof frame, 0) != ssize_t{sizeof frame}) return {};
        return {frame.can_id, Hex(frame.data, frame.data + frame.can_dlc)};
    }
    Hex at_host() {
        const auto bytes = hub_.output(host_);
        Hex copy(bytes.begin(), bytes.end());
        hub_.sent(host_, bytes.size());
        return copy;
    }
    void close_bus() {
        if (bus_ >= 0) ::close(bus_);
        bus_ = -1;
    }

    hub::Hub hub_;
    hub::LinkId can_ = hub_.add({.name = "can:test"}).value();
    hub::LinkId host_ = hub_.add({.name = "host"}).value();
    int bus_ = -1;
    std::unique_ptr<Channel> channel_;
};

using Can = CanLoop;

// The measured frames of section 1.6 become the stream frame of section 1.1.
TEST_F(Can, ReadsTheMeasuredDescription) {
    put(0x101, {0x00, 0x90, 0x0b, 0x64, 0x75, 0x6d, 0x6d, 0x79});
    put(0x001, {0x6e, 0x6f, 0x64, 0x65, 0x2d, 0x30, 0x05, 0x00});
    put(0x001, {0x00, 0x02, 0x40, 0x00, 0x24, 0x04, 0x05, 0x00});
    put(0x201, {0x01, 0x00, 0x1e, 0x00});
    EXPECT_EQ(channel_->read(hub_, can_, Time{}).flow, Flow::Moved);
    EXPECT_EQ(at_host(), (Hex{0x1a, 0,    1,    0,    0,    0x90, 0x0b, 0x64, 0x75, 0x6d, 0x6d,
                              0x79, 0x6e, 0x6f, 0x64, 0x65, 0x2d, 0x30, 5,    0,    0,    2,
                              0x40, 0,    0x24, 4,    5,    0,    1,    0,    0x1e, 0}));
}

TEST_F(Can, WritesTheMeasuredRunAndALongPacket) {
    wire::Frame run{};
    run.type = 0xa003;
    run.size = 2;
    run.payload[0] = 1;
    hub_.receive(host_, run);
    wire::Frame event{};
    event.source = 7;
    event.type = 4;
    event.size = 14;
    hub_.receive(host_, event);
    EXPECT_EQ(channel_->write(hub_, can_).flow, Flow::Moved);
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{0x300, {0x03, 0xa0, 0x01, 0x00}}));
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{0x107, {4, 0, 0, 0, 0, 0, 0, 0}}));
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{0x207, {0, 0, 0, 0, 0, 0, 0, 0}}));
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{}));
    EXPECT_FALSE(channel_->has_unwritten());
}

TEST_F(Can, LeavesOutAFrameWhoseSourceDoesNotFit) {
    wire::Frame event{};
    event.source = 0x105;
    event.type = 4;
    hub_.receive(host_, event);
    event.source = 5;
    hub_.receive(host_, event);
    EXPECT_EQ(channel_->write(hub_, can_).flow, Flow::Moved);
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{0x305, {4, 0}}));
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{}));
}

TEST_F(Can, DoesNotReadExtendedRemoteAndErrorFrames) {
    for (const canid_t flag : {CAN_EFF_FLAG, CAN_RTR_FLAG, CAN_ERR_FLAG}) put(0x301 | flag, {4, 0});
    EXPECT_EQ(::send(bus_, "short", 5, 0), 5);
    put(0x302, {4, 0});
    EXPECT_EQ(channel_->read(hub_, can_, Time{}).flow, Flow::Moved);
    EXPECT_EQ(at_host(), (Hex{0, 0, 2, 0, 4, 0}));
}

TEST_F(Can, APacketThatDoesNotFitNowIsFinishedLater) {
    wire::Frame event{};
    event.source = 7;
    event.type = 4;
    event.size = wire::kPayloadMax;
    size_t packets = 0;
    while (channel_->write(hub_, can_).flow != Flow::Blocked) {
        ASSERT_LT(packets, 10000u) << "the bus took everything";
        hub_.receive(host_, event);
        ++packets;
    }
    size_t frames = 0;
    while (frames < packets * wire::kCanFramesMax) {
        const bool got = !get().second.empty();
        frames += got ? 1 : 0;
        if (!got) {
            ASSERT_NE(channel_->write(hub_, can_).flow, Flow::Ended);
        }
    }
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{}));
    EXPECT_FALSE(channel_->has_unwritten());
}

// A device whose queue takes a frame and then none, twice, in turn; the socket calls itself
// writable.
int can_sends = 0;
ssize_t send_or_no_buffers(int descriptor, const void* bytes, size_t size, int flags) {
    if (can_sends++ % 3 == 0) return ::send(descriptor, bytes, size, flags);
    errno = ENOBUFS;
    return -1;
}

// The original stops there (section 1.7): here every part goes out once, in its order.
TEST_F(Can, AFullDeviceIsTriedAgainWhereItStopped) {
    can_sends = 0;
    channel_ = make_can_channel(::dup(channel_->descriptor()), send_or_no_buffers);
    wire::Frame event{};
    event.source = 7;
    event.type = 4;
    event.size = 18;  // 20 bytes with the type: three CAN frames
    for (uint8_t i = 0; i < event.size; i++) event.payload[i] = i;
    hub_.receive(host_, event);
    int retries = 0;
    for (Transfer done = channel_->write(hub_, can_); done.flow == Flow::Retry;
         done = channel_->write(hub_, can_)) {
        retries++;
        EXPECT_TRUE(channel_->has_unwritten());
        ASSERT_LT(retries, 10);
    }
    EXPECT_EQ(retries, 4);  // two between the first and the second part, two before the third
    EXPECT_FALSE(channel_->has_unwritten());
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{0x107, {4, 0, 0, 1, 2, 3, 4, 5}}));
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{0x007, {6, 7, 8, 9, 10, 11, 12, 13}}));
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{0x207, {14, 15, 16, 17}}));
    EXPECT_EQ(get(), (std::pair<canid_t, Hex>{}));
}

TEST_F(Can, EndsWhenTheBusIsGone) {
    close_bus();
    EXPECT_EQ(channel_->read(hub_, can_, Time{}).flow, Flow::Ended);
}

// What a machine without CAN says must help; one with CAN has no interface of that name.
TEST(CanSocket, SaysWhatIsMissing) {
    const auto opened = open_can(CanPlace{"no-such-can"});
    ASSERT_FALSE(opened.ok());
    const std::string& what = opened.error().what;
    EXPECT_EQ(what.rfind("can:no-such-can: ", 0), 0u) << what;
    const bool no_family = what.find("modprobe can_raw") != std::string::npos;
    const bool no_interface = what.find("ip link show type can") != std::string::npos;
    EXPECT_TRUE(no_family || no_interface) << what;
}

TEST(CanSocket, RefusesAnInterfaceNameOneCharacterTooLong) {
    const auto opened = open_can(CanPlace{"abcdefghijklmnop"});  // 16; the system has 15
    ASSERT_FALSE(opened.ok());
    const std::string& what = opened.error().what;
    EXPECT_TRUE(what.find("at most 15 characters") != std::string::npos ||
                what.find("modprobe can_raw") != std::string::npos)
        << what;
}

// ---- serial lines ----

// The far end of a serial cable.
class Pty {
public:
    Pty() : far_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
        EXPECT_EQ(::grantpt(far_), 0);
        EXPECT_EQ(::unlockpt(far_), 0);
        std::array<char, 64> name;
        EXPECT_EQ(::ptsname_r(far_, name.data(), name.size()), 0);
        device_ = name.data();
    }
    ~Pty() { unplug(); }
    Pty(const Pty&) = delete;
    Pty& operator=(const Pty&) = delete;

    const std::string& device() const { return device_; }
    void put(const Hex& bytes) const {
        EXPECT_EQ(::write(far_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    }
    Hex get() const {
        Hex bytes(4096);
        const ssize_t count = ::read(far_, bytes.data(), bytes.size());
        bytes.resize(count < 0 ? 0 : static_cast<size_t>(count));
        return bytes;
    }
    void unplug() {
        if (far_ >= 0) ::close(far_);
        far_ = -1;
    }

private:
    int far_;
    std::string device_;
};

struct Serial : testing::Test {
    hub::Hub hub;
    hub::LinkId own = hub.add({.name = "host"}).value();
    Links links;
    Pty line;
    std::vector<EventKind> kinds;

    template <typename Condition>
    bool until(Condition done) {
        const Time deadline = links.now() + 60s;
        while (links.now() < deadline) {
            if (done()) return true;
            for (const Event& each : links.poll(links.now() + 1ms)) kinds.push_back(each.kind);
        }
        return false;
    }
    bool open(Retry retry = Retry::Never) {
        const Target target = parse_target("ser:" + line.device()).value();
        return links.connect(hub, target, {.retry = retry}).ok() &&
               until([this] { return hub.links().size() == 2; });
    }
};

// 0x03, 0x0d, 0x11 and 0x7f are what a line that is not raw would eat or change.
TEST_F(Serial, PassesEveryByteAsItIs) {
    ASSERT_TRUE(open());
    const Hex frame{8, 0, 1, 0, 4, 0, 0x03, 0x0a, 0x0d, 0x11, 0x13, 0x1a, 0x7f, 0xff};
    line.put(frame);
    wire::Frame got;
    ASSERT_TRUE(until([&] { return hub.take(own, got); }));
    EXPECT_EQ(Hex(got.payload, got.payload + got.size), Hex(frame.begin() + 6, frame.end()));
    hub.receive(own, got);
    Hex back;
    ASSERT_TRUE(until([&] {
        const Hex more = line.get();
        back.insert(back.end(), more.begin(), more.end());
        return back.size() >= frame.size();
    }));
    EXPECT_EQ(back, frame);
}

TEST_F(Serial, LocksTheLine) {
    ASSERT_TRUE(open());
    const auto second = open_serial(SerialPlace{.device = line.device(), .name = ""});
    ASSERT_FALSE(second.ok());
    EXPECT_EQ(second.error().code, Code::Unavailable);
    EXPECT_NE(second.error().what.find("close the other program first"), std::string::npos)
        << second.error().what;
}

TEST_F(Serial, NoticesThatTheCableWasPulled) {
    ASSERT_TRUE(open());
    line.unplug();
    ASSERT_TRUE(until([this] { return hub.links().size() == 1; }));
    EXPECT_EQ(kinds.back(), EventKind::Closed);
}

TEST_F(Serial, SetsTheBaudRateAndTheFlowControl) {
    const auto opened = open_serial(SerialPlace{
        .device = line.device(), .name = "", .baud = 57600, .flow_control = FlowControl::Hardware});
    ASSERT_TRUE(opened.ok()) << opened.error().what;
    termios settings{};
    ASSERT_EQ(::tcgetattr(opened.value()->descriptor(), &settings), 0);
    EXPECT_EQ(::cfgetospeed(&settings), speed_t{B57600});
    EXPECT_NE(settings.c_cflag & CRTSCTS, 0u);
    EXPECT_EQ(settings.c_cflag & CSIZE, tcflag_t{CS8});
    EXPECT_EQ(settings.c_cflag & (PARENB | CSTOPB), 0u);
    EXPECT_EQ(settings.c_lflag & (ECHO | ICANON | ISIG), 0u);
}

TEST(SerialErrors, NameTheDeviceAndTheFix) {
    const auto file = open_serial(SerialPlace{.device = "/dev/null", .name = ""});
    ASSERT_FALSE(file.ok());
    EXPECT_EQ(file.error().what, "ser:/dev/null: /dev/null is not a serial line");
    const auto name = open_serial(SerialPlace{.device = "", .name = "no such name"});
    ASSERT_FALSE(name.ok());
    EXPECT_NE(name.error().what.find("ser:name=no such name: no serial line has that in its name"),
              std::string::npos);
}

}  // namespace
}  // namespace vagus::net
