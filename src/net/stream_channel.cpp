// Bytes of section 1.1, over a socket or a terminal line.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "net/channel.hpp"
#include "net/network.hpp"
#include "wire/frame.hpp"

namespace vagus::net {

namespace {

// One read takes at most so much: enough for thousands of small frames, far less than a queue.
constexpr size_t kReadBytes = 32 * 1024;

bool would_block(int error) {
    return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

class StreamChannel final : public Channel {
public:
    StreamChannel(int descriptor, StreamKind kind) : descriptor_(descriptor), kind_(kind) {}
    ~StreamChannel() override { ::close(descriptor_); }
    StreamChannel(const StreamChannel&) = delete;
    StreamChannel& operator=(const StreamChannel&) = delete;

    int descriptor() const override { return descriptor_; }
    Transfer read(hub::Hub& hub, hub::LinkId link) override;
    Transfer write(hub::Hub& hub, hub::LinkId link) override;
    bool end_writing() override {
        return kind_ == StreamKind::Socket && ::shutdown(descriptor_, SHUT_WR) == 0;
    }

private:
    ssize_t write_some(std::span<const uint8_t> bytes) const;

    int descriptor_;
    StreamKind kind_;
    wire::FrameReader reader_;
};

Transfer StreamChannel::read(hub::Hub& hub, hub::LinkId link) {
    std::array<uint8_t, kReadBytes> buffer;
    const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
    if (count < 0 && would_block(errno)) return {.flow = Flow::Blocked};
    if (count < 0) return {.flow = Flow::Ended, .why = std::strerror(errno)};
    // A terminal line gives 0 where nothing is there, a socket and a closed pty where nobody is.
    if (count == 0) return {.flow = Flow::Ended, .why = "the other side closed it"};

    auto size = static_cast<uint16_t>(count);
    for (const uint8_t* at = buffer.data(); size > 0;) {
        const uint16_t used = reader_.feed(at, size);
        at += used;
        size = static_cast<uint16_t>(size - used);
        if (reader_.complete()) hub.receive(link, reader_.frame());
    }
    if (reader_.dropped() >= kOversizedFramesMax) {
        return {.flow = Flow::Ended,
                .bytes = static_cast<size_t>(count),
                .why = "it does not speak the Aseba protocol (" +
                       std::to_string(reader_.dropped()) + " frames of more than " +
                       std::to_string(wire::kPayloadMax) + " bytes)",
                .expelled = true};
    }
    return {.flow = Flow::Moved, .bytes = static_cast<size_t>(count)};
}

Transfer StreamChannel::write(hub::Hub& hub, hub::LinkId link) {
    const std::span<const uint8_t> bytes = hub.output(link);
    if (bytes.empty()) return {};
    const ssize_t count = write_some(bytes);
    if (count < 0 && would_block(errno)) return {.flow = Flow::Blocked};
    if (count < 0) return {.flow = Flow::Ended, .why = std::strerror(errno)};
    const auto written = static_cast<size_t>(count);
    hub.sent(link, written);
    return {.flow = written < bytes.size() ? Flow::Blocked : Flow::Moved, .bytes = written};
}

ssize_t StreamChannel::write_some(std::span<const uint8_t> bytes) const {
    if (kind_ == StreamKind::Terminal) return ::write(descriptor_, bytes.data(), bytes.size());
    // Without the flag a peer that left would end this process by SIGPIPE.
    return ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

}  // namespace

std::unique_ptr<Channel> make_stream_channel(int descriptor, StreamKind kind) {
    return std::make_unique<StreamChannel>(descriptor, kind);
}

}  // namespace vagus::net
