// The two ways frames leave the process: as a stream of bytes (TCP, serial) and as CAN frames. A
// channel moves what is ready between its descriptor and its link, and never blocks.
// Used by links.cpp only.
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <memory>
#include <string>

#include "base/result.hpp"
#include "base/time.hpp"
#include "hub/hub.hpp"
#include "net/target.hpp"

namespace vagus::net {

enum class Flow {
    Moved,    // go on when the descriptor is ready again
    Blocked,  // the descriptor takes no more now
    Retry,    // it takes no more now and cannot say when it will (CAN): try again a little later
    Ended,    // the other side is gone, or does not speak the protocol
};

struct Transfer {
    Flow flow = Flow::Moved;
    size_t bytes = 0;
    std::string why = {};   // Ended: a part of a sentence, "the peer closed the connection"
    bool expelled = false;  // Ended: by us, since the peer does not speak the protocol
};

class Channel {
public:
    virtual ~Channel() = default;
    virtual int descriptor() const = 0;  // owned by the channel
    // Reads once and hands all whole frames to the hub.
    virtual Transfer read(hub::Hub& hub, hub::LinkId link, Time now) = 0;
    // Writes what the hub has for the link, as far as it goes.
    virtual Transfer write(hub::Hub& hub, hub::LinkId link) = 0;
    // Tells the other side that nothing more will be written; false if this kind of line cannot say
    // so.
    virtual bool end_writing() { return false; }
    // When look() wants to be called, at the latest: what has arrived may become frames by the
    // silence behind it.
    virtual Time next_look() const { return Time::max(); }
    // `bytes`: of the frames that it gave.
    virtual Transfer look(hub::Hub&, hub::LinkId, Time) { return {}; }
    // Bytes that belonged to no frame, since the beginning, as far as it is over: see
    // wire/line_reader.hpp.
    virtual uint32_t skipped() const { return 0; }
    // Something taken from the hub still waits in the channel.
    virtual bool has_unwritten() const { return false; }
};

// These own the descriptor from here on; it must be non-blocking.
// A socket loses no byte: what is no frame ends the connection.
std::unique_ptr<Channel> make_socket_channel(int descriptor);
// A terminal line may lose bytes, and finds the next frame again.
std::unique_ptr<Channel> make_line_channel(int descriptor, uint32_t baud);
// A raw CAN socket, or in tests a SOCK_SEQPACKET of `struct can_frame`.
// `send` hands a CAN frame to the system, as ::send does: a test gives one whose device is full.
using SendFrame = ssize_t (*)(int descriptor, const void* bytes, size_t size, int flags);
std::unique_ptr<Channel> make_can_channel(int descriptor, SendFrame send = ::send);

// Opens the line raw, 8N1, locked, DTR set (section 1.3).
Result<std::unique_ptr<Channel>> open_serial(const SerialPlace& place);
// Opens a raw CAN socket (section 1.7). Code::Refused if the kernel has no CAN.
Result<std::unique_ptr<Channel>> open_can(const CanPlace& place);

}  // namespace vagus::net
