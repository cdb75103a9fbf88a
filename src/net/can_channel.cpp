// Packets of section 1.6 over a raw CAN socket (section 1.7).
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "net/channel.hpp"
#include "wire/can.hpp"

namespace vagus::net {

namespace {

constexpr uint16_t kReceivedMax = 1000;           // CAN frames of unfinished packets (section 1.7)
constexpr int kReadsAtOnce = 256;                 // frames taken before others get their turn
constexpr int kReceiveBuffer = 20 * 1024 * 1024;  // asked for; the system gives what it may

class CanChannel final : public Channel {
public:
    CanChannel(int descriptor, SendFrame send) : descriptor_(descriptor), send_(send) {}
    ~CanChannel() override { ::close(descriptor_); }
    CanChannel(const CanChannel&) = delete;
    CanChannel& operator=(const CanChannel&) = delete;

    int descriptor() const override { return descriptor_; }
    Transfer read(hub::Hub& hub, hub::LinkId link, Time now) override;
    Transfer write(hub::Hub& hub, hub::LinkId link) override;
    bool has_unwritten() const override { return next_ < count_; }

private:
    bool next_packet(hub::Hub& hub, hub::LinkId link);
    ssize_t write_part(const wire::CanFrame& part) const;

    int descriptor_;
    SendFrame send_;
    wire::CanReassembler<kReceivedMax> incoming_;
    std::array<wire::CanFrame, wire::kCanFramesMax> outgoing_;  // the packet that is being written
    uint8_t count_ = 0;
    uint8_t next_ = 0;
};

// Extended, remote and error frames are not of this protocol.
bool to_part(const can_frame& frame, wire::CanFrame& part) {
    if ((frame.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_ERR_FLAG)) != 0) return false;
    if (frame.can_dlc > wire::kCanBytesMax) return false;
    part.identifier = static_cast<uint16_t>(frame.can_id & CAN_SFF_MASK);
    part.size = frame.can_dlc;
    std::memcpy(part.bytes, frame.data, part.size);
    return true;
}

Transfer CanChannel::read(hub::Hub& hub, hub::LinkId link, Time) {
    Transfer done;
    for (int i = 0; i < kReadsAtOnce; ++i) {
        can_frame frame{};
        const ssize_t count = ::read(descriptor_, &frame, sizeof frame);
        if (count < 0 && (errno == EAGAIN || errno == EINTR)) return done;
        if (count < 0) return {.flow = Flow::Ended, .why = std::strerror(errno)};
        if (count == 0) return {.flow = Flow::Ended, .why = "the other side closed it"};
        done.bytes += static_cast<size_t>(count);
        wire::CanFrame part{};
        if (count != sizeof frame || !to_part(frame, part)) continue;
        if (incoming_.put(part) != wire::CanPut::Stored) continue;
        wire::Frame packet;
        while (incoming_.take(packet)) hub.receive(link, packet);
    }
    return done;
}

Transfer CanChannel::write(hub::Hub& hub, hub::LinkId link) {
    Transfer done;
    while (next_ < count_ || next_packet(hub, link)) {
        const ssize_t count = write_part(outgoing_[next_]);
        if (count < 0 && (errno == EAGAIN || errno == EINTR)) return {Flow::Blocked, done.bytes};
        // The device's queue is full, though the socket says that it is writable.
        if (count < 0 && errno == ENOBUFS) return {Flow::Retry, done.bytes};
        if (count < 0) return {Flow::Ended, done.bytes, std::strerror(errno)};
        done.bytes += static_cast<size_t>(count);
        ++next_;
    }
    return done;
}

// Cuts the next packet that the bus can carry; one whose source does not fit it is left out.
bool CanChannel::next_packet(hub::Hub& hub, hub::LinkId link) {
    wire::Frame packet;
    while (hub.take(link, packet)) {
        count_ = wire::can_fragment(packet, outgoing_.data());
        next_ = 0;
        if (count_ > 0) return true;
    }
    return false;
}

ssize_t CanChannel::write_part(const wire::CanFrame& part) const {
    can_frame frame{};
    frame.can_id = part.identifier;
    frame.can_dlc = part.size;
    std::memcpy(frame.data, part.bytes, part.size);
    return send_(descriptor_, &frame, sizeof frame, MSG_NOSIGNAL);
}

Error cannot(const CanPlace& place, const std::string& why) {
    return Error{Code::Unavailable, "can:" + place.interface + ": " + why};
}

Status bind_to(int descriptor, const CanPlace& place) {
    ifreq request{};
    if (place.interface.size() >= sizeof request.ifr_name) {
        return cannot(place, "an interface has at most " +
                                 std::to_string(sizeof request.ifr_name - 1) + " characters");
    }
    std::memcpy(request.ifr_name, place.interface.data(), place.interface.size());
    if (::ioctl(descriptor, SIOCGIFINDEX, &request) < 0) {
        return cannot(place, std::string("no such interface (") + std::strerror(errno) +
                                 "); `ip link show type can` lists those that are there");
    }
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = request.ifr_ifindex;
    if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) < 0) {
        return cannot(place, std::strerror(errno));
    }
    return Status::done();
}

}  // namespace

std::unique_ptr<Channel> make_can_channel(int descriptor, SendFrame send) {
    return std::make_unique<CanChannel>(descriptor, send);
}

Result<std::unique_ptr<Channel>> open_can(const CanPlace& place) {
    const int descriptor = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
    if (descriptor < 0) {
        const bool missing = errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT;
        if (!missing) return cannot(place, std::strerror(errno));
        return Error{Code::Refused,
                     "can:" + place.interface +
                         ": this kernel has no CAN sockets; load them with "
                         "`modprobe can_raw`, or use a kernel built with CONFIG_CAN"};
    }
    auto channel = make_can_channel(descriptor);
    // A larger buffer helps against bursts; a smaller one works.
    (void)::setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
    const Status bound = bind_to(descriptor, place);
    if (!bound.ok()) return bound.error();
    return channel;
}

}  // namespace vagus::net
