// Bytes of section 1.1, over a socket or a terminal line.
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "net/channel.hpp"
#include "net/links.hpp"
#include "wire/frame.hpp"
#include "wire/line_reader.hpp"

namespace vagus::net {

namespace {

// One read takes at most so much: enough for thousands of small frames, far less than a queue.
constexpr size_t kReadBytes = 32 * 1024;

bool would_block(int error) {
    return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

class StreamChannel : public Channel {
public:
    explicit StreamChannel(int descriptor) : descriptor_(descriptor) {}
    ~StreamChannel() override { ::close(descriptor_); }
    StreamChannel(const StreamChannel&) = delete;
    StreamChannel& operator=(const StreamChannel&) = delete;

    int descriptor() const override { return descriptor_; }
    Transfer read(hub::Hub& hub, hub::LinkId link, Time now) override;
    Transfer write(hub::Hub& hub, hub::LinkId link) override;

private:
    // Hands the frames in the bytes to the hub.
    virtual Transfer take(std::span<const uint8_t> bytes, hub::Hub& hub, hub::LinkId link,
                          Time now) = 0;
    virtual ssize_t write_some(std::span<const uint8_t> bytes) const = 0;

    int descriptor_;
};

Transfer StreamChannel::read(hub::Hub& hub, hub::LinkId link, Time now) {
    std::array<uint8_t, kReadBytes> buffer;
    const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
    if (count < 0 && would_block(errno)) return {.flow = Flow::Blocked};
    if (count < 0) return {.flow = Flow::Ended, .why = std::strerror(errno)};
    // A terminal line gives 0 where nothing is there, a socket and a closed pty where nobody is.
    if (count == 0) return {.flow = Flow::Ended, .why = "the other side closed it"};
    return take({buffer.data(), static_cast<size_t>(count)}, hub, link, now);
}

Transfer StreamChannel::write(hub::Hub& hub, hub::LinkId link) {
    Transfer done;
    for (auto bytes = hub.output(link); !bytes.empty(); bytes = hub.output(link)) {
        const ssize_t count = write_some(bytes);
        if (count < 0 && would_block(errno)) return {Flow::Blocked, done.bytes};
        if (count < 0) return {Flow::Ended, done.bytes, std::strerror(errno)};
        const auto written = static_cast<size_t>(count);
        done.bytes += written;
        const bool full = written < bytes.size();
        hub.sent(link, written);
        if (full) return {Flow::Blocked, done.bytes};
    }
    return done;
}

class SocketChannel final : public StreamChannel {
public:
    using StreamChannel::StreamChannel;
    bool end_writing() override { return ::shutdown(descriptor(), SHUT_WR) == 0; }

private:
    Transfer take(std::span<const uint8_t> bytes, hub::Hub& hub, hub::LinkId link, Time) override;
    ssize_t write_some(std::span<const uint8_t> bytes) const override {
        // Without the flag a peer that left would end this process by SIGPIPE.
        return ::send(descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }

    wire::FrameReader reader_;
};

Transfer SocketChannel::take(std::span<const uint8_t> bytes, hub::Hub& hub, hub::LinkId link,
                             Time) {
    auto size = static_cast<uint16_t>(bytes.size());
    for (const uint8_t* at = bytes.data(); size > 0;) {
        const uint16_t used = reader_.feed(at, size);
        at += used;
        size = static_cast<uint16_t>(size - used);
        if (reader_.complete()) hub.receive(link, reader_.frame());
    }
    if (reader_.dropped() >= kOversizedFramesMax) {
        return {.flow = Flow::Ended,
                .bytes = bytes.size(),
                .why = "it does not speak the Aseba protocol (" +
                       std::to_string(reader_.dropped()) + " frames of more than " +
                       std::to_string(wire::kPayloadMax) + " bytes)",
                .expelled = true};
    }
    return {.flow = Flow::Moved, .bytes = bytes.size()};
}

uint32_t milliseconds_of(Time time) {
    return static_cast<uint32_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

// Twice the longest frame of 10 bits a byte, and a moment more.
uint32_t frame_within_ms(uint32_t baud) {
    return wire::kLineQuiet_ms + 2 * wire::kFrameMax * 10u * 1000u / std::max(baud, 1u);
}

class LineChannel final : public StreamChannel {
public:
    LineChannel(int descriptor, uint32_t baud)
        : StreamChannel(descriptor), reader_(frame_within_ms(baud)) {}

    Time next_look() const override { return next_look_; }
    Transfer look(hub::Hub& hub, hub::LinkId link, Time now) override;
    uint32_t skipped() const override { return told_; }

private:
    Transfer take(std::span<const uint8_t> bytes, hub::Hub& hub, hub::LinkId link,
                  Time now) override;
    ssize_t write_some(std::span<const uint8_t> bytes) const override {
        return ::write(descriptor(), bytes.data(), bytes.size());
    }
    size_t give_frames(hub::Hub& hub, hub::LinkId link);
    void look_later(Time now);

    wire::LineReader reader_;
    uint32_t told_ = 0;
    Time next_look_ = Time::max();
};

Transfer LineChannel::take(std::span<const uint8_t> bytes, hub::Hub& hub, hub::LinkId link,
                           Time now) {
    auto size = static_cast<uint16_t>(bytes.size());
    for (const uint8_t* at = bytes.data(); size > 0;) {
        const uint16_t used = reader_.feed(at, size, milliseconds_of(now));
        at += used;
        size = static_cast<uint16_t>(size - used);
        give_frames(hub, link);
    }
    look_later(now);
    return {.flow = Flow::Moved, .bytes = bytes.size()};
}

// Silence counts only if nothing waits to be read: this process may have slept.
Transfer LineChannel::look(hub::Hub& hub, hub::LinkId link, Time now) {
    int waiting = 0;
    size_t bytes = 0;
    if (::ioctl(descriptor(), FIONREAD, &waiting) != 0 || waiting == 0) {
        reader_.tick(milliseconds_of(now));
        bytes = give_frames(hub, link);
    }
    look_later(now);
    return {.bytes = bytes};
}

size_t LineChannel::give_frames(hub::Hub& hub, hub::LinkId link) {
    wire::Frame frame;
    size_t bytes = 0;
    while (reader_.next(frame)) {
        hub.receive(link, frame);
        bytes += wire::kHeaderSize + size_t{frame.size};
    }
    if (!reader_.lost()) told_ = reader_.skipped();
    return bytes;
}

void LineChannel::look_later(Time now) {
    next_look_ =
        reader_.waits() ? now + std::chrono::milliseconds(wire::kLineQuiet_ms) : Time::max();
}

}  // namespace

std::unique_ptr<Channel> make_socket_channel(int descriptor) {
    return std::make_unique<SocketChannel>(descriptor);
}

std::unique_ptr<Channel> make_line_channel(int descriptor, uint32_t baud) {
    return std::make_unique<LineChannel>(descriptor, baud);
}

}  // namespace vagus::net
