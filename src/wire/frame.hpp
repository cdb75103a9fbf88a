// The stream frame of TCP, serial and USB (docs/spec/aseba-wire-and-vm.md, section 1.1):
//
//     offset 0  u16 len      payload bytes, header not counted
//     offset 2  u16 source   id of the sending node; hosts use 0
//     offset 4  u16 type     message id
//     offset 6  payload
//
// FrameReader turns a stream of bytes, in pieces of any size, into frames. A frame that announces
// more than kPayloadMax bytes is read and thrown away, and counted; the stream stays aligned.
//
//     FrameReader reader;
//     while (size > 0) {
//         const uint16_t used = reader.feed(bytes, size);   // at most up to the end of one frame
//         bytes += used; size -= used;
//         if (reader.complete()) use(reader.frame());        // valid until the next feed()
//     }
#pragma once

#include <stdint.h>

#include "wire/protocol.hpp"

namespace vagus {
namespace wire {

// One message on the bus, by value: fields in the order of the stream. `size` is the number of
// payload bytes, at most kPayloadMax.
struct Frame {
    uint16_t size;
    uint16_t source;
    uint16_t type;
    uint8_t payload[kPayloadMax];

    // The first payload word: the destination, if the type is a command. 0xffff if there is none.
    uint16_t first_word() const {
        return size < 2 ? kInvalidId : static_cast<uint16_t>(payload[0] | (payload[1] << 8));
    }
};

// Writes header and payload to `bytes`, which has room for kFrameMax; gives the number of bytes
// written.
uint16_t encode(const Frame& frame, uint8_t* bytes);

class FrameReader {
public:
    FrameReader() : have_(0), skip_(0), complete_(false), dropped_(0) {}

    // Takes up to the end of the current frame from `bytes`; gives how many bytes were used (at
    // least 1 if size > 0).
    uint16_t feed(const uint8_t* bytes, uint16_t size);
    // True after a feed() that ended a frame of legal size.
    bool complete() const { return complete_; }
    const Frame& frame() const { return frame_; }
    // Frames thrown away because they announced too many bytes.
    uint32_t dropped() const { return dropped_; }

private:
    void take_header_byte(uint8_t byte);

    Frame frame_;
    uint8_t header_[kHeaderSize];
    uint16_t have_;  // bytes of header and payload read so far
    uint32_t skip_;  // bytes of an oversized payload still to throw away
    bool complete_;
    uint32_t dropped_;
};

}  // namespace wire
}  // namespace vagus
